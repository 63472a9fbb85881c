// SPDX-License-Identifier: BSD-3-Clause
// Parts of a thing that hide each other are one object; what stands side by side is not.
#include "core/objects/association_cases.hpp"
#include "hypermap/core/objects/object_map_merge.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace hypermap {
namespace {

using testing_support::box_at;
using testing_support::kFridge;
using testing_support::kOvenClass;
using testing_support::seen;

/// Two faces of an oven of 0.5 x 0.4 x 0.3 m that meet at an edge.
const Box kFrontFace = box_at({0.25, 0.01, 0.15}, {0.5, 0.02, 0.3});
const Box kSideFace = box_at({-0.01, 0.2, 0.15}, {0.02, 0.4, 0.3});

void see(ObjectMap& map,
         const Box& box,
         std::uint64_t first_frame,
         std::uint64_t end_frame,
         ClassId id = kOvenClass,
         const AssociationOptions& options = {}) {
  for (std::uint64_t frame = first_frame; frame < end_frame; ++frame) {
    (void)associate(map, std::array{seen(box, id, frame)}, options);
  }
}

/// As when it is in view of a frame that shows another one, and not detected.
void miss(ObjectMap& map, ObjectId id, std::uint64_t frame, float visible_share) {
  map.modify(id, [&](Object& object) {
    object.observation_log.add({.frame_index = frame,
                                .stamp = Stamp{static_cast<std::int64_t>(frame) * 100'000'000},
                                .kind = ObservationKind::kMissedDetection,
                                .score = visible_share});
  });
}

TEST(HiddenParts, FacesOfABoxThatWereNeverInViewTogetherAreOne) {
  ObjectMap map;
  see(map, kFrontFace, 0, 6);
  see(map, kSideFace, 6, 9);
  EXPECT_EQ(map.size(), 2U) << "three detections are too few to tell";
  see(map, kSideFace, 9, 10);
  ASSERT_EQ(map.size(), 1U);
  const Object& oven = *map.objects().begin();
  EXPECT_EQ(oven.num_observations, 10U);
  EXPECT_TRUE(oven.box.extent().isApprox(Eigen::Vector3d(0.52, 0.4, 0.3), 0.05))
      << oven.box.extent().transpose();
}

TEST(HiddenParts, TheOptionLeavesThemTwo) {
  AssociationOptions never;
  never.assignment.hidden_part_detections = 0;
  ObjectMap map;
  see(map, kFrontFace, 0, 6, kOvenClass, never);
  see(map, kSideFace, 6, 20, kOvenClass, never);
  EXPECT_EQ(map.size(), 2U);
}

/// Objects of two faces, the first of which was in view of three of the frames that show the other.
std::size_t num_objects_if_visible_by(float visible_share) {
  ObjectMap map;
  see(map, kFrontFace, 0, 6);
  const ObjectId front = map.objects().begin()->id;
  for (std::uint64_t frame = 6; frame < 10; ++frame) {
    if (frame < 9) miss(map, front, frame, visible_share);
    see(map, kSideFace, frame, frame + 1);
  }
  return map.size();
}

TEST(HiddenParts, WhatComesIntoViewTogetherStaysTwo) {
  EXPECT_EQ(num_objects_if_visible_by(0.1F), 2U);
  EXPECT_EQ(num_objects_if_visible_by(0.09F), 1U) << "a sliver is no view of it";
}

TEST(HiddenParts, WhatOneFrameShowedBesideEachOtherStaysTwo) {
  ObjectMap map;
  see(map, kFrontFace, 0, 6);
  (void)associate(
      map, std::array{seen(kFrontFace, kOvenClass, 6), seen(kSideFace, kOvenClass, 6)}, {});
  see(map, kSideFace, 7, 15);
  EXPECT_EQ(map.size(), 2U);
}

TEST(HiddenParts, FewerDetectionsAllowFewerFramesInViewTogether) {
  AssociationOptions soon;
  soon.assignment.hidden_part_detections = 3;
  const auto num_objects = [&](std::uint64_t num_misses) {
    ObjectMap map;
    see(map, kFrontFace, 0, 6, kOvenClass, soon);
    const ObjectId front = map.objects().begin()->id;
    for (std::uint64_t frame = 6; frame < 9; ++frame) {
      if (frame < 6 + num_misses) miss(map, front, frame, 0.5F);
      see(map, kSideFace, frame, frame + 1, kOvenClass, soon);
    }
    return map.size();
  };
  EXPECT_EQ(num_objects(2), 2U) << "it was in view of both frames that could say so";
  EXPECT_EQ(num_objects(1), 1U);
}

TEST(HiddenParts, WhatIsLookedThroughIsNoPart) {
  ObjectMap map;
  see(map, kFrontFace, 0, 6);
  map.modify(map.objects().begin()->id, [](Object& object) {
    object.observation_log.add({.frame_index = 6,
                                .stamp = Stamp{600'000'000},
                                .kind = ObservationKind::kMissedDetection,
                                .visibility = Visibility::kAbsent,
                                .score = 0.05F});
  });
  see(map, kSideFace, 7, 12);
  EXPECT_EQ(map.size(), 2U) << "it may have been moved here";
}

TEST(HiddenParts, WhatIsHardlyRealIsNoPart) {
  // Four detections of one view and eight frames that missed nearly all of it:
  // -0.08 + 2.62 ln 4 - 2.18 ln 8.2 = -1.04, so that P(real) is 0.26.
  ObjectMap map;
  see(map, kFrontFace, 0, 6);
  const ObjectId front = map.objects().begin()->id;
  see(map, kSideFace, 6, 9);
  ASSERT_EQ(map.size(), 2U);
  const ObjectId side = (++map.objects().begin())->id;
  ASSERT_NE(side, front);
  for (std::uint64_t frame = 9; frame < 17; ++frame) miss(map, side, frame, 0.9F);
  see(map, kSideFace, 17, 18);
  EXPECT_EQ(map.size(), 2U);
}

TEST(HiddenParts, OfAnotherClassIsNoPart) {
  ObjectMap map;
  see(map, kFrontFace, 0, 6, kOvenClass);
  see(map, kSideFace, 6, 12, kFridge);
  EXPECT_EQ(map.size(), 2U);
}

// Five frames of one view say fridge, up to four of four other views oven: by the sum of log-odds
// a fridge still; by views, as it is shown, an oven by (4 sqrt(1))^2 to sqrt(5)^2 = 16 to 5.
TEST(HiddenParts, TheClassIsTheOneThatViewsSay) {
  ObjectMap map;
  see(map, kFrontFace, 0, 6, kOvenClass);
  const auto see_side = [&](ClassId id, std::uint64_t frame, double bearing_rad) {
    Observation side = seen(kSideFace, id, frame);
    side.bearing_rad = bearing_rad;
    (void)associate(map, std::array{side}, {});
  };
  for (std::uint64_t frame = 6; frame < 11; ++frame) see_side(kFridge, frame, 3.0);
  ASSERT_EQ(map.size(), 2U);
  const ObjectId side = (++map.objects().begin())->id;
  for (std::uint64_t frame = 11; frame < 15; ++frame) {
    see_side(kOvenClass, frame, 0.5 * static_cast<double>(frame - 11));
    if (map.size() == 1) break;
    ASSERT_EQ(map.at(side).belief.best()->id, kFridge);
  }
  EXPECT_EQ(map.size(), 1U);
}

TEST(HiddenParts, WhatWouldMakeItMuchLargerIsNoPart) {
  // Diagonals: 0.58 m alone, 1.05 m with as large a face beside it, 1.8 times as much.
  ObjectMap map;
  see(map, kFrontFace, 0, 6);
  see(map, box_at({0.76, 0.01, 0.15}, {0.5, 0.02, 0.3}), 6, 12);
  EXPECT_EQ(map.size(), 2U);
}

/// The back of a chair and all that is before it, by boxes of 0.5 x 0.5 x 0.86 m and what is 0.16 m
/// behind: 1.42 times the volume.
const Box kBack = box_at({-0.06, 0.0, 0.65}, {0.2, 0.4, 0.4});
const Box kSeat = box_at({0.3, 0.0, 0.43}, {0.5, 0.5, 0.86});

/// Two things both in view of some frames, the first of which detect both, the others one in turn.
struct InTurn {
  Box first = kBack;
  Box second = kSeat;
  std::uint64_t num_frames = 40;
  std::uint64_t num_both = 1;
  float visible_share = 0.5F;  ///< Of the one that a frame does not detect.
  AssociationOptions options = {};
};

std::size_t num_objects(const InTurn& in_turn) {
  ObjectMap map;
  for (std::uint64_t frame = 0; frame < in_turn.num_frames && map.size() != 1; ++frame) {
    const bool shows_both = frame < in_turn.num_both;
    const bool shows_first = shows_both || frame % 2 == 0;
    const bool shows_second = shows_both || frame % 2 == 1;
    if (!shows_first) miss(map, map.objects().begin()->id, frame, in_turn.visible_share);
    if (!shows_second) miss(map, (++map.objects().begin())->id, frame, in_turn.visible_share);
    std::vector<Observation> all;
    if (shows_first) all.push_back(seen(in_turn.first, kOvenClass, frame));
    if (shows_second) all.push_back(seen(in_turn.second, kOvenClass, frame));
    (void)associate(map, all, in_turn.options);
  }
  return map.size();
}

TEST(HiddenParts, WhatIsDetectedInTurnWhileBothAreInViewIsOne) {
  EXPECT_EQ(num_objects({}), 1U);
  AssociationOptions never;
  never.assignment.hidden_part_detections = 0;
  EXPECT_EQ(num_objects({.options = never}), 2U);
}

// Six that detect both are asked for by chance: of 21 frames 11 detect each, 5.8 both; of 22 11 and
// 12, 6.0 both.
TEST(HiddenParts, InTurnIsToldFromChanceByEnoughFrames) {
  EXPECT_EQ(num_objects({.num_frames = 21}), 2U);
  EXPECT_EQ(num_objects({.num_frames = 22}), 1U);
}

// With k that detect both (20 + k/2)^2 / 40 of 40 are expected to: 11.6 for 3 and 12.1 for 4, of
// which 0.3 are 3.5 and 3.6.
TEST(HiddenParts, WhatManyFramesDetectTogetherIsTwo) {
  EXPECT_EQ(num_objects({.num_both = 3}), 1U);
  EXPECT_EQ(num_objects({.num_both = 4}), 2U);
}

TEST(HiddenParts, WhatIsMostlyHiddenIsNotInViewInTurn) {
  EXPECT_EQ(num_objects({.visible_share = 0.49F}), 2U);
}

TEST(HiddenParts, WhatIsDetectedInTurnAndFillsABoxOfItsOwnIsTwo) {
  const Box deeper = box_at({-0.08, 0.0, 0.65}, {0.24, 0.4, 0.4});  // 1.5 times the volume
  EXPECT_EQ(num_objects({.first = deeper}), 2U);
  const Box beside = box_at({-0.22, 0.0, 0.43}, {0.5, 0.5, 0.86});
  EXPECT_EQ(num_objects({.first = beside}), 2U);
}

TEST(HiddenParts, ASmallThingBesideALargeOneIsNoPart) {
  const Box small = box_at({-0.04, 0.0, 0.2}, {0.15, 0.15, 0.15});  // a quarter of the diagonal
  EXPECT_EQ(num_objects({.first = small}), 2U);
}

TEST(HiddenParts, WhatIsForgottenMayHaveShownBoth) {
  EXPECT_EQ(num_objects({.num_frames = 120, .num_both = 12}), 2U);
}

TEST(HiddenParts, TwoRunsDoNotTellWhatIsInViewTogether) {
  ObjectMap known;
  see(known, kFrontFace, 0, 6);
  ObjectMap added;
  see(added, kSideFace, 100, 106);
  see(added, kFrontFace, 106, 109);  // too seldom to be a part there
  ASSERT_EQ(added.size(), 2U);
  const auto together = merged(known, added, {});
  ASSERT_TRUE(together.has_value());
  EXPECT_EQ(together->objects.size(), 2U);
}

}  // namespace
}  // namespace hypermap
