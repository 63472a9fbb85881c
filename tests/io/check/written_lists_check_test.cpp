// SPDX-License-Identifier: BSD-3-Clause
// Checks of what people write for single commands: lists, changes, rules about classes.
#include "hypermap/io/check/file_check.hpp"
#include "support/temp_dir.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace hypermap {
namespace {

using test::TempDir;
using test::write_text;
using ::testing::HasSubstr;
using ::testing::SizeIs;

/// Kind, summary and exit code, or the first finding of what is refused.
std::string checked(const std::filesystem::path& path) {
  const FileCheckResult result = check_file(path);
  const std::string kind = result.kind ? std::string(name_of(*result.kind)) : "no kind";
  if (result.is_refused()) return kind + ": " + to_string(result.findings.front().error);
  return kind + ": " + result.summary + ": " + std::to_string(result.exit_code());
}

std::string checked_text(const std::string& text) {
  const TempDir dir;
  write_text(dir / "a.yaml", text);
  return checked(dir / "a.yaml");
}

TEST(WrittenListsCheck, ListsOfSequences) {
  EXPECT_THAT(checked_text("sequences:\n- input: .\n  colour: red\n"),
              AllOf(HasSubstr("sequences: "), HasSubstr("a.yaml:3"), HasSubstr("colour")));
  const TempDir dir;
  std::filesystem::create_directory(dir / "kitchen");
  write_text(dir / "rooms.yaml", "sequences:\n- kitchen\n- {input: hall, poses: closed.txt}\n");
  const FileCheckResult result = check_file(dir / "rooms.yaml");
  EXPECT_EQ(result.summary, "2 sequences");
  EXPECT_EQ(result.exit_code(), 1);
  ASSERT_THAT(result.findings, SizeIs(2));
  EXPECT_THAT(to_string(result.findings[0].error),
              AllOf(HasSubstr("rooms.yaml: sequences[1].input: names "), HasSubstr("hall")));
  EXPECT_EQ(result.findings[1].error.field, "sequences[1].poses");
}

TEST(WrittenListsCheck, ChangesToALayer) {
  EXPECT_EQ(checked_text("add:\n- {name: a, shape: 'POLYGON ((0 0, 1 0, 1 1, 0 0))'}\n"
                         "- {id: 7, name: b, shape: 'POLYGON ((0 0, 1 0, 1 1, 0 0))'}\n"
                         "modify: [{id: 1, name: c}]\ndelete: [2, 3, 4]\n"),
            "update: 2 to add, 1 to modify, 3 to delete: 0");
  EXPECT_THAT(checked_text("# of today\ndelete: [chair]\n"),
              AllOf(HasSubstr("update: "), HasSubstr("a.yaml:2: delete[0]")));
}

TEST(WrittenListsCheck, Zones) {
  EXPECT_EQ(checked_text("zones:\n  door: {keepout_m: 0.5}\n"), "zones: zones of 1 class: 0");
  EXPECT_THAT(checked_text("robot_height_m: 1\nzones:\n  door: {keepout_m: -1}\n"),
              AllOf(HasSubstr("zones: "), HasSubstr("a.yaml:3"), HasSubstr("keepout_m")));
}

TEST(WrittenListsCheck, Vocabularies) {
  EXPECT_EQ(checked_text("aliases: {tv: [telly], couch: [sofa]}\nsuper_classes: {seat: [couch]}\n"),
            "vocabulary: other names of 2 classes, members of 1 super-class: 0");
  EXPECT_THAT(checked_text("super_classes: {seat: [couch]}\naliasses: {tv: [telly]}\n"),
              AllOf(HasSubstr("vocabulary: "), HasSubstr("a.yaml:2"), HasSubstr("aliases")));
}

TEST(WrittenListsCheck, WhatBelongsWhere) {
  EXPECT_EQ(checked_text("belongings:\n  oven: {kitchen: 20, office: 0.5}\n"),
            "places: where objects of 1 class belong, of 2 places: 0");
  EXPECT_THAT(
      checked_text("tempering: 2\nbelongings:\n  oven: {kitchen: 20}\n"),
      AllOf(HasSubstr("places: "), HasSubstr("a.yaml:1: tempering: must be 0.01 .. 1, is 2")));
}

TEST(WrittenListsCheck, IndexesOfTiles) {
  const TempDir dir;
  const std::string tile = R"({"file": "tile_0_0.hmap", "area": [0, 0, 5, 5], "voxels": 1,)";
  write_text(dir / "tiles.json", R"({"tile_m": 5, "tiles": [)" + tile + "\n\"objects\": 0}]}");
  const FileCheckResult result = check_file(dir / "tiles.json");
  EXPECT_EQ(result.summary, "index of 1 tile");
  EXPECT_EQ(result.exit_code(), 1) << "the tile is absent";
  ASSERT_THAT(result.findings, SizeIs(1));
  EXPECT_EQ(result.findings[0].error.field, "tiles[0].file");
  write_text(dir / "tile_0_0.hmap", "");
  EXPECT_EQ(checked(dir / "tiles.json"), "tile-set: index of 1 tile: 0");
  write_text(dir / "tiles.json", R"({"tile_m": 5, "tiles": [)" + tile + "\n\"objects\": -1}]}");
  EXPECT_THAT(checked(dir / "tiles.json"),
              AllOf(HasSubstr("tile-set: "), HasSubstr("tiles.json:2: $.tiles[0].objects")));
}

TEST(WrittenListsCheck, AFileOfNoKindIsStillRefused) {
  const TempDir dir;
  write_text(dir / "notes", "added: 3\nplaces: 4\n");
  EXPECT_THAT(checked(dir / "notes"), HasSubstr("is of no kind that is read here"));
}

}  // namespace
}  // namespace hypermap
