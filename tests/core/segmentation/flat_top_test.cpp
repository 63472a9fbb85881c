// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/policies/flat_top.hpp"

#include "core/segmentation/office_scene.hpp"
#include "hypermap/core/segmentation/geometric_segmentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hypermap {
namespace {

constexpr int kColumns = 60;
constexpr int kRows = 160;
constexpr int kBoxTop = 40;   // row
constexpr int kWallEnd = 60;  // below this row, above the edge, nothing is measured
constexpr int kEdge = 100;    // the first row of the object

/// A level camera 0.5 m above the top of a box whose front stands 2 m away. Row r falls by
/// (r - 50) / 200 per metre, so the border above row 100 (slope 0.2475) meets the front at
/// -0.495 m; columns are 1 / 50 apart, so the front is 2.4 m wide.
struct FrontOfABox {
  DepthWindow window;
  std::vector<std::uint8_t> is_object;
  Eigen::Matrix3f aligned;

  FrontOfABox() {
    window.rect = {0, 0, kColumns, kRows};
    window.box = {0, kBoxTop, kColumns, kRows};
    constexpr int kMiddle = kColumns / 2;
    for (int x = 0; x < kColumns; ++x) {
      window.slope_x.push_back(static_cast<float>(x - kMiddle) / 50.0F);
    }
    for (int y = 0; y < kRows; ++y) {
      window.slope_y.push_back(static_cast<float>(y - 50) / 200.0F);
    }
    window.depth_m.assign(static_cast<std::size_t>(kColumns) * kRows, 0.0F);
    window.step_m.assign(window.size(), 0.05F);
    is_object.assign(window.size(), 0);
    fill(0, kWallEnd, 6.0F);
    fill(kEdge, kRows, 2.0F);
    std::fill(is_object.begin() + static_cast<std::ptrdiff_t>(window.cell(0, kEdge)),
              is_object.end(),
              std::uint8_t{1});
    aligned << 1, 0, 0, 0, 0, 1, 0, -1, 0;  // y of the camera points down
  }

  void fill(int begin, int end, float depth_m) {
    std::fill(
        window.depth_m.begin() + static_cast<std::ptrdiff_t>(window.cell(0, begin)),
        window.depth_m.begin() + static_cast<std::ptrdiff_t>(window.cell(0, end - 1)) + kColumns,
        depth_m);
  }
  /// From column 40 on another thing stands there, measured from that row on.
  void put_another(int row, float depth_m) {
    for (int x = 40; x < kColumns; ++x) {
      for (int y = std::min(row, kEdge); y < kRows; ++y) {
        is_object[window.cell(x, y)] = 0;
        window.depth_m[window.cell(x, y)] = y < row ? 0.0F : depth_m;
      }
    }
  }
  [[nodiscard]] bool is_left_of_another(const Eigen::Vector3f& point) const {
    return point.x() / point.z() <= window.slope_x[39] + 1e-6F;
  }
  [[nodiscard]] std::vector<Eigen::Vector3f> top() const {
    return unmeasured_top(window, is_object, aligned, 0.02F);
  }
};

TEST(FlatTop, LiesOnThePlaneOfTheEdgeUpToWhereSomethingIsMeasuredAgain) {
  FrontOfABox box;
  // At rows above 79 a pixel covers more than 0.12 m: 0.495 / (s - 0.0025) - 0.495 / (s + 0.0025)
  // is 0.118 m at s = 0.145 (row 79) and 0.126 m at s = 0.140. The wall begins where the top ends.
  box.fill(kWallEnd, 85, 6.0F);
  const auto points = box.top();
  ASSERT_FALSE(points.empty());
  float nearest_m = 100.0F;
  float farthest_m = 0.0F;
  for (const Eigen::Vector3f& point : points) {
    EXPECT_NEAR(point.y(), 0.495F, 1e-4F);
    nearest_m = std::min(nearest_m, point.z());
    farthest_m = std::max(farthest_m, point.z());
  }
  EXPECT_NEAR(nearest_m, 2.0F, 0.02F);
  // Two rows at the wall are what sensors lose at any edge: row 87 ends at slope 0.1825.
  EXPECT_NEAR(farthest_m, 0.495F / 0.1825F, 0.02F);
}

TEST(FlatTop, HasPointsNoFartherApartThanAsked) {
  FrontOfABox box;
  box.fill(kWallEnd, 85, 6.0F);
  std::vector<float> depths_m;
  for (const Eigen::Vector3f& point : box.top()) {
    const bool is_in_first_column = std::abs(point.x() / point.z() + 0.6F) < 1e-4F;
    if (is_in_first_column) depths_m.push_back(point.z());
  }
  std::sort(depths_m.begin(), depths_m.end());
  ASSERT_GT(depths_m.size(), 30U);
  for (std::size_t i = 1; i < depths_m.size(); ++i) {
    EXPECT_LE(depths_m[i] - depths_m[i - 1], 0.0201F);
  }
}

TEST(FlatTop, IsNoneWhereThePlaneWouldBeMeasured) {
  FrontOfABox box;
  // Seen from 2 m above, rays to the top of the box meet it at less than 70 degrees.
  for (float& slope : box.window.slope_y) slope += 0.6F;
  EXPECT_TRUE(box.top().empty());
}

TEST(FlatTop, IsNoneOfWhatIsLow) {
  FrontOfABox box;
  std::fill(box.is_object.begin() + static_cast<std::ptrdiff_t>(box.window.cell(0, kEdge + 10)),
            box.is_object.end(),
            std::uint8_t{0});  // a book of 0.1 m
  EXPECT_TRUE(box.top().empty());
}

TEST(FlatTop, IsNoneOfASeatWithABack) {
  FrontOfABox box;
  box.fill(kWallEnd, 85, 6.0F);
  ASSERT_FALSE(box.top().empty());
  for (int y = kBoxTop; y < 85; ++y) {
    for (int x = 10; x < 14; ++x) {
      box.window.depth_m[box.window.cell(x, y)] = 2.5F;
      box.is_object[box.window.cell(x, y)] = 1;
    }
  }
  EXPECT_TRUE(box.top().empty());
}

TEST(FlatTop, IsNoneWhenTheEdgeSlopes) {
  FrontOfABox box;
  box.fill(kWallEnd, 85, 6.0F);
  for (int x = 0; x < kColumns; ++x) {
    for (int y = kEdge; y < kEdge + x / 2; ++y) {
      box.window.depth_m[box.window.cell(x, y)] = 0.0F;
      box.is_object[box.window.cell(x, y)] = 0;
    }
  }
  EXPECT_TRUE(box.top().empty());
}

TEST(FlatTop, IsNoneWhenTheGapReachesFartherThanTheEdgeIsLong) {
  FrontOfABox box;
  box.fill(kWallEnd, 80, 6.0F);  // 3.2 m away
  ASSERT_FALSE(box.top().empty());
  for (float& slope : box.window.slope_x) slope *= 0.2F;  // an edge of 0.48 m
  EXPECT_TRUE(box.top().empty());
}

TEST(FlatTop, IsNoneOfAGapInFrontOfWhatIsBelowIt) {
  FrontOfABox box;
  box.fill(kWallEnd, 85, 6.0F);
  // The inner side of an armrest: a gap below the edge, whose rays would meet the plane nearer than
  // the seat below it. Of the object only a narrow strip at the left keeps its top.
  for (int x = 20; x < kColumns; ++x) {
    for (int y = kEdge; y < kEdge + 20; ++y) {
      box.window.depth_m[box.window.cell(x, y)] = 0.0F;
      box.is_object[box.window.cell(x, y)] = 0;
    }
  }
  for (const Eigen::Vector3f& point : box.top()) EXPECT_GE(point.z(), 1.98F);
}

TEST(FlatTop, IsNotThatOfAnotherThingInFrontWhichIsAsHigh) {
  FrontOfABox box;
  box.fill(kWallEnd, 85, 6.0F);
  const std::size_t num_points = box.top().size();
  // From column 40 on something nearer hides the front. Its top is as high and not measured, its
  // own front begins at row 120, 0.495 / 0.3475 = 1.42 m away.
  box.put_another(120, 1.42F);
  const auto points = box.top();
  for (const Eigen::Vector3f& point : points) EXPECT_GE(point.z(), 1.94F);
  EXPECT_GE(points.size(), num_points * 6 / 10) << "that of the other 40 of 60 columns stays";
}

TEST(FlatTop, IsNotThatOfAnotherThingBesideItWhichStandsFarther) {
  FrontOfABox box;
  box.fill(kWallEnd, 85, 6.0F);
  const std::size_t num_points = box.top().size();
  box.put_another(92, 2.4F);  // as high: its border is at slope 0.2075
  const auto points = box.top();
  for (const Eigen::Vector3f& point : points) EXPECT_TRUE(box.is_left_of_another(point));
  EXPECT_GE(points.size(), num_points * 6 / 10) << "that of the other 40 of 60 columns stays";
}

TEST(FlatTop, IsNotThatOfAnotherThingBesideItWithAFlushFront) {
  FrontOfABox box;
  box.fill(kWallEnd, 85, 6.0F);
  box.put_another(kEdge, 2.0F);
  ASSERT_FALSE(box.top().empty());
  for (const Eigen::Vector3f& point : box.top()) EXPECT_TRUE(box.is_left_of_another(point));
}

TEST(FlatTop, ReachesBehindWhatStandsOnIt) {
  FrontOfABox box;
  box.fill(kWallEnd, 85, 6.0F);
  const auto num_beyond = [&] {
    const auto points = box.top();
    return std::count_if(points.begin(), points.end(), [](const auto& p) { return p.z() > 2.35F; });
  };
  const auto before = num_beyond();
  // A row of books on it, 2.15 m away.
  for (int x = 4; x < 56; ++x) {
    for (int y = 93; y < 97; ++y) box.window.depth_m[box.window.cell(x, y)] = 2.15F;
  }
  EXPECT_GE(num_beyond(), before * 4 / 5);
}

TEST(FlatTop, ReachesBehindWhatHidesItsEdge) {
  FrontOfABox box;
  box.fill(kWallEnd, 85, 6.0F);
  box.put_another(95, 1.5F);
  const auto points = box.top();
  const auto num_behind = std::count_if(
      points.begin(), points.end(), [&](const auto& p) { return !box.is_left_of_another(p); });
  EXPECT_GT(num_behind, 100);
}

/// 1 from that row on.
MaskImage mask_from(int row) {
  MaskImage mask(kColumns, kRows);
  for (int v = row; v < kRows; ++v) std::fill_n(&mask.at(0, v), kColumns, std::uint8_t{1});
  return mask;
}

TEST(FlatTop, EndsWithTheMask) {
  FrontOfABox box;  // nothing is measured up to row 60
  box.window.in_mask = mask_from(83);
  const auto farthest_m = [&] {
    float most_m = 0.0F;
    for (const Eigen::Vector3f& point : box.top()) most_m = std::max(most_m, point.z());
    return most_m;
  };
  // Two rows below the mask's border, whether that is the box's or not: row 85 ends at slope
  // 0.1725.
  EXPECT_NEAR(farthest_m(), 0.495F / 0.1725F, 0.02F);
  box.window.box.v_begin = 83;
  EXPECT_NEAR(farthest_m(), 0.495F / 0.1725F, 0.02F);
  box.window.in_mask = mask_from(kEdge);
  EXPECT_TRUE(box.top().empty());
}

TEST(FlatTop, StaysOnItsPlaneWhenTheMaskReachesTheFirstRow) {
  FrontOfABox box;
  // Row r falls by 0.17 + 0.0019 r per metre: the border above row 100 (0.35905) meets the front, 3
  // m away, at -1.07715 m.
  for (int y = 0; y < kRows; ++y) {
    box.window.slope_y[static_cast<std::size_t>(y)] = 0.17F + 0.0019F * static_cast<float>(y);
  }
  box.fill(0, kEdge, 0.0F);
  box.fill(kEdge, kRows, 3.0F);
  box.window.box.v_begin = 0;
  box.window.in_mask = mask_from(0);
  const auto points = box.top();
  ASSERT_FALSE(points.empty());
  for (const Eigen::Vector3f& point : points) EXPECT_NEAR(point.y(), 1.07715F, 1e-3F);
}

TEST(FlatTop, IsNoneOfARolledCamera) {
  FrontOfABox box;
  box.fill(kWallEnd, 85, 6.0F);
  ASSERT_FALSE(box.top().empty());
  box.aligned << 1, 0, 0, 0, 0, 1, 0.6F, -0.8F, 0;
  EXPECT_TRUE(box.top().empty());
}

TEST(FlatTop, GivesATableItsDepth) {
  test::BoxScene scene;
  scene.add(test::kFloor, {0, -4, -0.1}, {8, 4, 0}).add(test::kWall, {4.6, -4, 0}, {4.7, 4, 3});
  scene.add(test::kTable, {2.6, -0.7, 0.70}, {3.6, 0.7, 0.75});
  for (const double y : {-0.7, 0.64}) scene.add(test::kTable, {2.6, y, 0}, {2.66, y + 0.06, 0.7});
  test::SceneView view = scene.view(test::look_at({0, 0, 1.4}, {2.5, 0, 0.8}), 1);
  const RgbdFrame& frame = view.frame;
  const Eigen::Isometry3d map_from_camera = frame.map_from_camera.isometry();
  for (int v = 0; v < frame.camera.height_px; ++v) {
    for (int u = 0; u < frame.camera.width_px; ++u) {
      const double depth_m = static_cast<double>(frame.depth_m.at(u, v));
      const Eigen::Vector3d point = map_from_camera * frame.camera.unproject(u, v, depth_m).xyz;
      const bool is_top = view.truth.at(u, v) == test::kTable && point.x() > 2.62;
      if (is_top) view.frame.depth_m.at(u, v) = 0.0F;  // 75 degrees and more from its normal
    }
  }
  const auto found = segment(view.frame, test::detection_of(view, test::kTable), {});
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->box.max_in_map.x(), 3.5, 0.12);
  EXPECT_NEAR(found->box.max_in_map.z(), 0.75, 0.03);
  for (const std::uint32_t pixel : found->pixel_indices) {
    EXPECT_GT(view.frame.depth_m.pixels()[pixel], 0.0F) << "what was not measured labels no voxel";
  }
}

}  // namespace
}  // namespace hypermap
