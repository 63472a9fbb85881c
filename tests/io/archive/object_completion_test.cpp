// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/object_completion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace hypermap {
namespace {

Object chair(const std::vector<int>& bins, const Box& box) {
  Object object;
  object.box = box;
  for (const int bin : bins) {
    const double bearing_rad = (bin + 0.5) * 2.0 * M_PI / ObservationLog::kNumBearingBins;
    object.observation_log.add({.bearing_rad = static_cast<float>(bearing_rad)});
  }
  return object;
}

/// Two chairs of 0.5 m by 0.4 m that were seen from all sides, and the back of one from the west.
MapArchive chairs() {
  MapArchive archive;
  EXPECT_TRUE(archive.classes.add("chair"));
  archive.objects.add(chair({0, 4, 9, 13}, {{5.0, 0.0, 0.0}, {5.4, 0.5, 0.8}}));
  archive.objects.add(chair({0, 4, 9, 13}, {{6.0, 0.0, 0.0}, {6.4, 0.5, 0.8}}));
  archive.objects.add(chair({9}, {{1.0, 0.0, 0.0}, {1.1, 0.5, 0.8}}));
  return archive;
}

TEST(CompletedBoxes, AreOfTheConfirmedObjectsThatWereNotSeenWhole) {
  const auto boxes = completed_boxes(chairs());
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_TRUE(boxes.at(ObjectId{3}).min_in_map.isApprox(Eigen::Vector3d(1.0, 0.0, 0.0)));
  EXPECT_TRUE(boxes.at(ObjectId{3}).max_in_map.isApprox(Eigen::Vector3d(1.4, 0.5, 0.8)));
  EXPECT_TRUE(completed_boxes(MapArchive()).empty());
}

TEST(CompletedBoxes, KeepOutOfTheFreeSpaceOfTheOctree) {
  MapArchive archive = chairs();
  std::vector<StoredLeaf> leaves;  // free in the east, occupied (by the table) in the west
  archive.octree = SemanticOctree::create({}).value();
  for (double x = 0.725; x < 1.4; x += 0.05) {
    for (double y = 0.025; y < 0.5; y += 0.05) {
      for (double z = 0.025; z < 0.8; z += 0.05) {
        const auto key = archive.octree->grid().key(PointInMap{Eigen::Vector3d(x, y, z)});
        const MilliLogOdds log_odds = x > 1.1 ? MilliLogOdds{-1000} : MilliLogOdds{1000};
        leaves.push_back({.key = key.value(), .log_odds = log_odds});
      }
    }
  }
  archive.octree = SemanticOctree::from_leaves({}, leaves).value();
  const auto boxes = completed_boxes(archive);
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_NEAR(boxes.at(ObjectId{3}).min_in_map.x(), 0.7, 1e-12);
  EXPECT_NEAR(boxes.at(ObjectId{3}).max_in_map.x(), 1.1, 1e-12);
}

}  // namespace
}  // namespace hypermap
