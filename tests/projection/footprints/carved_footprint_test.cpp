// SPDX-License-Identifier: BSD-3-Clause
#include "footprints/carved_footprint.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace hypermap {
namespace {

constexpr double kVoxelM = 0.05;

using Points = std::vector<Eigen::Vector3f>;

/// Points on a horizontal rectangle, one in each cell of 1 cm.
void add_rectangle(Points& points, double x0, double y0, double x1, double y1, double z) {
  for (double x = x0 + 0.005; x < x1; x += 0.01) {
    for (double y = y0 + 0.005; y < y1; y += 0.01) {
      points.emplace_back(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
    }
  }
}

Object object_of(const Points& points) {
  Object object;
  object.id = ObjectId{1};
  object.points.observe(points);
  object.box = *object.points.agreed_box();
  return object;
}

/// All of the space around the object as free voxels, but those for which `is_hidden(x, y)`.
template <class IsHidden>
LeafSource free_space(const IsHidden& is_hidden) {
  return [is_hidden](const LeafVisitor& visit) {
    for (int i = -20; i < 40; ++i) {
      for (int j = -20; j < 40; ++j) {
        for (int k = -2; k < 30; ++k) {
          LeafSample leaf;
          leaf.edge_m = kVoxelM;
          leaf.centre_in_map = kVoxelM * Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5);
          if (!is_hidden(leaf.centre_in_map.x(), leaf.centre_in_map.y())) visit(leaf);
        }
      }
    }
  };
}

LeafSource all_free() {
  return free_space([](double, double) { return false; });
}

Polygon carved(const Object& object, const LeafSource& leaves) {
  const std::vector<const Object*> objects{&object};
  auto shape = carved_footprint(object.points, columns_of(objects, leaves, kVoxelM).front());
  EXPECT_TRUE(shape);
  return shape.value_or(Polygon{});
}

Polygon rectangle(double x0, double y0, double x1, double y1) {
  return *make_polygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

TEST(CarvedFootprint, OfACrossIsTheCrossAndNotItsHull) {
  Points points;
  add_rectangle(points, 0.0, 0.46, 1.0, 0.54, 1.0);  // A screen of 8 cm, and its foot.
  add_rectangle(points, 0.3, 0.2, 0.7, 0.8, 0.7);
  const Object object = object_of(points);
  const double cross_m2 = 1.0 * 0.08 + 0.4 * 0.6 - 0.4 * 0.08;
  EXPECT_GT(area_m2(*object.points.footprint()), 1.4 * cross_m2);
  EXPECT_NEAR(area_m2(carved(object, all_free())), cross_m2, 0.08 * cross_m2);
}

TEST(CarvedFootprint, StraysDoNotSpanAHull) {
  Points points;
  add_rectangle(points, 0.0, 0.0, 0.5, 0.5, 0.4);
  points.emplace_back(1.2F, 0.1F, 0.4F);
  const Object object = object_of(points);
  EXPECT_GT(jaccard(carved(object, all_free()), rectangle(0, 0, 0.5, 0.5)), 0.95);
}

TEST(CarvedFootprint, WhatIsHiddenBehindTwoSidesStays) {
  Points points;
  add_rectangle(points, 0.0, 0.0, 0.6, 0.02, 0.2);
  add_rectangle(points, 0.0, 0.0, 0.02, 0.6, 0.2);
  for (float z = 0.0F; z < 1.0F; z += 0.05F) points.emplace_back(0.01F, 0.01F, z);
  const Object object = object_of(points);
  const auto is_inside = [](double x, double y) { return x > 0 && y > 0 && x < 0.6 && y < 0.6; };
  const double triangle_m2 = 0.5 * 0.6 * 0.6;
  EXPECT_NEAR(area_m2(carved(object, free_space(is_inside))), triangle_m2, 0.1 * triangle_m2);
  EXPECT_LT(area_m2(carved(object, all_free())), 0.3 * triangle_m2) << "it was looked through";
}

TEST(CarvedFootprint, ASparseSurfaceIsWhole) {
  Points points;
  for (double x = 0.0; x < 1.0; x += 0.09) {
    for (double y = 0.0; y < 0.7; y += 0.09) {
      points.emplace_back(static_cast<float>(x), static_cast<float>(y), 0.7F);
    }
  }
  const Object object = object_of(points);
  EXPECT_GT(jaccard(carved(object, all_free()), *object.points.footprint()), 0.95);
}

TEST(CarvedFootprint, PiecesThatAreTooFarApartKeepTheirHull) {
  Points points;
  add_rectangle(points, 0.0, 0.0, 0.1, 0.1, 0.4);
  add_rectangle(points, 1.6, 0.0, 1.7, 0.1, 0.4);
  const Object object = object_of(points);
  EXPECT_EQ(carved(object, all_free()), *object.points.footprint());
}

TEST(CarvedFootprint, PiecesThatAreNearAreBridged) {
  Points points;
  add_rectangle(points, 0.0, 0.0, 0.2, 0.2, 0.4);
  add_rectangle(points, 0.5, 0.0, 0.7, 0.2, 0.4);
  const Object object = object_of(points);
  EXPECT_TRUE(contains(carved(object, all_free()), {0.35, 0.1}));
}

TEST(CarvedFootprint, LiesWithinTheHull) {
  Points points;
  for (int i = 0; i < 400; ++i) {
    const double angle = 0.7 * i;
    const double radius = 0.3 + 0.2 * std::sin(5 * angle);
    points.emplace_back(static_cast<float>(radius * std::cos(angle)),
                        static_cast<float>(radius * std::sin(angle)),
                        0.01F * static_cast<float>(i % 50));
  }
  const Object object = object_of(points);
  const Polygon hull = *object.points.footprint();
  EXPECT_GT(covered_share(carved(object, all_free()), hull), 0.98);
}

TEST(CarvedFootprint, OfNoPointsIsNotFound) {
  const Object object;
  EXPECT_EQ(carved_footprint(object.points, ObjectColumns(object, kVoxelM, 1)).error().code,
            ErrorCode::kNotFound);
}

TEST(CarvedFootprint, OfAHugeObjectIsItsHull) {
  const Object object = object_of({{0, 0, 0}, {0, 900, 0}, {900, 0, 0}});
  EXPECT_EQ(carved(object, all_free()), *object.points.footprint());
}

}  // namespace
}  // namespace hypermap
