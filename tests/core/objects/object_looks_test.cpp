// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_looks.hpp"

#include "association_cases.hpp"
#include "support/camera_pose.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace hypermap {
namespace {

using testing_support::kChairClass;
using testing_support::observed;
using testing_support::scores;

/// A patch of 4 x 4 cells of 1 cm, one block, at y in cells of 4 cm, 2.02 m ahead.
std::vector<Eigen::Vector3f> patch_at(int y) {
  std::vector<Eigen::Vector3f> points;
  points.reserve(16);
  for (int i = 0; i < 16; ++i) {
    const int row = i / 4;
    points.emplace_back(2.025F,
                        0.04F * static_cast<float>(y) + 0.01F * (static_cast<float>(i % 4) + 0.5F),
                        0.01F * (static_cast<float>(row) + 0.5F));
  }
  return points;
}

/// One pixel is a centimetre a metre ahead of it: the patch at y is seen at u = 49 - 2 y.
RgbdFrame frame_of_depth(float depth_m) {
  RgbdFrame frame;
  frame.camera = {
      .width_px = 101, .height_px = 101, .fx_px = 100, .fy_px = 100, .cx_px = 50, .cy_px = 50};
  frame.map_from_camera = test::camera_at({0, 0, 0}, 0.0, 0.0);
  frame.depth_m = DepthImage(101, 101, depth_m);
  return frame;
}

/// An object of two patches, at 0 and 3, of which a frame now matches the first one.
struct TwoPatches {
  ObjectMap objects;
  AssociationOptions options;
  AssociationReport association;
  std::vector<Observation> observations;

  explicit TwoPatches(std::size_t num_matched = 1) {
    auto both = patch_at(0);
    const auto second = patch_at(3);
    both.insert(both.end(), second.begin(), second.end());
    const std::vector<Observation> whole{observed(both, scores(kChairClass, 0.8))};
    const ObjectId id = associate(objects, whole, options).created.at(0);
    associate(objects, whole, options);
    observations.assign(num_matched, observed(patch_at(0), scores(kChairClass, 0.8)));
    for (const Observation& observation : observations) {
      objects.modify(id, [&](Object& object) { update_object(object, observation, options); });
    }
    association.object_of_observation.assign(num_matched, id);
    association.matched = {id};
  }
  /// Looks at the second patch after the third observation.
  std::vector<PointVote> look(const RgbdFrame& frame) {
    look_at_matched(objects, frame, observations, association, options);
    return objects.at(association.matched[0]).points.state().looks;
  }
};

const std::vector<PointVote> kNotSeen{{{50, 3, 0}, 2}};

TEST(ObjectLooks, WhatIsHiddenIsNotInView) {
  EXPECT_EQ(TwoPatches().look(frame_of_depth(1.0F)), kNotSeen);
}

TEST(ObjectLooks, WhatIsShownOrLookedThroughIsInView) {
  EXPECT_TRUE(TwoPatches().look(frame_of_depth(2.02F)).empty());
  EXPECT_TRUE(TwoPatches().look(frame_of_depth(3.0F)).empty());
}

TEST(ObjectLooks, WithoutDepthNothingIsKnown) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(TwoPatches().look(frame_of_depth(none)), kNotSeen);
}

TEST(ObjectLooks, WhatIsOutsideTheImageIsNotInView) {
  RgbdFrame frame = frame_of_depth(2.02F);
  frame.camera.cx_px = 5.0;  // the second patch, at u = 5 - 7
  EXPECT_EQ(TwoPatches().look(frame), kNotSeen);
}

TEST(ObjectLooks, TwoDetectionsOfOneObjectSayNothing) {
  EXPECT_TRUE(TwoPatches(2).look(frame_of_depth(1.0F)).empty());
}

}  // namespace
}  // namespace hypermap
