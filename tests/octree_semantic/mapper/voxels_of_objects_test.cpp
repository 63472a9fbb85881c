// SPDX-License-Identifier: BSD-3-Clause
// An id never outlives its object.
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"
#include "octree_semantic/support/detected_frame.hpp"
#include "support/sanitized.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace hypermap::test {
namespace {

std::set<ObjectId> ids_in(const SemanticOctree& octree) {
  std::set<ObjectId> ids;
  octree.for_each_stored_leaf([&](const StoredLeaf& leaf) {
    if (leaf.label && leaf.label->object != kNoObject) ids.insert(leaf.label->object);
  });
  return ids;
}

std::set<ObjectId> ids_without_object(const SemanticMapper& mapper) {
  std::set<ObjectId> ids = ids_in(mapper.octree());
  std::erase_if(ids, [&](ObjectId id) { return mapper.objects().contains(id); });
  return ids;
}

/// A quarter of the image's height, anywhere in it.
Detection false_alarm(const PinholeCamera& camera, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double edge_px = camera.height_px / 4.0;
  const double u_px = unit(random) * (camera.width_px - edge_px);
  const double v_px = unit(random) * (camera.height_px - edge_px);
  Detection alarm;
  alarm.box_px = {u_px, v_px, u_px + edge_px, v_px + edge_px};
  alarm.class_scores = class_vector(ClassId{static_cast<std::uint32_t>(random() % 8)}, 0.7, 8);
  return alarm;
}

/// Boxes that are lost, moved, bloated, of another class or of nothing now and then, so that
/// objects are made, merged and removed.
RgbdFrame disturbed(RgbdFrame frame, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::erase_if(frame.detections, [&](const Detection&) { return unit(random) < 0.4; });
  for (Detection& detection : frame.detections) {
    if (unit(random) < 0.3) {
      const double by_px = 40.0 * unit(random);
      detection.box_px.u_min_px = std::max(0.0, detection.box_px.u_min_px - by_px);
      detection.box_px.v_max_px += by_px;
    }
    if (unit(random) < 0.2) {
      detection.class_scores =
          class_vector(ClassId{static_cast<std::uint32_t>(random() % 8)}, 0.7, 8);
    }
  }
  frame.detections.push_back(false_alarm(frame.camera, random));
  return frame;
}

TEST(VoxelsOfObjects, EveryIdInTheOctreeIsAnObjectOfTheMap) {
  const std::vector<RgbdFrame> frames = detected_room_frames(16, 160);
  std::size_t num_merged = 0;
  std::size_t num_removed = 0;
  for (unsigned seed = 0; seed < repetitions(4U); ++seed) {
    std::mt19937 random(seed);
    SemanticMapperOptions options;
    options.octree.resolution_m = 0.1;
    // Removed after a few looks, so that 48 frames hold removals whatever the seed.
    options.objects.absence.min_existence = LogOdds{-0.5};
    auto mapper = SemanticMapper::create(options).value();
    for (std::uint64_t i = 0; i < 48; ++i) {
      RgbdFrame frame = disturbed(frames[random() % frames.size()], random);
      frame.index = i;
      const FrameReport report = mapper.integrate(frame).value();
      num_merged += report.num_merged;
      num_removed += report.num_removed;
      ASSERT_EQ(ids_without_object(mapper), std::set<ObjectId>{}) << seed << ", frame " << i;
    }
  }
  EXPECT_GT(num_merged, 0U);
  EXPECT_GT(num_removed, 0U);
}

TEST(VoxelsOfObjects, AMapThatIsGoneOnFromLosesIdsOfNoObject) {
  SemanticMapperOptions options;
  auto mapper = SemanticMapper::create(options).value();
  for (const RgbdFrame& frame : detected_room_frames(4, 160)) ASSERT_TRUE(mapper.integrate(frame));
  ObjectMap fewer = mapper.objects();
  ASSERT_GE(fewer.size(), 2U);
  const std::set<ObjectId> before = ids_in(mapper.octree());
  const ObjectId lost = *before.begin();
  ASSERT_TRUE(fewer.erase(lost));
  const auto resumed = SemanticMapper::resume(options, mapper.octree(), fewer).value();
  EXPECT_EQ(ids_without_object(resumed), std::set<ObjectId>{});
  EXPECT_EQ(ids_in(resumed.octree()).size(), before.size() - 1);
  EXPECT_EQ(resumed.octree().num_leaves(), mapper.octree().num_leaves());
}

}  // namespace
}  // namespace hypermap::test
