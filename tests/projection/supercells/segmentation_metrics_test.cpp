// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/supercells/segmentation_metrics.hpp"

#include "stack_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace hypermap {
namespace {

using test::cells_of;
using test::num_parts;
using test::random_stack;
using test::stack_from;
using testing::ElementsAre;

CellSegmentation of_labels(int cols, std::vector<std::int32_t> labels) {
  const int rows = static_cast<int>(labels.size()) / cols;
  const int count = *std::ranges::max_element(labels) + 1;
  return {.cols = cols, .rows = rows, .count = count, .labels = std::move(labels)};
}

/// Cells in one row on one layer.
GridStack row_with(const std::vector<double>& p) {
  return stack_from(cells_of(static_cast<int>(p.size()), 1), 1, [&](int /*layer*/, Cell cell) {
    return p[static_cast<std::size_t>(cell.col)];
  });
}

TEST(SegmentationMetrics, IntraClusterVariationIsAMeanOfDeviationsByHand) {
  // [stutz] 4.1. Segment 0: 0.2, 0.4, mean 0.3, deviation 0.1. Segment 1: 0.9 alone, 0. Their mean
  // is 0.05, whatever the segments' sizes. Log-odds are rounded to 0.001: 0.0002 of a probability.
  const GridStack stack = row_with({0.2, 0.4, 0.9});
  EXPECT_NEAR(intra_cluster_variation(of_labels(3, {0, 0, 1}), stack), 0.05, 2e-4);
  // Deviations of two layers add as squares: 0.1 and 0.1 are sqrt(0.02).
  const GridStack two = stack_from(
      cells_of(2, 1), 2, [](int /*layer*/, Cell cell) { return cell.col == 0 ? 0.2 : 0.4; });
  EXPECT_NEAR(intra_cluster_variation(of_labels(2, {0, 0}), two), std::sqrt(0.02), 2e-4);
}

TEST(SegmentationMetrics, ExplainedVariationByHand) {
  // [stutz] 4.1. Mean of 0.2, 0.4, 0.9 is 0.5: squares 0.09 + 0.01 + 0.16 = 0.26. Means of segments
  // 0.3, 0.3, 0.9: 0.04 + 0.04 + 0.16 = 0.24.
  const GridStack stack = row_with({0.2, 0.4, 0.9});
  EXPECT_NEAR(explained_variation(of_labels(3, {0, 0, 1}), stack), 0.24 / 0.26, 2e-3);
  EXPECT_NEAR(explained_variation(of_labels(3, {0, 0, 0}), stack), 0.0, 1e-12);
  EXPECT_NEAR(explained_variation(of_labels(3, {0, 1, 2}), stack), 1.0, 1e-12);
  EXPECT_EQ(explained_variation(of_labels(3, {0, 0, 1}), row_with({0.7, 0.7, 0.7})), 1.0);
}

TEST(SegmentationMetrics, UndersegmentationErrorByHand) {
  // [stutz] 4.1. Segment 0 has 3 cells of true segment 0 and 1 of 1: min(3, 1) + min(1, 3) = 2 of 8
  // cells. Segment 1 lies in true segment 1: min(4, 0) = 0.
  const auto truth = of_labels(8, {0, 0, 0, 1, 1, 1, 1, 1});
  EXPECT_DOUBLE_EQ(undersegmentation_error(of_labels(8, {0, 0, 0, 0, 1, 1, 1, 1}), truth), 0.25);
  EXPECT_DOUBLE_EQ(undersegmentation_error(truth, truth), 0.0);
  // One segment for all: min(3, 5) + min(5, 3) of 8.
  EXPECT_DOUBLE_EQ(undersegmentation_error(of_labels(8, {0, 0, 0, 0, 0, 0, 0, 0}), truth), 0.75);
}

TEST(SegmentationMetrics, BoundaryRecallByHand) {
  // [stutz] 4.1. True outline: cells 3 and 4. Outline of the segmentation: cells 5 and 6. Within 0
  // none is found, within 1 cell 4 is, within 2 both are.
  const auto truth = of_labels(10, {0, 0, 0, 0, 1, 1, 1, 1, 1, 1});
  const auto later = of_labels(10, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1});
  EXPECT_DOUBLE_EQ(boundary_recall(later, truth, 0), 0.0);
  EXPECT_DOUBLE_EQ(boundary_recall(later, truth, 1), 0.5);
  EXPECT_DOUBLE_EQ(boundary_recall(later, truth, 2), 1.0);
  EXPECT_DOUBLE_EQ(boundary_recall(truth, of_labels(10, std::vector<std::int32_t>(10, 0)), 1), 1.0);
}

TEST(SegmentationMetrics, BoundaryRecallLooksInASquareAndNotOverTheEdgeOfTheGrid) {
  // 3 x 3 cells; the truth parts the corner (0, 0) from all else: three cells on its outline, the
  // corner, right of it and above it. The segmentation parts the corner (2, 2): its outline is
  // (2, 2), (1, 2), (2, 1). Within 1 of (1, 0) lies (2, 1), of (0, 1) lies (1, 2), of (0, 0) none.
  const auto truth = of_labels(3, {0, 1, 1, 1, 1, 1, 1, 1, 1});
  const auto other = of_labels(3, {0, 0, 0, 0, 0, 0, 0, 0, 1});
  EXPECT_DOUBLE_EQ(boundary_recall(other, truth, 1), 2.0 / 3.0);
}

TEST(SegmentationMetrics, TheRadiusIsAPartOfTheDiagonal) {
  // 0.0025 * 848.5 = 2.1; of 400 x 300 cells 1.25; of 40 x 30 nothing.
  EXPECT_EQ(boundary_radius({.cols = 600, .rows = 600, .count = 0, .labels = {}}), 2);
  EXPECT_EQ(boundary_radius({.cols = 400, .rows = 300, .count = 0, .labels = {}}), 1);
  EXPECT_EQ(boundary_radius({.cols = 40, .rows = 30, .count = 0, .labels = {}}), 0);
}

TEST(SegmentationMetrics, PurenessByHand) {
  // [sogm] Eq. (12): 3 of 4 and 1 of 1 are right: (0.75 + 1) / 2.
  const auto truth = of_labels(5, {0, 0, 0, 1, 1});
  EXPECT_DOUBLE_EQ(pureness(of_labels(5, {0, 0, 0, 0, 1}), truth), 0.875);
  EXPECT_DOUBLE_EQ(pureness(truth, truth), 1.0);
}

TEST(SegmentationMetrics, PartsOfOneLabelAreSegmentsOfTheirOwn) {
  // Corners do not connect.
  const std::vector<std::int32_t> labels = {7,
                                            7,
                                            3,  //
                                            3,
                                            7,
                                            7,  //
                                            7,
                                            3,
                                            7};
  const CellSegmentation found = connected_segments(3, 3, labels);
  EXPECT_EQ(found.count, 5);
  EXPECT_THAT(found.labels, ElementsAre(0, 0, 1, 2, 0, 0, 3, 4, 0));
}

TEST(SegmentationMetrics, ConnectedSegmentsAreConnectedOnAnyGrid) {
  CounterRng random(3, 1);
  const GridGeometry geometry = cells_of(23, 17);
  std::vector<std::int32_t> labels;
  for (std::size_t i = 0; i < geometry.num_cells(); ++i) {
    labels.push_back(static_cast<std::int32_t>(random.below(3)));
  }
  const CellSegmentation found = connected_segments(23, 17, labels);
  int parts = 0;
  for (const int label : {0, 1, 2}) parts += num_parts(geometry, labels, label);
  EXPECT_EQ(found.count, parts);
  for (int label = 0; label < found.count; ++label) {
    EXPECT_EQ(num_parts(geometry, found.labels, label), 1);
  }
}

TEST(SegmentationMetrics, TogetherTheyAreWhatTheyAreAlone) {
  const GridStack stack = random_stack(cells_of(40, 30), 3, 2);
  CounterRng random(5, 1);
  std::vector<std::int32_t> labels;
  std::vector<std::int32_t> classes;
  for (int i = 0; i < 1200; ++i) {
    labels.push_back(i / 5);
    classes.push_back(static_cast<std::int32_t>(random.below(4)));
  }
  const auto segmentation = of_labels(40, labels);
  const auto truth = of_labels(40, classes);
  const auto all = segmentation_metrics(segmentation, truth, stack).value();
  EXPECT_EQ(all.count, 240);
  EXPECT_EQ(all.intra_cluster_variation, intra_cluster_variation(segmentation, stack));
  EXPECT_EQ(all.explained_variation, explained_variation(segmentation, stack));
  EXPECT_EQ(all.undersegmentation_error, undersegmentation_error(segmentation, truth));
  EXPECT_EQ(all.boundary_recall, boundary_recall(segmentation, truth, 0));
  EXPECT_EQ(all.pureness, pureness(segmentation, truth));
}

TEST(SegmentationMetrics, WhatCannotBeComparedIsSaid) {
  const GridStack stack = row_with({0.2, 0.4, 0.9});
  const auto good = of_labels(3, {0, 0, 1});
  const auto field_of = [](const Result<SegmentationMetrics>& result) {
    return result ? std::string() : result.error().field;
  };
  EXPECT_EQ(field_of(segmentation_metrics(good, good, stack)), "");
  EXPECT_EQ(field_of(segmentation_metrics(of_labels(2, {0, 1}), good, stack)), "segmentation");
  EXPECT_EQ(field_of(segmentation_metrics(good, of_labels(1, {0, 0, 1}), stack)), "truth");
  EXPECT_EQ(field_of(segmentation_metrics(of_labels(3, {0, 0, 2}), good, stack)), "segmentation");
  CellSegmentation negative = good;
  negative.labels[0] = -1;
  EXPECT_EQ(field_of(segmentation_metrics(good, negative, stack)), "truth");
  const GridStack empty = GridStack::create(cells_of(3, 1)).value();
  EXPECT_EQ(field_of(segmentation_metrics(good, good, empty)), "stack");
}

}  // namespace
}  // namespace hypermap
