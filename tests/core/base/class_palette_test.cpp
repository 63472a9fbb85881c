// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/class_palette.hpp"

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <span>
#include <tuple>

namespace hypermap {
namespace {

double linear(std::uint8_t channel) {
  const double c = channel / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

Eigen::Vector3d linear_rgb(Rgb8 color) {
  return {linear(color.r), linear(color.g), linear(color.b)};
}

// G. M. Machado, M. M. Oliveira, L. A. F. Fernandes, "A physiologically-based model for simulation
// of color vision deficiency", IEEE TVCG 15 (2009), deuteranomaly of severity 1.0.
Eigen::Vector3d deuteranope(const Eigen::Vector3d& rgb) {
  Eigen::Matrix3d seen_from_rgb;
  seen_from_rgb << 0.367322, 0.860646, -0.227968,  //
      0.280085, 0.672501, 0.047413,                //
      -0.011820, 0.042940, 0.968881;
  return (seen_from_rgb * rgb).cwiseMax(0.0).cwiseMin(1.0);
}

// IEC 61966-2-1 (sRGB, D65) and CIE 15:2004 (L*a*b*).
Eigen::Vector3d cie_lab(const Eigen::Vector3d& rgb) {
  Eigen::Matrix3d xyz_from_rgb;
  xyz_from_rgb << 0.4124564, 0.3575761, 0.1804375,  //
      0.2126729, 0.7151522, 0.0721750,              //
      0.0193339, 0.1191920, 0.9503041;
  const Eigen::Vector3d white(0.95047, 1.0, 1.08883);
  const Eigen::Vector3d f = (xyz_from_rgb * rgb).cwiseQuotient(white).unaryExpr([](double t) {
    return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
  });
  return {116.0 * f.y() - 16.0, 500.0 * (f.x() - f.y()), 200.0 * (f.y() - f.z())};
}

double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}
double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

double hue_deg(double a, double b) {
  const double hue = a == 0.0 && b == 0.0 ? 0.0 : degrees(std::atan2(b, a));
  return hue < 0.0 ? hue + 360.0 : hue;
}

double mean_hue_deg(double h1, double h2, bool is_grey) {
  if (is_grey) return h1 + h2;
  if (std::abs(h1 - h2) <= 180.0) return 0.5 * (h1 + h2);
  return h1 + h2 < 360.0 ? 0.5 * (h1 + h2 + 360.0) : 0.5 * (h1 + h2 - 360.0);
}

double hue_step_deg(double h1, double h2, bool is_grey) {
  if (is_grey) return 0.0;
  const double step = h2 - h1;
  if (step > 180.0) return step - 360.0;
  return step < -180.0 ? step + 360.0 : step;
}

// G. Sharma, W. Wu, E. N. Dalal, "The CIEDE2000 color-difference formula: implementation notes,
// supplementary test data, and mathematical observations", Color Res. Appl. 30 (2005), Eq. (2-22).
double delta_e(const Eigen::Vector3d& lab1, const Eigen::Vector3d& lab2) {
  const auto chroma_weight = [](double chroma) {
    const double power = std::pow(chroma, 7.0);
    return std::sqrt(power / (power + std::pow(25.0, 7.0)));
  };
  const double mean_c = 0.5 * (lab1.tail<2>().norm() + lab2.tail<2>().norm());
  const double g = 0.5 * (1.0 - chroma_weight(mean_c));
  const double a1 = (1.0 + g) * lab1.y();
  const double a2 = (1.0 + g) * lab2.y();
  const double c1 = std::hypot(a1, lab1.z());
  const double c2 = std::hypot(a2, lab2.z());
  const bool is_grey = c1 * c2 == 0.0;
  const double h1 = hue_deg(a1, lab1.z());
  const double h2 = hue_deg(a2, lab2.z());
  const double dl = lab2.x() - lab1.x();
  const double dc = c2 - c1;
  const double dh =
      2.0 * std::sqrt(c1 * c2) * std::sin(radians(0.5 * hue_step_deg(h1, h2, is_grey)));
  const double l = 0.5 * (lab1.x() + lab2.x());
  const double c = 0.5 * (c1 + c2);
  const double h = mean_hue_deg(h1, h2, is_grey);
  const double t = 1.0 - 0.17 * std::cos(radians(h - 30.0)) + 0.24 * std::cos(radians(2.0 * h)) +
                   0.32 * std::cos(radians(3.0 * h + 6.0)) -
                   0.20 * std::cos(radians(4.0 * h - 63.0));
  const double turn = 30.0 * std::exp(-std::pow((h - 275.0) / 25.0, 2.0));
  const double rt = -std::sin(radians(2.0 * turn)) * 2.0 * chroma_weight(c);
  const double from_50 = std::pow(l - 50.0, 2.0);
  const double l_part = dl / (1.0 + 0.015 * from_50 / std::sqrt(20.0 + from_50));
  const double c_part = dc / (1.0 + 0.045 * c);
  const double h_part = dh / (1.0 + 0.015 * c * t);
  return std::sqrt(l_part * l_part + c_part * c_part + h_part * h_part + rt * c_part * h_part);
}

double difference(Rgb8 a, Rgb8 b) {
  return delta_e(cie_lab(linear_rgb(a)), cie_lab(linear_rgb(b)));
}

double deuteranope_difference(Rgb8 a, Rgb8 b) {
  return delta_e(cie_lab(deuteranope(linear_rgb(a))), cie_lab(deuteranope(linear_rgb(b))));
}

template <class Difference>
double smallest(std::span<const std::string_view> names, const Difference& difference_of) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < names.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      smallest = std::min(smallest, difference_of(class_color(names[a]), class_color(names[b])));
    }
  }
  return smallest;
}

/// Every colour that a class may have.
std::vector<Rgb8> all_colors() {
  std::set<std::tuple<int, int, int>> seen;
  std::vector<Rgb8> colors;
  const auto add = [&](Rgb8 color) {
    if (seen.insert({color.r, color.g, color.b}).second) colors.push_back(color);
  };
  for (const std::string_view name : common_classes()) add(class_color(name));
  for (int i = 0; i < 5000; ++i) add(class_color("class " + std::to_string(i)));
  return colors;
}

// Table 1 of Sharma et al., pairs 1, 4, 13 and 20.
TEST(ClassPalette, TheOracleAgreesWithThePublishedPairs) {
  const double tolerance = 5e-5;  // half of the last digit that is printed
  EXPECT_NEAR(delta_e({50, 2.6772, -79.7751}, {50, 0, -82.7485}), 2.0425, tolerance);
  EXPECT_NEAR(delta_e({50, -1.3802, -84.2814}, {50, 0, -82.7485}), 1.0000, tolerance);
  EXPECT_NEAR(delta_e({50, -0.001, 2.49}, {50, 0.0011, -2.49}), 4.7461, tolerance);
  EXPECT_NEAR(delta_e({50, 2.5, 0}, {50, 3.2592, 0.335}), 1.0000, tolerance);
  EXPECT_NEAR(difference({255, 255, 255}, {0, 0, 0}), 100.0, 1e-3);
}

TEST(ClassPalette, TheFirstTwelveDifferByFifteenInBothVisions) {
  const auto names = common_classes();
  ASSERT_EQ(names.size(), 24U);
  const std::span<const std::string_view> first = std::span(names).first(12);
  EXPECT_GE(smallest(first, difference), 15.0);
  EXPECT_GE(smallest(first, deuteranope_difference), 15.0);
}

TEST(ClassPalette, AllCommonClassesDiffer) {
  const auto names = common_classes();
  EXPECT_GE(smallest(names, difference), 13.0);
  EXPECT_GE(smallest(names, deuteranope_difference), 7.0);
}

// What images and exports draw without a class: cells from white to the ink of occupied ones and
// unknown ones, voxels by height, legend, boxes, points, nodes of colour octrees.
TEST(ClassPalette, NoColorLooksLikeTheGreysOfWhatHasNoClass) {
  std::vector<Rgb8> greys{{226, 219, 208},
                          {224, 222, 220},
                          {200, 207, 217},
                          {166, 178, 196},
                          {205, 208, 214},
                          {120, 126, 134},
                          {214, 219, 226},
                          {160, 160, 160},
                          {200, 200, 200}};
  for (int percent = 0; percent <= 100; percent += 10) {
    const auto mixed = [&](int from, int to) {
      return static_cast<std::uint8_t>(std::lround(from + percent / 100.0 * (to - from)));
    };
    greys.push_back({mixed(255, 44), mixed(255, 52), mixed(255, 66)});
  }
  const auto colors = all_colors();
  EXPECT_EQ(colors.size(), 24U + 64U);
  for (const Rgb8 color : colors) {
    for (const Rgb8 grey : greys) {
      EXPECT_GE(difference(color, grey), 10.0) << int{color.r} << " " << int{color.g};
      EXPECT_GE(deuteranope_difference(color, grey), 10.0) << int{color.r} << " " << int{color.g};
    }
  }
}

TEST(ClassPalette, AColorFollowsTheNameInAnySpelling) {
  EXPECT_EQ(class_color("Dining Table"), class_color("diningtable"));
  EXPECT_EQ(class_color("tv"), class_color("tvmonitor"));
  EXPECT_EQ(class_color("Fire-Hydrant"), class_color("fire hydrant"));
  EXPECT_FALSE(class_color("chair") == class_color("sofa"));
}

// FNV-1a of "a" is 0xe40c292c: 44 modulo 64; the 45th colour was read from the table.
TEST(ClassPalette, OtherClassesGetTheColorThatTheirHashChooses) {
  EXPECT_EQ(class_color("a"), (Rgb8{120, 45, 75}));
}

TEST(ClassPalette, ColorsOfARegistryStandInTheOrderOfItsIds) {
  ClassRegistry classes;
  ASSERT_TRUE(classes.add("sofa") && classes.add("zebra"));
  EXPECT_THAT(class_colors(classes),
              testing::ElementsAre(class_color("sofa"), class_color("zebra")));
}

TEST(ClassPalette, AUsersColorHoldsForAllSpellings) {
  ClassPalette palette;
  ASSERT_TRUE(palette.set("Potted Plant", {1, 2, 3}));
  EXPECT_EQ(palette.color_of("pottedplant"), (Rgb8{1, 2, 3}));
  EXPECT_EQ(palette.color_of("chair"), class_color("chair"));
  EXPECT_EQ(palette.class_names(), std::vector<std::string>{"pottedplant"});
  EXPECT_FALSE(palette.set("potted-plant", {4, 5, 6}));
  EXPECT_FALSE(palette.set("", {4, 5, 6}));
}

}  // namespace
}  // namespace hypermap
