// SPDX-License-Identifier: BSD-3-Clause
#include "run_checkpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

RunCheckpoint sample_run_checkpoint() {
  RunCheckpoint checkpoint;
  checkpoint.num_positions = 12;
  checkpoint.first = {.position = 1, .hash = "xxh3-128:01"};
  checkpoint.last = {.position = 10, .hash = "xxh3-128:0a"};
  checkpoint.skipped_positions = {0, 11};
  MappingReport& report = checkpoint.report;
  report.num_frames = 10;
  report.skipped = {
      {.code = ErrorCode::kIo, .what = "is gone", .file = "d/0.png"},
      {.code = ErrorCode::kLimit, .what = "stands too far", .file = "d/11.png", .field = "pose"}};
  report.num_detections = 1;
  report.num_looks = 2;
  report.num_filtered = 9;
  report.num_segments = 2;
  report.num_visibility_skipped = 3;
  report.points = {.num_hits = 4,
                   .num_beyond_range = 5,
                   .num_not_measured = 6,
                   .num_not_finite = 7,
                   .num_outside_volume = std::size_t{1} << 60U,
                   .num_transient = 8};
  checkpoint.settings = make_map({{"stride", make_text("2")}});
  return checkpoint;
}

/// The sample with `value` for the key at the end of `path` ("last.position").
ValueTree with_value(std::string_view path, ValueTree value) {
  ValueTree tree = to_tree(sample_run_checkpoint());
  ValueTree* node = &tree;
  while (!path.empty()) {
    const std::string_view key = path.substr(0, path.find('.'));
    path.remove_prefix(key.size() == path.size() ? key.size() : key.size() + 1);
    for (auto& [name, entry] : node->entries) {
      if (name != key) continue;
      node = &entry;
      break;
    }
  }
  *node = std::move(value);
  return tree;
}

std::string refusal(const ValueTree& tree) {
  const auto parsed = parse_run_checkpoint(tree, "a.hmap.checkpoint");
  return parsed ? "none" : to_string(parsed.error());
}

TEST(RunCheckpoint, AllThatIsNotedComesBack) {
  const RunCheckpoint noted = sample_run_checkpoint();
  const auto again = parse_run_checkpoint(to_tree(noted), "a.hmap.checkpoint");
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_EQ(again->num_positions, 12U);
  EXPECT_EQ(again->first, noted.first);
  EXPECT_EQ(again->last, noted.last);
  EXPECT_THAT(again->skipped_positions, ElementsAre(0U, 11U));
  EXPECT_EQ(again->report.num_frames, 10U);
  EXPECT_EQ(again->report.num_detections, 1U);
  EXPECT_EQ(again->report.num_looks, 2U);
  EXPECT_EQ(again->report.num_filtered, 9U);
  EXPECT_EQ(again->report.num_segments, 2U);
  EXPECT_EQ(again->report.num_visibility_skipped, 3U);
  EXPECT_EQ(again->report.points.num_hits, 4U);
  EXPECT_EQ(again->report.points.num_beyond_range, 5U);
  EXPECT_EQ(again->report.points.num_not_measured, 6U);
  EXPECT_EQ(again->report.points.num_not_finite, 7U);
  EXPECT_EQ(again->report.points.num_outside_volume, std::size_t{1} << 60U);
  EXPECT_EQ(again->report.points.num_transient, 8U);
  EXPECT_EQ(again->settings, noted.settings);
  EXPECT_EQ(to_tree(*again), to_tree(noted));
}

TEST(RunCheckpoint, OneOfAProgramThatDidNotCountTransientPointsIsRead) {
  ValueTree tree = to_tree(sample_run_checkpoint());
  for (auto& [name, entry] : tree.entries) {
    if (name != "counts") continue;
    EXPECT_EQ(std::erase_if(entry.entries, [](const auto& e) { return e.first == "transient"; }),
              1U);
  }
  const auto again = parse_run_checkpoint(tree, "a.hmap.checkpoint");
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_EQ(again->report.points.num_transient, 0U);
  EXPECT_EQ(again->report.points.num_hits, 4U);
}

TEST(RunCheckpoint, ASkippedFrameKeepsItsReasonAndWhoseFaultItWas) {
  const auto again = parse_run_checkpoint(to_tree(sample_run_checkpoint()), "a.hmap.checkpoint");
  ASSERT_TRUE(again);
  EXPECT_EQ(to_string(again->report.skipped.at(0)), "d/0.png: is gone");
  EXPECT_EQ(again->report.skipped.at(0).code, ErrorCode::kIo);
  EXPECT_EQ(to_string(again->report.skipped.at(1)), "d/11.png: pose: stands too far");
  EXPECT_NE(again->report.skipped.at(1).code, ErrorCode::kIo);
}

TEST(RunCheckpoint, WhatNoRunWouldNoteIsRefusedByItsKey) {
  EXPECT_THAT(refusal(make_map({})), HasSubstr("a.hmap.checkpoint!checkpoint: "));
  EXPECT_THAT(refusal(with_value("positions", make_number(-1))), HasSubstr("positions"));
  EXPECT_THAT(refusal(with_value("last.position", make_number(12))), HasSubstr("last.position"));
  EXPECT_THAT(refusal(with_value("first.hash", make_list({}))), HasSubstr("first.hash"));
  EXPECT_THAT(refusal(with_value("counts.hits", make_text("many"))), HasSubstr("counts.hits"));
  EXPECT_THAT(refusal(with_value("skipped", make_text("none"))), HasSubstr("skipped"));
  EXPECT_THAT(refusal(with_value("settings", make_list({}))), HasSubstr("settings"));
}

TEST(RunCheckpoint, PositionsOfSkippedFramesAscend) {
  RunCheckpoint checkpoint = sample_run_checkpoint();
  checkpoint.skipped_positions = {11, 11};
  EXPECT_THAT(refusal(to_tree(checkpoint)), HasSubstr("must come after position 11, is 11"));
}

}  // namespace
}  // namespace hypermap
