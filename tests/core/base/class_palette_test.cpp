// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/class_palette.hpp"

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hypermap {
namespace {

double linear(std::uint8_t channel) {
  const double c = channel / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

// B. Ottosson, "A perceptual color space for image processing", 2020: linear sRGB to Oklab.
Eigen::Vector3d oklab(Rgb8 color) {
  const Eigen::Vector3d rgb(linear(color.r), linear(color.g), linear(color.b));
  Eigen::Matrix3d lms_from_rgb;
  lms_from_rgb << 0.4122214708, 0.5363325363, 0.0514459929,  //
      0.2119034982, 0.6806995451, 0.1073969566,              //
      0.0883024619, 0.2817188376, 0.6299787005;
  Eigen::Matrix3d lab_from_lms;
  lab_from_lms << 0.2104542553, 0.7936177850, -0.0040720468,  //
      1.9779984951, -2.4285922050, 0.4505937099,              //
      0.0259040371, 0.7827717662, -0.8086757660;
  return lab_from_lms *
         (lms_from_rgb * rgb).array().unaryExpr([](double x) { return std::cbrt(x); }).matrix();
}

Eigen::Vector3d lab_of(std::uint32_t id) {
  return oklab(class_color(ClassId{id}));
}

double smallest_difference(std::uint32_t num_classes) {
  double smallest = 10.0;
  for (std::uint32_t a = 0; a < num_classes; ++a) {
    for (std::uint32_t b = 0; b < a; ++b) {
      smallest = std::min(smallest, (lab_of(a) - lab_of(b)).norm());
    }
  }
  return smallest;
}

// White in Oklab is (1, 0, 0): the oracle itself is right.
TEST(ClassPalette, TheOracleKnowsWhite) {
  EXPECT_LT((oklab({255, 255, 255}) - Eigen::Vector3d(1, 0, 0)).norm(), 1e-4);
}

TEST(ClassPalette, TheFirstClassesDifferClearly) {
  EXPECT_GT(smallest_difference(24), 0.1);
}

// 0.02 is where most people just see a difference between two colours side by side.
TEST(ClassPalette, AllClassesOfADetectorDiffer) {
  EXPECT_GT(smallest_difference(80), 0.05);
}

TEST(ClassPalette, NoClassLooksGreyWhiteOrBlack) {
  for (std::uint32_t id = 0; id < kNumClassColors; ++id) {
    const Eigen::Vector3d lab = lab_of(id);
    EXPECT_GT(lab.tail<2>().norm(), 0.08) << id;
    EXPECT_GT(lab.x(), 0.4) << id;
    EXPECT_LT(lab.x(), 0.85) << id;
  }
}

TEST(ClassPalette, RepeatsBeyondItsEnd) {
  EXPECT_EQ(class_color(ClassId{static_cast<std::uint32_t>(kNumClassColors)}),
            class_color(ClassId{0}));
}

}  // namespace
}  // namespace hypermap
