// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How good a segmentation of a stack is: how alike the cells of its segments are, and how well
/// their outlines keep to those of a true segmentation.
///
/// Source: [sogm] IV, Eq. (12); [stutz] D. Stutz, A. Hermans, B. Leibe, Superpixels: an evaluation
/// of the state of the art, CVIU 2018, for all others.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// Each cell of a grid in one segment. Shape: rows x cols, row-major.
struct CellSegmentation {
  int cols = 0;
  int rows = 0;
  int count = 0;                     ///< Of segments.
  std::vector<std::int32_t> labels;  ///< Of each cell, 0 .. count - 1.
  friend bool operator==(const CellSegmentation&, const CellSegmentation&) = default;
};

/// The parts, connected over edges, in which cells of equal labels lie, in the order of their first
/// cells. So superpixels that other programs left in several parts are compared as what they are
/// ([stutz] does so, too). Requires: cols * rows labels, of any value. Cost: O(cells).
[[nodiscard]] CellSegmentation connected_segments(int cols,
                                                  int rows,
                                                  std::span<const std::int32_t> labels);

/// The standard deviation of the cells of a segment around its mean, as the mean over all segments;
/// of a cell, the probabilities of all layers are a vector. Lower is better.
///
/// Source: [stutz] 4.1 as the program of its authors computes it: the square root of the *mean*
/// square. Requires: the stack's cells, at least one layer.
[[nodiscard]] double intra_cluster_variation(const CellSegmentation& segmentation,
                                             const GridStack& stack);

/// The part of the variance of all cells that is left when each has the mean of its segment. Higher
/// is better. Source: [stutz] 4.1. Boundary: 1 where all cells are alike. Requires: as above.
[[nodiscard]] double explained_variation(const CellSegmentation& segmentation,
                                         const GridStack& stack);

/// The share of cells that segments leak over true outlines: of each segment and true segment that
/// meet, what is smaller, the common part or the rest of the segment. Lower is better.
/// Source: [stutz] 4.1, after Neubert and Protzel. Requires: the same cells.
[[nodiscard]] double undersegmentation_error(const CellSegmentation& segmentation,
                                             const CellSegmentation& truth);

/// The share of cells on true outlines that have an outline of the segmentation within
/// `radius_cells` to each side (a square). A cell lies on an outline when one of the four beside it
/// is of another segment. Higher is better. Source: [stutz] 4.1. Boundary: 1 when there are no true
/// outlines. Requires: the same cells.
[[nodiscard]] double boundary_recall(const CellSegmentation& segmentation,
                                     const CellSegmentation& truth,
                                     int radius_cells);
/// 0.0025 of the diagonal, rounded. Source: [stutz] 4.1.
[[nodiscard]] int boundary_radius(const CellSegmentation& truth);

/// The share of a segment's cells that are of the true segment most frequent in it, as the mean
/// over all segments. Higher is better. Source: [sogm] Eq. (12). Requires: the same cells.
[[nodiscard]] double pureness(const CellSegmentation& segmentation, const CellSegmentation& truth);

/// All of them.
struct SegmentationMetrics {
  int count = 0;
  double intra_cluster_variation = 0.0;
  double explained_variation = 0.0;
  double undersegmentation_error = 0.0;
  double boundary_recall = 0.0;
  double pureness = 0.0;
};

/// With the usual radius. Errors: kInvalidArgument when the three are not of the same cells, a
/// label is out of range, a segment has no cell or the stack no layer. Cost: O(cells * layers + c
/// log c) for c cells.
[[nodiscard]] Result<SegmentationMetrics> segmentation_metrics(const CellSegmentation& segmentation,
                                                               const CellSegmentation& truth,
                                                               const GridStack& stack);

}  // namespace hypermap
