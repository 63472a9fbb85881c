// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/combiner/combiner_file.hpp"

#include "support/temp_dir.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace hypermap {
namespace {

using testing::HasSubstr;

CombinerModel written_model() {
  return {.detectors = {{.name = "yo\"lo", .classes = {"cup", "bowl"}}},
          .classes = {{.class_name = "cup",
                       .offset = -1.0 / 3.0,
                       .weights = {0.1, 1e-9, -7.0},
                       .share = 0.25}}};
}

std::string combiner_refusal(const std::string& text) {
  const auto parsed = parse_combiner(text, "c.json");
  return parsed ? "was accepted" : to_string(parsed.error());
}

std::string with(const std::string& from, const std::string& to) {
  std::string text = write_combiner(written_model());
  return text.replace(text.find(from), from.size(), to);
}

TEST(CombinerFile, WhatIsWrittenIsReadAgain) {
  const test::TempDir folder;
  const std::string text = write_combiner(written_model());
  test::write_text(folder / "c.json", text);
  const auto read = read_combiner(folder / "c.json");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(*read, written_model());
  EXPECT_EQ(write_combiner(*read), text);
  EXPECT_EQ(read_combiner(folder / "none.json").error().code, ErrorCode::kIo);
}

TEST(CombinerFile, IsNeverCutUnnoticed) {
  const std::string text = write_combiner(written_model());
  for (std::size_t size = 0; size + 1 < text.size(); ++size) {
    EXPECT_FALSE(parse_combiner(text.substr(0, size), "c.json")) << size;
  }
}

TEST(CombinerFile, WithoutAShareAClassIsAsCommonAsAny) {
  const auto read = parse_combiner(with(",\"share\":0.25", ""), "c.json");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->classes[0].share, 1.0);
}

TEST(CombinerFile, RefusalsSayWhatIsWrong) {
  EXPECT_THAT(combiner_refusal("[]"), HasSubstr("c.json:1"));
  EXPECT_THAT(combiner_refusal("{}"),
              HasSubstr("is no combiner of detectors, whose \"format\" is"));
  EXPECT_THAT(combiner_refusal(with("hypermap-combiner", "weights")),
              HasSubstr("is no combiner of detectors"));
  EXPECT_THAT(combiner_refusal(with("\"version\":1", "\"version\":2")),
              HasSubstr("written by a newer version 2"));
  EXPECT_THAT(combiner_refusal(with("\"offset\"", "\"bias\"")), HasSubstr("offset"));
  EXPECT_THAT(combiner_refusal(with("-7", "1e7")),
              HasSubstr("classes[0].weights[2] must be in -1e6 .. 1e6, is 1e+07"));
  EXPECT_THAT(combiner_refusal(with("0.25", "0")),
              HasSubstr("classes[0].share must be in 1e-6 .. 1, is 0"));
  EXPECT_THAT(combiner_refusal(with("0.25", "1.5")), HasSubstr("is 1.5"));
  EXPECT_THAT(combiner_refusal(with(",-7", "")), HasSubstr("must have 3 numbers, has 2"));
  EXPECT_THAT(combiner_refusal(with("\"bowl\"", "\"cup\"")), HasSubstr("detectors[0]"));
}

}  // namespace
}  // namespace hypermap
