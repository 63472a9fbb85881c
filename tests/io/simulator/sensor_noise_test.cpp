// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/sensor_noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hypermap {
namespace {

DepthImage plane(float depth_m, int width = 300, int height = 200) {
  return DepthImage(width, height, depth_m);
}
Image<float> facing(const DepthImage& depth, float cosine = 1.0F) {
  return Image<float>(depth.width_px(), depth.height_px(), cosine);
}
DepthImage measure(const DepthImage& depth,
                   const SensorNoiseOptions& options,
                   float cosine = 1.0F) {
  return measured_depth(depth, facing(depth, cosine), options, 1, 2);
}
std::ptrdiff_t num_holes(const DepthImage& depth) {
  return std::ranges::count(depth.pixels(), 0.0F);
}

TEST(SensorNoise, SigmaIsTheFormula) {
  EXPECT_DOUBLE_EQ(axial_noise_m(0.4, {}), 0.0012);
  EXPECT_NEAR(axial_noise_m(2.4, {}), 0.0012 + 0.0019 * 4.0, 1e-15);  // 8.8 mm
}

TEST(SensorNoise, APlaneHasTheRightMeanAndSpread) {
  for (const float depth : {1.0F, 2.4F, 4.0F}) {
    const DepthImage measured = measure(plane(depth), {});
    double sum = 0.0;
    double squares = 0.0;
    int n = 0;
    for (const float value : measured.pixels()) {
      if (value == 0.0F) continue;
      const double error = static_cast<double>(value - depth);
      sum += error;
      squares += error * error;
      ++n;
    }
    // Rounding to steps of s adds s^2 / 12 to the variance.
    const double sigma =
        std::sqrt(std::pow(axial_noise_m(static_cast<double>(depth), {}), 2) + 1e-6 / 12.0);
    EXPECT_NEAR(sum / n, 0.0, 4.0 * sigma / std::sqrt(n)) << depth;
    EXPECT_NEAR(std::sqrt(squares / n), sigma, 4.0 * sigma / std::sqrt(2.0 * n)) << depth;
  }
}

TEST(SensorNoise, DepthComesInWholeMillimetres) {
  const DepthImage measured = measure(plane(1.2345F), {});
  for (const float value : measured.pixels()) {
    const double millimetres = 1000.0 * static_cast<double>(value);
    EXPECT_NEAR(millimetres, std::round(millimetres), 1e-3);
  }
}

TEST(SensorNoise, OnePixelInAHundredIsLost) {
  const DepthImage measured = measure(plane(2.0F), {});
  const double n = static_cast<double>(measured.size());
  EXPECT_NEAR(static_cast<double>(num_holes(measured)), 0.01 * n, 4.0 * std::sqrt(0.0099 * n));
}

TEST(SensorNoise, WithoutNoiseAndDropoutDepthIsExactToTheStep) {
  const SensorNoiseOptions quiet{.noise_base_m = 0.0, .noise_per_m2 = 0.0, .dropout = 0.0};
  const DepthImage measured = measure(plane(2.0004F), quiet);
  EXPECT_TRUE(std::ranges::all_of(measured.pixels(), [](float v) { return v == 2.0F; }));
}

TEST(SensorNoise, BothSidesOfADepthEdgeAreHoles) {
  const SensorNoiseOptions quiet{.noise_base_m = 0.0, .noise_per_m2 = 0.0, .dropout = 0.0};
  DepthImage step(20, 3, 2.0F);
  for (int v = 0; v < 3; ++v) {
    for (int u = 10; u < 20; ++u) step.at(u, v) = 2.05F;  // 2.5 per cent: an edge
  }
  const DepthImage measured = measure(step, quiet);
  for (int u = 0; u < 20; ++u) EXPECT_EQ(measured.at(u, 1) == 0.0F, u == 9 || u == 10) << u;
}

TEST(SensorNoise, ASmallStepIsNoEdge) {
  const SensorNoiseOptions quiet{.noise_base_m = 0.0, .noise_per_m2 = 0.0, .dropout = 0.0};
  DepthImage step(20, 3, 2.0F);
  for (int v = 0; v < 3; ++v) {
    for (int u = 10; u < 20; ++u) step.at(u, v) = 2.03F;  // 1.5 per cent
  }
  EXPECT_EQ(num_holes(measure(step, quiet)), 0);
}

TEST(SensorNoise, BesideNothingThereIsAnEdge) {
  const SensorNoiseOptions quiet{.noise_base_m = 0.0, .noise_per_m2 = 0.0, .dropout = 0.0};
  DepthImage half(10, 1, 2.0F);
  for (int u = 5; u < 10; ++u) half.at(u, 0) = 0.0F;
  EXPECT_EQ(num_holes(measure(half, quiet)), 6);
}

TEST(SensorNoise, FlatViewsBeyond75DegreesAreHoles) {
  const SensorNoiseOptions lossless{.dropout = 0.0};
  const auto cosine = [](double degrees) {
    return static_cast<float>(std::cos(degrees * std::numbers::pi / 180.0));
  };
  EXPECT_EQ(num_holes(measure(plane(2.0F), lossless, cosine(74.9))), 0);
  EXPECT_EQ(num_holes(measure(plane(2.0F), lossless, cosine(75.1))), 300 * 200);
}

TEST(SensorNoise, OutsideItsRangeThereIsNoDepth) {
  const SensorNoiseOptions quiet{.noise_base_m = 0.0, .noise_per_m2 = 0.0, .dropout = 0.0};
  EXPECT_EQ(num_holes(measure(plane(0.39F), quiet)), 300 * 200);
  EXPECT_EQ(num_holes(measure(plane(0.41F), quiet)), 0);
  EXPECT_EQ(num_holes(measure(plane(5.99F), quiet)), 0);
  EXPECT_EQ(num_holes(measure(plane(6.01F), quiet)), 300 * 200);
  // Noise never leads out of the range either.
  const DepthImage far = measure(plane(5.99F), {});
  EXPECT_LE(std::ranges::max(far.pixels()), 6.0F);
}

TEST(SensorNoise, NoTrueDepthGivesNoMeasurement) {
  EXPECT_EQ(num_holes(measure(plane(0.0F), {})), 300 * 200);
  EXPECT_EQ(num_holes(measure(plane(std::nanf("")), {})), 300 * 200);
}

TEST(SensorNoise, SameNamesGiveTheSameImageAndOthersAnother) {
  const DepthImage depth = plane(2.0F);
  const Image<float> cosine = facing(depth);
  EXPECT_EQ(measured_depth(depth, cosine, {}, 1, 2), measured_depth(depth, cosine, {}, 1, 2));
  EXPECT_NE(measured_depth(depth, cosine, {}, 1, 2), measured_depth(depth, cosine, {}, 1, 3));
  EXPECT_NE(measured_depth(depth, cosine, {}, 1, 2), measured_depth(depth, cosine, {}, 2, 2));
}

TEST(SensorNoise, BadOptionsNameTheirField) {
  const auto field = [](const SensorNoiseOptions& options) {
    const auto result = validate(options);
    return result ? std::string() : result.error().field;
  };
  EXPECT_EQ(field({}), "");
  EXPECT_EQ(field({.min_range_m = -1.0}), "sensor.min_range_m");
  EXPECT_EQ(field({.max_range_m = 0.4}), "sensor.max_range_m");
  EXPECT_EQ(field({.noise_base_m = std::nan("")}), "sensor.noise_base_m");
  EXPECT_EQ(field({.step_m = 0.0}), "sensor.step_m");
  EXPECT_EQ(field({.max_incidence_rad = 2.0}), "sensor.max_incidence_rad");
  EXPECT_EQ(field({.dropout = 1.1}), "sensor.dropout");
}

}  // namespace
}  // namespace hypermap
