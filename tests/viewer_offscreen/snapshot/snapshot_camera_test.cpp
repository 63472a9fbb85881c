// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/snapshot/snapshot_camera.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <vector>

namespace hypermap {
namespace {

/// Two corners of a slab of 4 m x 2 m x 1 m.
std::vector<Eigen::Vector3d> slab() {
  return {{0, 0, 0}, {4, 2, 1}};
}

// 4 m across 800 px and 2 m across 600 px: the width decides, 200 px per metre. The area starts at
// (100, 50), so x = 0 lies on its left edge; its middle is at (500, 350), where (2, 1) falls.
TEST(SnapshotCamera, TopViewIsToScaleWithNorthUp) {
  const SnapshotOptions options{.view = TopView{}, .width_px = 1000, .height_px = 700};
  const auto camera = SnapshotCamera::frame(options, slab(), {100, 50, 800, 600});
  EXPECT_DOUBLE_EQ(camera.pixels_per_m().value(), 200.0);
  const auto middle = camera.project({2, 1, 0.5}).value();
  EXPECT_NEAR(middle.u_px, 499.5, 1e-9);  // half a pixel: the centre of pixel 0 is 0
  EXPECT_NEAR(middle.v_px, 349.5, 1e-9);
  const auto east = camera.project({3, 1, 0.5}).value();
  EXPECT_NEAR(east.u_px - middle.u_px, 200.0, 1e-9);
  EXPECT_NEAR(east.v_px - middle.v_px, 0.0, 1e-9);
  const auto north = camera.project({2, 2, 0.5}).value();
  EXPECT_NEAR(north.u_px - middle.u_px, 0.0, 1e-9);
  EXPECT_NEAR(north.v_px - middle.v_px, -200.0, 1e-9);
}

// Seen from 30 degrees over the horizon an upright metre appears cos 30 = 0.866 as long.
TEST(SnapshotCamera, IsoViewForeshortensByItsElevation) {
  const SnapshotOptions options{.view = IsoView{.azimuth_deg = -90.0, .elevation_deg = 30.0}};
  const auto camera = SnapshotCamera::frame(options, slab(), {0, 0, 1280, 720});
  const double scale = camera.pixels_per_m().value();
  const auto foot = camera.project({1, 1, 0}).value();
  const auto head = camera.project({1, 1, 1}).value();
  EXPECT_NEAR(head.u_px - foot.u_px, 0.0, 1e-9);
  EXPECT_NEAR(foot.v_px - head.v_px, scale * 0.86602540378, 1e-6);
  // From the south, east is on the right.
  EXPECT_NEAR(camera.project({2, 1, 0}).value().u_px - foot.u_px, scale, 1e-9);
}

TEST(SnapshotCamera, AllFramedPointsFallIntoTheArea) {
  const ImageRect area{30, 60, 700, 400};
  for (const double azimuth_deg : {-120.0, -30.0, 45.0, 170.0}) {
    const SnapshotOptions options{.view = IsoView{.azimuth_deg = azimuth_deg}};
    const auto camera = SnapshotCamera::frame(options, slab(), area);
    for (const Eigen::Vector3d& point : slab()) {
      const auto pixel = camera.project(point).value();
      EXPECT_GE(pixel.u_px, area.x_px - 0.5 - 1e-6);
      EXPECT_LE(pixel.u_px, area.x_px + area.width_px - 0.5 + 1e-6);
      EXPECT_GE(pixel.v_px, area.y_px - 0.5 - 1e-6);
      EXPECT_LE(pixel.v_px, area.y_px + area.height_px - 0.5 + 1e-6);
    }
  }
}

// The oracle is the pinhole camera itself.
TEST(SnapshotCamera, PoseViewSeesWhatTheCameraSees) {
  const PinholeCamera pinhole{640, 480, 525.0, 520.0, 319.5, 230.0};
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(Eigen::Vector3d(1, 2, 3));
  pose.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()));
  const MapFromCamera map_from_camera(pose);
  const SnapshotOptions options{
      .view = PoseView{map_from_camera, pinhole}, .width_px = 640, .height_px = 480};
  const auto camera = SnapshotCamera::frame(options, slab(), {0, 0, 640, 480});
  EXPECT_FALSE(camera.pixels_per_m().has_value());
  for (const PointInCamera& point : {PointInCamera{{0, 0, 2}}, PointInCamera{{0.4, -0.3, 1.5}}}) {
    const auto seen = camera.project((map_from_camera * point).xyz).value();
    const auto expected = pinhole.project(point).value();
    EXPECT_NEAR(seen.u_px, expected.u_px, 1e-6);
    EXPECT_NEAR(seen.v_px, expected.v_px, 1e-6);
  }
  EXPECT_FALSE(camera.project((map_from_camera * PointInCamera{{0, 0, -1}}).xyz).has_value());
}

// At twice the size each pixel of the small image becomes 2 x 2: u = 10 spans 20 and 21.
TEST(SnapshotCamera, PoseViewScalesTheCameraToTheImage) {
  const PinholeCamera pinhole{320, 240, 250.0, 250.0, 160.0, 120.0};
  const SnapshotOptions options{
      .view = PoseView{MapFromCamera(), pinhole}, .width_px = 640, .height_px = 480};
  const auto camera = SnapshotCamera::frame(options, slab(), {0, 0, 640, 480});
  const auto seen = camera.project(pinhole.unproject(10, 20, 2.0).xyz).value();
  EXPECT_NEAR(seen.u_px, 20.5, 1e-9);
  EXPECT_NEAR(seen.v_px, 40.5, 1e-9);
}

// A field of view of 90 degrees: what lies 45 degrees to the right is on the right edge.
TEST(SnapshotCamera, PoseViewHasTheFieldOfViewAskedFor) {
  const SnapshotOptions options{.view = PoseView{.horizontal_fov_deg = 90.0}};
  const auto camera = SnapshotCamera::frame(options, slab(), {0, 0, 1280, 720});
  EXPECT_NEAR(camera.project({1, 0, 1}).value().u_px, 1279.5, 1e-6);
}

TEST(SnapshotCamera, NothingToFrameGivesAView) {
  const SnapshotOptions options{.view = TopView{}};
  const auto empty = SnapshotCamera::frame(options, {}, {0, 0, 200, 200});
  EXPECT_DOUBLE_EQ(empty.pixels_per_m().value(), 100.0);
  const std::vector<Eigen::Vector3d> one{{5, 5, 5}};
  EXPECT_DOUBLE_EQ(SnapshotCamera::frame(options, one, {0, 0, 200, 100}).pixels_per_m().value(),
                   100.0);
}

}  // namespace
}  // namespace hypermap
