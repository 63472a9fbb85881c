// SPDX-License-Identifier: BSD-3-Clause
#include "seen_surfaces.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hypermap {
namespace {

/// A sheet of 0.1 m by 0.1 m at a height of 2 cm.
PlacedObject sheet() {
  const std::array<Eigen::Vector3d, 4> corners{Eigen::Vector3d(0, 0, 0.02),
                                               Eigen::Vector3d(0.1, 0, 0.02),
                                               Eigen::Vector3d(0.1, 0.1, 0.02),
                                               Eigen::Vector3d(0, 0.1, 0.02)};
  return {.id = ObjectId{1},
          .class_name = "book",
          .mesh = MeshBuilder().sheet(corners).build(),
          .footprint = make_polygon({{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}}).value()};
}

/// Four pixels from 1 m below it, 5.1 cm apart there: at x = 0, 0.051, 0.102, 0.153.
SimulatedFrame four_pixels(const std::vector<ObjectId>& ids, const std::vector<float>& depth_m) {
  SimulatedFrame frame;
  frame.frame.camera = {4, 1, 20.0, 20.0, 0.0, 0.0};
  frame.frame.depth_m = DepthImage(4, 1);
  frame.instances = InstanceImage(4, 1);
  std::copy(ids.begin(), ids.end(), frame.instances.pixels().begin());
  std::copy(depth_m.begin(), depth_m.end(), frame.frame.depth_m.pixels().begin());
  frame.true_pose = MapFromCamera(Eigen::Isometry3d(Eigen::Translation3d(0, 0.001, -1)));
  return frame;
}

TEST(SeenSurfaces, OnlyMeasuredPixelsOfTheObjectOnItsSurfaceCount) {
  const std::vector objects{sheet()};
  SeenSurfaces surfaces(objects, {false});
  EXPECT_TRUE(surfaces.surfaces().objects.at(0).seen_cells.empty());
  constexpr ObjectId kSheet{1};
  const auto add = [&](const SimulatedFrame& frame) { surfaces.add(surfaces.seen_in(frame)); };
  add(four_pixels({kNoObject, ObjectId{2}, kSheet, kSheet}, {1.02F, 1.02F, 0.0F, 1.5F}));
  EXPECT_TRUE(surfaces.surfaces().objects.at(0).seen_cells.empty());
  add(four_pixels({kSheet, kNoObject, kNoObject, kSheet}, {1.02F, 1.02F, 1.02F, 1.02F}));
  add(four_pixels({kSheet, kSheet, kNoObject, kNoObject}, {1.02F, 1.02F, 1.02F, 1.02F}));
  const TrueSurfaces seen = surfaces.surfaces();
  // The last pixel's cell (3, 0, 0) has its centre 7.5 cm from the sheet.
  EXPECT_THAT(seen.objects.at(0).seen_cells,
              testing::ElementsAre(SurfaceCell{0, 0, 0}, SurfaceCell{1, 0, 0}));
  EXPECT_EQ(seen.objects.at(0).class_name, "book");
  EXPECT_FALSE(seen.objects.at(0).is_nameable);
  EXPECT_EQ(seen.objects.at(0).triangles.size(), 2U);
  EXPECT_TRUE(validate(seen));
}

TEST(SeenSurfaces, TheFootprintIsSeenWhereItsColumnsAre) {
  // Four columns of 5 cm have their middle in the footprint, two of them were seen; (2, 0) lies
  // beside it.
  TrueSurface surface{.seen_cells = {{0, 0, 0}, {0, 0, 3}, {1, 0, 0}, {2, 0, 0}}};
  const Polygon footprint = sheet().footprint;
  EXPECT_DOUBLE_EQ(seen_footprint_share(surface, 0.05, footprint), 0.5);
  surface.seen_cells.clear();
  EXPECT_DOUBLE_EQ(seen_footprint_share(surface, 0.05, footprint), 0.0);
  // A pen between the middles of columns.
  const Polygon pen = make_polygon({{0.03, 0.0}, {0.04, 0.0}, {0.04, 0.2}, {0.03, 0.2}}).value();
  EXPECT_DOUBLE_EQ(seen_footprint_share(surface, 0.05, pen), 0.0);
  surface.seen_cells = {{0, 1, 0}};
  EXPECT_DOUBLE_EQ(seen_footprint_share(surface, 0.05, pen), 1.0);
}

}  // namespace
}  // namespace hypermap
