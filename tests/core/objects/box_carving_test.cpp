// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/box_carving.hpp"

#include "association_cases.hpp"
#include "support/camera_pose.hpp"

#include <gtest/gtest.h>

#include <map>
#include <vector>

namespace hypermap {
namespace {

using testing_support::kChairClass;
using testing_support::observed;
using testing_support::scores;

constexpr int kNumRows = 10;

/// A board 2.005 m ahead of the camera, 50 columns of cells 2 cm apart, a point in the middle of
/// each: column i is seen at u = 25.31 + 0.9975 i.
std::vector<Eigen::Vector3f> points_of_board() {
  std::vector<Eigen::Vector3f> points;
  for (int column = 0; column < 50; ++column) {
    for (int row = 0; row < kNumRows; ++row) {
      const double y_m = 0.495 - 0.02 * column;
      points.emplace_back(Eigen::Vector3d(2.005, y_m, -0.095 + 0.02 * row).cast<float>());
    }
  }
  return points;
}

/// One pixel is a centimetre a metre ahead of it.
RgbdFrame frame_before_board() {
  RgbdFrame frame;
  frame.camera = {
      .width_px = 101, .height_px = 101, .fx_px = 100, .fy_px = 100, .cx_px = 50, .cy_px = 50};
  frame.map_from_camera = test::camera_at({0, 0, 0}, 0.0, 0.0);
  frame.depth_m = DepthImage(101, 101, 2.0F);
  return frame;
}

Observation board_in(const PixelBox& box_px) {
  Observation board = observed(points_of_board(), scores(kChairClass, 0.8));
  board.box_px = box_px;
  return board;
}

/// The board was seen three times, the last time in these boxes.
struct SeenBoard {
  ObjectMap objects;
  std::vector<Observation> observations;
  AssociationReport association;
  AssociationOptions options;

  explicit SeenBoard(const std::vector<PixelBox>& boxes) {
    const std::vector<Observation> whole{board_in({25, 40, 76, 60})};
    const ObjectId id = associate(objects, whole, options).created.at(0);
    associate(objects, whole, options);
    for (const PixelBox& box : boxes) observations.push_back(board_in(box));
    objects.modify(id, [&](Object& object) { update_object(object, observations[0], options); });
    association.object_of_observation.assign(boxes.size(), id);
    association.matched = {id};
  }
  [[nodiscard]] const Object& board() const { return objects.at(association.matched[0]); }
  std::size_t carve(const RgbdFrame& frame) {
    return carve_by_boxes(objects, frame, observations, association, options);
  }
  /// How many cells have so many votes.
  [[nodiscard]] std::map<std::uint32_t, int> cells_by_votes() const {
    std::map<std::uint32_t, int> count;
    for (const PointVote& vote : board().points.state().votes) ++count[vote.votes];
    return count;
  }
};

constexpr PixelBox kWhole{25, 40, 76, 60};
/// 41.5 wide, with its margin up to u = 66.5 + 4.15: the last four columns, from 71.2 on, lie
/// outside, 8 %.
constexpr PixelBox kNarrow{25, 40, 66.5, 60};
/// 39 wide, up to 67.9: seven columns, from 68.2 on, 14 %.
constexpr PixelBox kPart{25, 40, 64, 60};

TEST(BoxCarving, SparesWhatAMaskShowsOutsideItsBox) {
  const RgbdFrame frame = frame_before_board();
  Detection detection;
  detection.box_px = {25, 40, 30, 60};
  detection.class_scores = scores(kChairClass, 0.8);
  detection.mask = MaskImage(101, 101);
  detection.mask->at(75, 50) = 1;
  const Observation seen = make_observation(frame, detection, board_in({}).segment);
  EXPECT_EQ(seen.box_px, (PixelBox{25, 40, 76, 60}));
  SeenBoard board({seen.box_px});
  EXPECT_EQ(board.carve(frame), 0U);
}

TEST(BoxCarving, WhatIsSeenOutsideTheBoxLosesAVote) {
  SeenBoard seen({kNarrow});
  ASSERT_EQ(seen.cells_by_votes(), (std::map<std::uint32_t, int>{{3, 500}}));
  EXPECT_EQ(seen.carve(frame_before_board()), 4U * kNumRows);
  EXPECT_EQ(seen.cells_by_votes(), (std::map<std::uint32_t, int>{{2, 40}, {3, 460}}));
}

TEST(BoxCarving, CellsWithoutVotesGoAndTheBoxFollows) {
  SeenBoard seen({kNarrow});
  const Box before = seen.board().box;
  for (int i = 0; i < 3; ++i) seen.carve(frame_before_board());
  EXPECT_EQ(seen.cells_by_votes(), (std::map<std::uint32_t, int>{{3, 460}}));
  EXPECT_NEAR(seen.board().box.min_in_map.y() - before.min_in_map.y(), 0.08, 1e-9);
  EXPECT_EQ(seen.board().box.max_in_map, before.max_in_map);
  EXPECT_EQ(seen.board().centroid_in_map, seen.board().box.centre());
}

TEST(BoxCarving, TheBoxStaysWhereItIsAFilterOfBoxes) {
  SeenBoard seen({kNarrow});
  seen.options.box_from_points = false;
  const Box before = seen.board().box;
  for (int i = 0; i < 3; ++i) seen.carve(frame_before_board());
  EXPECT_EQ(seen.board().box, before);
}

TEST(BoxCarving, ABoxOfAPartSpeaksAgainstNothing) {
  SeenBoard seen({kPart});
  EXPECT_EQ(seen.carve(frame_before_board()), 0U);
  seen.options.carving.max_share = 0.15;
  EXPECT_EQ(seen.carve(frame_before_board()), 7U * kNumRows);
}

TEST(BoxCarving, TheMarginIsAShareOfTheSide) {
  SeenBoard seen({kNarrow});
  seen.options.carving.margin_share = 0.2;  // up to 74.8
  EXPECT_EQ(seen.carve(frame_before_board()), 0U);
  seen.options.carving.margin_share = 0.15;  // up to 72.7
  EXPECT_EQ(seen.carve(frame_before_board()), 2U * kNumRows);
}

TEST(BoxCarving, WhatIsHiddenOrNotMeasuredStays) {
  for (const float depth_m : {1.9F, 2.2F, 0.0F}) {
    RgbdFrame frame = frame_before_board();
    for (int v = 0; v < 101; ++v) {
      for (int u = 71; u < 101; ++u) frame.depth_m.at(u, v) = depth_m;
    }
    EXPECT_EQ(SeenBoard({kNarrow}).carve(frame), 0U) << depth_m;
  }
}

// At 2 m one and a half cells of 1 cm and three times 6.1 mm are 3.3 cm; the centres lie at 2.005
// m.
TEST(BoxCarving, DepthMayDifferByCellAndNoise) {
  RgbdFrame frame = frame_before_board();
  frame.depth_m = DepthImage(101, 101, 2.035F);
  EXPECT_EQ(SeenBoard({kNarrow}).carve(frame), 4U * kNumRows);
  frame.depth_m = DepthImage(101, 101, 2.045F);
  EXPECT_EQ(SeenBoard({kNarrow}).carve(frame), 0U);
}

TEST(BoxCarving, OutsideTheImageAndBehindTheCameraNothingIsSeen) {
  RgbdFrame frame = frame_before_board();
  frame.map_from_camera = test::camera_at({0, 0, 0}, 3.14159265358979, 0.0);
  EXPECT_EQ(SeenBoard({kNarrow}).carve(frame), 0U);
  frame = frame_before_board();
  frame.map_from_camera = test::camera_at({0, 0.6, 0}, 0.0, 0.0);  // 30 pixels to the left
  frame.camera.cx_px = 0.0;
  EXPECT_EQ(SeenBoard({{-20, 40, -5, 60}}).carve(frame), 0U) << "u from 5.2 to 54.1: all outside";
}

/// Background on all columns of the image from that one on.
BackgroundCells background_from(int u_px) {
  BackgroundCells cells{
      .rect = {0, 0, 101, 101}, .block_px = 1, .is_background = MaskImage(101, 101)};
  for (int v = 0; v < 101; ++v) {
    for (int u = u_px; u < 101; ++u) cells.is_background.at(u, v) = 1;
  }
  return cells;
}

// Columns 45 to 49 are seen at u = 70.2, 71.2, 72.2, 73.2 and 74.2, their pixels are 70 to 74.
TEST(BoxCarving, WhatIsSeenAmidTheBackgroundLosesAVote) {
  SeenBoard seen({kWhole});
  seen.observations[0].segment.background = background_from(72);
  EXPECT_EQ(seen.carve(frame_before_board()), 2U * kNumRows) << "pixel 72 is beside what is none";
  EXPECT_EQ(seen.cells_by_votes(), (std::map<std::uint32_t, int>{{2, 20}, {3, 480}}));
  seen.options.carving.rule = BoxCarvingRule::kBoxes;
  EXPECT_EQ(seen.carve(frame_before_board()), 0U);
}

TEST(BoxCarving, AFrameTakesOneVoteOfACell) {
  SeenBoard seen({kNarrow});                                      // columns 46 to 49
  seen.observations[0].segment.background = background_from(69);  // columns 45 to 49
  EXPECT_EQ(seen.carve(frame_before_board()), 5U * kNumRows);
  EXPECT_EQ(seen.cells_by_votes(), (std::map<std::uint32_t, int>{{2, 50}, {3, 450}}));
}

TEST(BoxCarving, BackgroundSpeaksAgainstAnyShare) {
  SeenBoard seen({kPart});  // leaves out too much to count itself
  seen.observations[0].segment.background = background_from(50);
  EXPECT_EQ(seen.carve(frame_before_board()), 24U * kNumRows) << "from u = 51.2 on";
}

TEST(BoxCarving, BackgroundThatHidesOrIsHiddenSaysNothing) {
  for (const float depth_m : {1.9F, 2.2F, 0.0F}) {
    SeenBoard seen({kWhole});
    seen.observations[0].segment.background = background_from(71);
    RgbdFrame frame = frame_before_board();
    frame.depth_m = DepthImage(101, 101, depth_m);
    EXPECT_EQ(seen.carve(frame), 0U) << depth_m;
  }
}

TEST(BoxCarving, StraysAloneAreLeftInTheBackground) {
  SeenBoard seen({kWhole});
  const ObjectId id = seen.association.matched[0];
  seen.objects.modify(id, [](Object& object) {
    const std::vector<Eigen::Vector3f> board = points_of_board();
    for (int i = 0; i < 40; ++i) object.points.observe(board);
    // One more, far beside it, once.
    object.points.observe(std::vector<Eigen::Vector3f>{{2.005F, -0.905F, 0.005F}});
  });
  seen.observations[0].segment.background = background_from(90);
  EXPECT_EQ(seen.carve(frame_before_board()), 0U);
}

TEST(BoxCarving, TwoDetectionsOfOneObjectMayShowPartsOfIt) {
  EXPECT_EQ(SeenBoard({kNarrow, kNarrow}).carve(frame_before_board()), 0U);
}

TEST(BoxCarving, RuleNoneLeavesAllAsItIs) {
  SeenBoard seen({kNarrow});
  seen.options.carving.rule = BoxCarvingRule::kNone;
  EXPECT_EQ(seen.carve(frame_before_board()), 0U);
  EXPECT_EQ(SeenBoard({kWhole}).carve(frame_before_board()), 0U);
}

}  // namespace
}  // namespace hypermap
