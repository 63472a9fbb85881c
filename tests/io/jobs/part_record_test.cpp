// SPDX-License-Identifier: BSD-3-Clause
#include "part_record.hpp"

#include "support/temp_dir.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace hypermap {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

PartRecipe some_recipe() {
  return {.program = "hypermap 0.1.0", .input = "xxh3-128:12", .settings = "xxh3-128:34"};
}

PartRecord some_record() {
  return {.recipe = some_recipe(),
          .content = "xxh3-128:56",
          .counts = {.frames = 40,
                     .skipped = 1,
                     .objects = 12,
                     .tentative = 3,
                     .sessions = 1,
                     .leaves = {.occupied = 1000, .free = 20000}},
          .findings = {"depth/7.png: is cut", "- odd: \"text\""}};
}

TEST(PartRecord, IsReadAsItWasWritten) {
  const PartRecord record = some_record();
  const auto read = parse_part_record(write_part_record(record), {.file = "a.yaml"});
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(*read, record);
}

TEST(PartRecord, OfAnotherFormOrVersionIsRefused) {
  const std::string text = write_part_record(some_record());
  const auto why = [](std::string changed, const std::string& from, const std::string& to) {
    changed.replace(changed.find(from), from.size(), to);
    const auto read = parse_part_record(changed, {.file = "a.yaml"});
    return read ? "read" : to_string(read.error());
  };
  EXPECT_THAT(why(text, "hypermap-part", "letter"), HasSubstr("format: must be hypermap-part"));
  EXPECT_THAT(why(text, "version: 1", "version: 2"), HasSubstr("version: must be 1, is 2"));
  EXPECT_THAT(why(text, "frames: 40", "frames: -1"), HasSubstr("frames"));
  EXPECT_THAT(why(text, "frames: 40", "framed: 40"), HasSubstr("framed"));
}

TEST(PartRecord, KeepsSoManyFindings) {
  EXPECT_THAT(kept_findings({"a", "b"}), SizeIs(2));
  const auto kept = kept_findings(std::vector<std::string>(kMaxKeptFindings + 2, "a"));
  ASSERT_THAT(kept, SizeIs(kMaxKeptFindings + 1));
  EXPECT_EQ(kept.back(), "and 2 more");
}

class PartOnDisk : public testing::Test {
 protected:
  void SetUp() override {
    test::write_text(files_.part, "the map");
    PartRecord record = some_record();
    ASSERT_TRUE(save_part_record(files_, record));
  }

  test::TempDir folder_;
  PartFiles files_{.part = folder_ / "a.hmap", .record = folder_ / "a.yaml"};
};

TEST_F(PartOnDisk, StandsForTheRecipeThatMadeIt) {
  EXPECT_EQ(reason_to_make(files_, some_recipe()), std::nullopt);
}

TEST_F(PartOnDisk, IsMadeAnewByAnotherRecipe) {
  PartRecipe other = some_recipe();
  other.program = "hypermap 0.2.0";
  EXPECT_EQ(reason_to_make(files_, other), "was made by hypermap 0.1.0");
  other = some_recipe();
  other.input = "xxh3-128:99";
  EXPECT_EQ(reason_to_make(files_, other), "was made of other data");
  other = some_recipe();
  other.settings = "xxh3-128:99";
  EXPECT_EQ(reason_to_make(files_, other), "was made with other options");
}

TEST_F(PartOnDisk, IsMadeAnewWhenAByteDiffers) {
  std::fstream(files_.part, std::ios::in | std::ios::out | std::ios::binary) << "T";
  EXPECT_EQ(reason_to_make(files_, some_recipe()), "is not as it was made");
}

TEST_F(PartOnDisk, IsMadeAnewWithoutItsRecord) {
  std::filesystem::remove(files_.record);
  EXPECT_EQ(reason_to_make(files_, some_recipe()), "nothing says of what it was made");
  test::write_text(files_.record, "format: hypermap-part\nversion: 1\n");
  EXPECT_EQ(reason_to_make(files_, some_recipe()), "nothing says of what it was made");
}

TEST_F(PartOnDisk, ThatIsNotThereIsMade) {
  std::filesystem::remove(files_.part);
  EXPECT_EQ(reason_to_make(files_, some_recipe()), "");
}

}  // namespace
}  // namespace hypermap
