// SPDX-License-Identifier: BSD-3-Clause
// Detections of classes that do not stay are no part of the map.
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace hypermap {
namespace {

constexpr PinholeCamera kCamera{160, 120, 131.25, 131.25, 79.5, 59.5};
constexpr float kWallM = 3.0F;
constexpr float kPersonM = 1.5F;

/// A wall, and before it a person in columns [left, left + 24) from row 20 down.
RgbdFrame walked_frame(int left, ClassId person) {
  RgbdFrame frame;
  frame.camera = kCamera;
  frame.depth_m = DepthImage(kCamera.width_px, kCamera.height_px, kWallM);
  for (int v = 20; v < kCamera.height_px; ++v) {
    for (int u = left; u < left + 24; ++u) frame.depth_m.at(u, v) = kPersonM;
  }
  frame.detections = {{.box_px = {left - 1.0, 19.0, left + 25.0, 120.0},
                       .class_scores = {{person, Probability(1.0)}},
                       .score = Probability(0.9),
                       .detector = {},
                       .mask = {}}};
  return frame;
}

/// Occupied voxels between camera and wall, and those of the wall.
struct Occupied {
  std::size_t before_wall = 0;
  std::size_t at_wall = 0;
};

Occupied occupied_in(const SemanticOctree& octree) {
  Occupied count;
  octree.for_each_leaf([&count](const LeafSample& leaf) {
    if (!leaf.occupied) return;
    ++(leaf.centre_in_map.z() < 2.5 ? count.before_wall : count.at_wall);
  });
  return count;
}

SemanticMapper map_of_walk(const std::vector<std::string>& transient) {
  SemanticMapperOptions options;
  options.objects.transient_class_names = transient;
  ClassRegistry classes;
  const ClassId person = classes.add("person").value();
  SemanticMapper mapper = SemanticMapper::create(options, classes).value();
  for (int i = 0; i < 3; ++i) {
    RgbdFrame frame = walked_frame(20 + 4 * i, person);
    frame.index = static_cast<std::uint64_t>(i);
    const FrameReport report = mapper.integrate(frame).value();
    EXPECT_EQ(report.num_detections, 1U);
    EXPECT_EQ(report.num_transient, transient.size());
    EXPECT_EQ(report.num_segments, 1U - transient.size());
  }
  return mapper;
}

/// The only class of these maps.
constexpr ClassId kPerson{0};

SemanticMapper mapper_without_people(SemanticMapperOptions options = {}) {
  options.objects.transient_class_names = {"person"};
  ClassRegistry classes;
  EXPECT_EQ(classes.add("person").value(), kPerson);
  return SemanticMapper::create(options, classes).value();
}

/// Of whom people are out of the range of segmentation.
SemanticMapperOptions short_sighted() {
  SemanticMapperOptions options;
  options.objects.segmentation.max_range_m = kPersonM / 2;
  return options;
}

TEST(TransientClasses, ArePeopleUnlessOptionsSayOtherwise) {
  ClassRegistry classes;
  EXPECT_TRUE(classes.add("chair"));
  SemanticMapper mapper = SemanticMapper::create({}, classes).value();  // nobody knows people yet
  const ClassId person = classes.add("person").value();
  ASSERT_TRUE(mapper.set_classes(classes));
  EXPECT_EQ(mapper.integrate(walked_frame(20, person)).value().num_transient, 1U);
  EXPECT_EQ(occupied_in(mapper.octree()).before_wall, 0U);
  EXPECT_EQ(mapper.objects().size(), 0U);
}

TEST(TransientClasses, OfAnotherNameThatNoClassHasAreAnError) {
  SemanticMapperOptions options;
  options.objects.transient_class_names = {"person", "persn"};
  const auto refused = SemanticMapper::create(options, ClassRegistry());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kNotFound);
  EXPECT_NE(refused.error().what.find("persn"), std::string::npos);
}

TEST(TransientClasses, OthersAreMapped) {
  const SemanticMapper mapper = map_of_walk({});
  EXPECT_GT(occupied_in(mapper.octree()).before_wall, 100U);
  EXPECT_EQ(mapper.objects().size(), 1U);
}

TEST(TransientClasses, LeaveNoVoxelWhereTheyAreTooFarToBeSegmented) {
  SemanticMapper mapper = mapper_without_people(short_sighted());
  const FrameReport report = mapper.integrate(walked_frame(20, kPerson)).value();
  EXPECT_EQ(report.num_transient, 1U);
  EXPECT_EQ(report.integration.num_transient, 26U * 101U) << "the box, not only who is in it";
  EXPECT_EQ(report.integration.num_not_measured, 0U);
  const Occupied occupied = occupied_in(mapper.octree());
  EXPECT_EQ(occupied.before_wall, 0U);
  EXPECT_GT(occupied.at_wall, 1000U);
}

// In range the depth was looked at, and nine pixels are no segment.
TEST(TransientClasses, TakeNothingInRangeThatIsTooSmallToBeTheirs) {
  SemanticMapper mapper = mapper_without_people();
  RgbdFrame frame = walked_frame(20, kPerson);
  std::ranges::fill(frame.depth_m.pixels(), kWallM);
  frame.detections[0].box_px = {20.0, 20.0, 23.0, 23.0};
  const FrameReport report = mapper.integrate(frame).value();
  EXPECT_EQ(report.num_transient, 1U);
  EXPECT_EQ(report.integration.num_transient, 0U);
  EXPECT_EQ(report.integration.num_hits, frame.depth_m.pixels().size());
}

TEST(TransientClasses, HideMeasurementsAlone) {
  SemanticMapper mapper = mapper_without_people(short_sighted());
  RgbdFrame frame = walked_frame(20, kPerson);
  frame.depth_m.at(25, 50) = 0.0F;
  frame.depth_m.at(26, 50) = std::numeric_limits<float>::quiet_NaN();
  frame.depth_m.at(27, 50) = 0.5F;  // nearer than what could not be segmented
  const FrameReport report = mapper.integrate(frame).value();
  EXPECT_EQ(report.integration.num_transient, 26U * 101U - 3U);
  EXPECT_EQ(report.integration.num_not_measured, 1U);
  EXPECT_EQ(report.integration.num_not_finite, 1U);
}

TEST(TransientClasses, AreLeftOutByTheirMasksWhereTheyHaveThem) {
  SemanticMapper mapper = mapper_without_people(short_sighted());
  RgbdFrame frame = walked_frame(20, kPerson);
  MaskImage mask(kCamera.width_px, kCamera.height_px);
  for (int v = 20; v < 60; ++v) {
    for (int u = 20; u < 44; ++u) mask.at(u, v) = 1;
  }
  frame.detections[0].mask = mask;
  const FrameReport report = mapper.integrate(frame).value();
  // 160 pixels make squares of one pixel: the mask may be off by one and a half, rounded up.
  EXPECT_EQ(report.integration.num_transient, (24U + 4U) * (40U + 4U));
}

TEST(TransientClasses, MakeNoDifferenceToTheOthersWhenTheyComeTooLate) {
  SemanticMapper mapper =
      mapper_without_people({.deadline = {.rule = DeadlineRule::kFixed, .frame_s = 1.0}});
  mapper.set_clock([now = 0.0]() mutable { return now += 1e6; });  // always too late
  const FrameReport report = mapper.integrate(walked_frame(20, kPerson)).value();
  EXPECT_EQ(report.num_deadline_dropped, 0U);
  EXPECT_TRUE(report.visibility_evaluated);
  EXPECT_EQ(occupied_in(mapper.octree()).before_wall, 0U);
  RgbdFrame both = walked_frame(20, kPerson);
  both.detections.push_back(both.detections[0]);
  both.detections[1].class_scores = {{ClassId{1}, Probability(1.0)}};
  const FrameReport second = mapper.integrate(both).value();
  EXPECT_EQ(second.num_deadline_dropped, 1U);
  EXPECT_FALSE(second.visibility_evaluated);
}

TEST(TransientClasses, LeaveNoObjectAndNoVoxel) {
  const SemanticMapper mapper = map_of_walk({"person"});
  const Occupied occupied = occupied_in(mapper.octree());
  EXPECT_EQ(occupied.before_wall, 0U);
  EXPECT_GT(occupied.at_wall, 1000U);
  EXPECT_TRUE(mapper.objects().empty());
}

}  // namespace
}  // namespace hypermap
