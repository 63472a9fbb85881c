// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/depth_smoothing.hpp"

#include "hypermap/core/segmentation/depth_cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace hypermap {
namespace {

DepthImage smoothed(const DepthImage& depth_m, const DepthSmoothingOptions& options = {}) {
  return DepthSmoother(options).smoothed(depth_m, 1);
}

/// A plane that the camera sees at a slant: inverse depth is linear in the pixel.
DepthImage slanted_plane(int width_px, int height_px) {
  DepthImage plane(width_px, height_px);
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      plane.at(u, v) =
          1.0F / (0.3F + 0.0002F * static_cast<float>(u) + 0.0004F * static_cast<float>(v));
    }
  }
  return plane;
}

DepthImage with_noise(DepthImage depth_m, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (float& pixel : depth_m.pixels()) {
    const auto depth = static_cast<double>(pixel);
    pixel = static_cast<float>(depth + axial_noise_m(depth) * normal(random));
  }
  return depth_m;
}

double rms_difference(const DepthImage& a, const DepthImage& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto difference = static_cast<double>(a.pixels()[i]) - static_cast<double>(b.pixels()[i]);
    sum += difference * difference;
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// What the header says, pixel by pixel.
float brute_force(const DepthImage& depth_m, int u, int v, const DepthSmoothingOptions& options) {
  const float centre = depth_m.at(u, v);
  if (!is_measured(centre) || static_cast<double>(centre) < options.min_depth_m) return centre;
  const double depth = static_cast<double>(centre);
  const double gate = options.gate_sigmas * axial_noise_m(depth) / (depth * depth);
  const auto is_near = [&](int at_u, int at_v) {
    return depth_m.contains(at_u, at_v) && is_measured(depth_m.at(at_u, at_v)) &&
           std::abs(1.0 / static_cast<double>(depth_m.at(at_u, at_v)) - 1.0 / depth) <= gate;
  };
  double sum = 1.0 / depth;
  int num_pixels = 1;
  for (int dv = -options.radius_px; dv <= options.radius_px; ++dv) {
    for (int du = -options.radius_px; du <= options.radius_px; ++du) {
      if (du == 0 && dv == 0) continue;
      if (!is_near(u + du, v + dv) || !is_near(u - du, v - dv)) continue;
      sum += 1.0 / static_cast<double>(depth_m.at(u + du, v + dv));
      ++num_pixels;
    }
  }
  return static_cast<float>(num_pixels / sum);
}

TEST(DepthSmoothing, OneRowByHand) {
  // 1 / z of the middle: (1/2 + 1/2.02 + 1/1.98) / 3 = 0.5000333, so z = 1.9998667.
  DepthImage row(3, 1);
  row.at(0, 0) = 2.02F;
  row.at(1, 0) = 2.0F;
  row.at(2, 0) = 1.98F;
  const DepthImage result = smoothed(row, {.gate_sigmas = 5.0});
  EXPECT_NEAR(static_cast<double>(result.at(1, 0)), 1.9998667, 1e-6);
  EXPECT_EQ(result.at(0, 0), 2.02F);  // no pair inside the image
  // The noise at 2 m is 1.2 mm + 1.9 mm 1.6^2 = 6.1 mm: three times that do not reach.
  EXPECT_EQ(smoothed(row, {.gate_sigmas = 3.0}).at(1, 0), 2.0F);
}

TEST(DepthSmoothing, LeavesAPlaneWhereItIsAtAnySlant) {
  const DepthImage plane = slanted_plane(70, 50);
  EXPECT_LT(rms_difference(smoothed(plane), plane), 1e-6);
}

TEST(DepthSmoothing, TakesNoiseOutOfAPlane) {
  const DepthImage plane = slanted_plane(300, 60);
  const DepthImage noisy = with_noise(plane, 1);
  EXPECT_LT(rms_difference(smoothed(noisy), plane), 0.35 * rms_difference(noisy, plane));
}

TEST(DepthSmoothing, MixesNoSurfacesAtAStep) {
  DepthImage step(40, 20, 2.0F);
  for (int v = 0; v < 20; ++v) {
    for (int u = 17; u < 40; ++u) step.at(u, v) = 2.5F;
  }
  EXPECT_LT(rms_difference(smoothed(step), step), 1e-6);
}

TEST(DepthSmoothing, LeavesWhatIsNearOrNotMeasuredAsItIs) {
  DepthImage depth = with_noise(DepthImage(9, 5, 2.0F), 2);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  depth.at(4, 2) = nan;
  depth.at(1, 1) = 0.0F;
  depth.at(2, 3) = -1.0F;
  depth.at(7, 2) = infinite;
  const DepthImage result = smoothed(depth);
  EXPECT_TRUE(std::isnan(result.at(4, 2)));
  EXPECT_EQ(result.at(1, 1), 0.0F);
  EXPECT_EQ(result.at(2, 3), -1.0F);
  EXPECT_EQ(result.at(7, 2), infinite);
  const DepthImage near = with_noise(DepthImage(9, 5, 1.2F), 3);
  EXPECT_EQ(smoothed(near), near);
  EXPECT_TRUE(smoothed(DepthImage()).empty());
}

TEST(DepthSmoothing, IsWhatItSaysPixelByPixel) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> depths(0.5F, 6.0F);
  for (int radius = 1; radius <= 3; ++radius) {
    const DepthSmoothingOptions options{.radius_px = radius, .gate_sigmas = 8.0};
    DepthImage depth = with_noise(slanted_plane(300, 9), static_cast<unsigned>(radius));
    for (int i = 0; i < 200; ++i) {
      depth.at(static_cast<int>(random() % 300), static_cast<int>(random() % 9)) = depths(random);
      depth.at(static_cast<int>(random() % 300), static_cast<int>(random() % 9)) = 0.0F;
    }
    const DepthImage result = smoothed(depth, options);
    for (int v = 0; v < 9; ++v) {
      for (int u = 0; u < 300; ++u) {
        const float expected = brute_force(depth, u, v, options);
        ASSERT_NEAR(static_cast<double>(result.at(u, v)), static_cast<double>(expected), 2e-5)
            << radius << ": " << u << ", " << v;
      }
    }
  }
}

TEST(DepthSmoothing, IsTheSameWithThreeThreadsAndInASecondImage) {
  const DepthImage noisy = with_noise(slanted_plane(320, 100), 5);
  DepthSmoother smoother({});
  const DepthImage once = smoother.smoothed(noisy, 1);
  EXPECT_EQ(smoother.smoothed(noisy, 3), once);
  EXPECT_EQ(smoother.smoothed(slanted_plane(20, 10), 1), smoothed(slanted_plane(20, 10)));
  EXPECT_EQ(smoother.smoothed(noisy, 2), once);
}

TEST(DepthSmoothing, WithoutARuleIsACopy) {
  const DepthImage noisy = with_noise(slanted_plane(20, 10), 6);
  EXPECT_EQ(smoothed(noisy, {.rule = DepthSmoothingRule::kNone}), noisy);
}

TEST(DepthSmoothing, RefusesOptionsByName) {
  EXPECT_TRUE(validate(DepthSmoothingOptions{}));
  EXPECT_EQ(validate(DepthSmoothingOptions{.radius_px = 0}).error().field, "radius_px");
  EXPECT_EQ(validate(DepthSmoothingOptions{.gate_sigmas = 0.0}).error().field, "gate_sigmas");
  EXPECT_EQ(validate(DepthSmoothingOptions{.min_depth_m = -1.0}).error().field, "min_depth_m");
}

}  // namespace
}  // namespace hypermap
