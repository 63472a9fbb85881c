// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/label_names_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

std::string label_refusal(const std::string& yaml) {
  const auto names = parse_label_names(yaml, {.file = "names.yaml"});
  return names ? "none" : to_string(names.error());
}

TEST(LabelNamesFile, ANumberALine) {
  const auto names = parse_label_names("0: ~\n7: dining table\n-1: chair\n3: 'yes'\n", {});
  ASSERT_TRUE(names) << to_string(names.error());
  EXPECT_THAT(*names, ElementsAre(Pair(-1, "chair"), Pair(3, "yes"), Pair(7, "dining table")));
}

TEST(LabelNamesFile, NamesWhatIsWrong) {
  EXPECT_THAT(label_refusal("1: chair\nx: sofa\n"),
              HasSubstr("names.yaml:2: x: its key must be a whole number"));
  EXPECT_THAT(label_refusal("1: ''\n"), HasSubstr("must be a name of 1 to 256 bytes"));
  EXPECT_THAT(label_refusal("1: [a]\n"), HasSubstr("names.yaml:1"));
  EXPECT_THAT(label_refusal("0: ~\n"), HasSubstr("names no label"));
  EXPECT_THAT(label_refusal("- chair\n"), HasSubstr("names.yaml:1"));
  EXPECT_EQ(read_label_names("/nowhere/names.yaml").error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace hypermap
