// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/snapshot/snapshot_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace hypermap {
namespace {

using testing::HasSubstr;

TEST(SnapshotView, IsReadFromItsName) {
  EXPECT_TRUE(std::holds_alternative<TopView>(parse_snapshot_view("top").value()));
  EXPECT_TRUE(std::holds_alternative<IsoView>(parse_snapshot_view("iso").value()));
}

// A quarter turn about z: x of the camera points along y of the map.
TEST(SnapshotView, IsReadFromAPoseAsTrajectoriesWriteIt) {
  for (const char* text : {"1 2 3 0 0 0.7071067811865476 0.7071067811865476",
                           "1,2,3, 0,0,0.7071067811865476,0.7071067811865476"}) {
    const auto view = parse_snapshot_view(text);
    ASSERT_TRUE(view) << text;
    const MapFromCamera& pose = std::get<PoseView>(*view).map_from_camera;
    EXPECT_EQ(pose.origin().xyz, Eigen::Vector3d(1, 2, 3));
    EXPECT_LT((pose * PointInCamera{{1, 0, 0}}).xyz.x() - 1.0, 1e-12);
    EXPECT_NEAR((pose * PointInCamera{{1, 0, 0}}).xyz.y(), 3.0, 1e-12);
  }
}

TEST(SnapshotView, SaysWhatItMustBe) {
  for (const char* text :
       {"", "side", "1 2 3", "1 2 3 0 0 0 1 9", "1 2 3 0 0 0 nan", "1 2 x 0 0 0 1"}) {
    const auto view = parse_snapshot_view(text);
    ASSERT_FALSE(view) << text;
    EXPECT_THAT(view.error().what, HasSubstr("top, iso or seven numbers"));
  }
  EXPECT_THAT(parse_snapshot_view("0 0 0 0 0 0 2").error().what, HasSubstr("length 1, has 2"));
}

TEST(SnapshotLayers, AreReadFromTheirNames) {
  EXPECT_EQ(parse_snapshot_layers("voxels,semantic").value(),
            (SnapshotLayers{.voxels = true, .semantic = true}));
  EXPECT_EQ(parse_snapshot_layers("all").value(),
            (SnapshotLayers{true, true, true, true, true, true}));
  EXPECT_THAT(parse_snapshot_layers("voxels,boxes").error().what, HasSubstr("is \"boxes\""));
  EXPECT_FALSE(parse_snapshot_layers(""));
}

TEST(SnapshotSize, IsReadStrictly) {
  EXPECT_EQ(parse_image_size("1280x720").value(), (SnapshotSize{1280, 720}));
  for (const char* text :
       {"", "1280", "1280x", "x720", "1280x720x3", "12.5x720", "1280X720", "-64x64"}) {
    EXPECT_FALSE(parse_image_size(text)) << text;
  }
  EXPECT_THAT(parse_image_size("9000x720").error().what, HasSubstr("64..8192, is 9000"));
}

TEST(SnapshotOptions, AreValidByDefault) {
  EXPECT_TRUE(validate(SnapshotOptions{}));
}

TEST(SnapshotOptions, NameTheFieldThatBreaksItsRule) {
  const auto field = [](const SnapshotOptions& options) { return validate(options).error().field; };
  EXPECT_EQ(field({.width_px = 63}), "width_px");
  EXPECT_EQ(field({.height_px = 8193}), "height_px");
  EXPECT_EQ(field({.supersampling = 0}), "supersampling");
  EXPECT_EQ(field({.width_px = 8192, .height_px = 8192}), "supersampling");
  EXPECT_EQ(field({.cut_above_m = std::numeric_limits<double>::quiet_NaN()}), "cut_above_m");
  EXPECT_EQ(field({.view = IsoView{.elevation_deg = 90.0}}), "elevation_deg");
  EXPECT_EQ(field({.view = PoseView{.horizontal_fov_deg = 180.0}}), "horizontal_fov_deg");
  EXPECT_EQ(field({.view = PoseView{.camera = PinholeCamera{}}}), "width_px");
}

}  // namespace
}  // namespace hypermap
