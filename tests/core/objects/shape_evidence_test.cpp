// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/shape_evidence.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hypermap {
namespace {

Polygon square_at(double x, double y, double side = 1.0) {
  const double h = side / 2.0;
  return make_polygon({{x - h, y - h}, {x + h, y - h}, {x + h, y + h}, {x - h, y + h}}).value();
}

TEST(ShapeEvidence, TheBestShapeIsNearestToTheMeanCentroid) {
  // [hypermap] 3.4.5: centroids 0, 1 and 5, mean 2; the shape at 1 is nearest.
  ShapeEvidence shapes;
  for (const double x : {0.0, 1.0, 5.0}) shapes.add(square_at(x, 0.0));
  EXPECT_NEAR(shapes.mean_centroid().x(), 2.0, 1e-12);
  EXPECT_EQ(shapes.best(), square_at(1.0, 0.0));
}

TEST(ShapeEvidence, TheHullHoldsAllShapes) {
  // Squares at 0 and 5: a rectangle of 6 by 1.
  ShapeEvidence shapes;
  shapes.add(square_at(0.0, 0.0));
  shapes.add(square_at(5.0, 0.0));
  EXPECT_NEAR(area_m2(*shapes.hull()), 6.0, 1e-12);
}

TEST(ShapeEvidence, WithoutEvidenceThereIsNoShape) {
  EXPECT_FALSE(ShapeEvidence().best().has_value());
  EXPECT_FALSE(ShapeEvidence().hull().has_value());
  EXPECT_TRUE(ShapeEvidence().empty());
}

TEST(ShapeEvidence, MemoryStaysFlatAndBestAndHullStayRight) {
  ShapeEvidence shapes;
  for (int i = 0; i < 1000; ++i) shapes.add(square_at(std::sin(i), std::cos(7.0 * i)));
  EXPECT_EQ(shapes.state().shapes.size(), ShapeEvidence::kMaxShapes);
  EXPECT_EQ(shapes.state().num_seen, 1000U);
  EXPECT_LE(shapes.hull()->outer.size(), ShapeEvidence::kMaxHullVertices);
  EXPECT_LT((centroid(*shapes.best()) - shapes.mean_centroid()).norm(), 0.25);
  const Rect box = bounds(*shapes.hull());
  EXPECT_NEAR(box.max.x() - box.min.x(), 3.0, 0.01);
}

TEST(ShapeEvidence, MergedListsConcatenate) {
  ShapeEvidence a;
  a.add(square_at(0.0, 0.0));
  ShapeEvidence b;
  b.add(square_at(4.0, 0.0));
  a.merge(b);
  EXPECT_EQ(a.state().shapes.size(), 2U);
  EXPECT_NEAR(a.mean_centroid().x(), 2.0, 1e-12);
  EXPECT_NEAR(area_m2(*a.hull()), 5.0, 1e-12);
}

TEST(ShapeEvidence, WhatIsStoredComesBackAndNonsenseIsRefused) {
  ShapeEvidence shapes;
  shapes.add(square_at(1.0, 2.0));
  EXPECT_EQ(ShapeEvidence::from_state(shapes.state()).value(), shapes);
  ShapeEvidenceState no_hull = shapes.state();
  no_hull.hull.reset();
  EXPECT_EQ(ShapeEvidence::from_state(no_hull).error().field, "shapes.hull");
  ShapeEvidenceState unseen = shapes.state();
  unseen.num_seen = 0;
  EXPECT_EQ(ShapeEvidence::from_state(unseen).error().field, "shapes");
}

}  // namespace
}  // namespace hypermap
