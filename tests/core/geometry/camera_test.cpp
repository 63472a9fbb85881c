// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/camera.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hypermap {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

PinholeCamera kinect() {
  return {
      .width_px = 640, .height_px = 480, .fx_px = 500, .fy_px = 250, .cx_px = 320, .cy_px = 240};
}

// [smap] 3.1, u = f x / z: (420 - 320) / 500 * 2 = 0.4; (340 - 240) / 250 * 2 = 0.8.
TEST(PinholeCamera, UnprojectsAHandWorkedPixel) {
  const PointInCamera point = kinect().unproject(420, 340, 2.0);
  EXPECT_DOUBLE_EQ(point.xyz.x(), 0.4);
  EXPECT_DOUBLE_EQ(point.xyz.y(), 0.8);
  EXPECT_DOUBLE_EQ(point.xyz.z(), 2.0);
}

TEST(PinholeCamera, ProjectUndoesUnproject) {
  for (const double u : {-10.0, 0.0, 123.25, 639.0}) {
    const auto seen = kinect().project(kinect().unproject(u, 17.5, 3.0));
    ASSERT_TRUE(seen.has_value());
    EXPECT_NEAR(seen->u_px, u, 1e-9);
    EXPECT_NEAR(seen->v_px, 17.5, 1e-9);
  }
}

TEST(PinholeCamera, SeesNothingAtOrBehindItsCentre) {
  EXPECT_FALSE(kinect().project({{0, 0, 0}}).has_value());
  EXPECT_FALSE(kinect().project({{0, 0, -1}}).has_value());
  EXPECT_FALSE(kinect().project({{0, 0, kNaN}}).has_value());
}

struct BadCamera {
  const char* field;
  PinholeCamera camera;
};

class CameraRules : public testing::TestWithParam<BadCamera> {};

TEST_P(CameraRules, NameTheBrokenField) {
  const Result<void> checked = validate(GetParam().camera);
  ASSERT_FALSE(checked.has_value());
  EXPECT_EQ(checked.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(checked.error().field, GetParam().field);
}

PinholeCamera with(void (*change)(PinholeCamera&)) {
  PinholeCamera camera = kinect();
  change(camera);
  return camera;
}

INSTANTIATE_TEST_SUITE_P(
    Fields,
    CameraRules,
    testing::Values(BadCamera{"width_px", with([](PinholeCamera& c) { c.width_px = 0; })},
                    BadCamera{"height_px", with([](PinholeCamera& c) { c.height_px = 65536; })},
                    BadCamera{"fx_px", with([](PinholeCamera& c) { c.fx_px = kNaN; })},
                    BadCamera{"fy_px", with([](PinholeCamera& c) { c.fy_px = -1; })},
                    BadCamera{"cx_px", with([](PinholeCamera& c) { c.cx_px = 961; })},
                    BadCamera{"cy_px", with([](PinholeCamera& c) { c.cy_px = kNaN; })}));

TEST(CameraRules, AllowACentreHalfASideOutside) {
  PinholeCamera camera = kinect();
  camera.cx_px = 960;
  camera.cy_px = -240;
  EXPECT_TRUE(validate(camera).has_value());
}

}  // namespace
}  // namespace hypermap
