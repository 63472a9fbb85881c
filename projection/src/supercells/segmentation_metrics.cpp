// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/supercells/segmentation_metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hypermap {
namespace {

constexpr double kRadiusOfDiagonal = 0.0025;

/// How many cells two segments have in common.
struct Intersection {
  std::int32_t label = 0;
  std::int32_t of_truth = 0;
  std::int64_t num_cells = 0;
};

std::size_t place_of(std::int32_t label) {
  return static_cast<std::size_t>(label);
}

/// By label, then by true label.
std::vector<Intersection> intersections(const CellSegmentation& segmentation,
                                        const CellSegmentation& truth) {
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  pairs.reserve(segmentation.labels.size());
  for (std::size_t i = 0; i < segmentation.labels.size(); ++i) {
    pairs.emplace_back(segmentation.labels[i], truth.labels[i]);
  }
  std::ranges::sort(pairs);
  std::vector<Intersection> found;
  for (const auto& [label, of_truth] : pairs) {
    const bool is_same =
        !found.empty() && found.back().label == label && found.back().of_truth == of_truth;
    if (!is_same) found.push_back({.label = label, .of_truth = of_truth});
    ++found.back().num_cells;
  }
  return found;
}

std::vector<std::int64_t> sizes_of(const CellSegmentation& segmentation) {
  std::vector<std::int64_t> sizes(static_cast<std::size_t>(segmentation.count), 0);
  for (const std::int32_t label : segmentation.labels) ++sizes[place_of(label)];
  return sizes;
}

/// Squares of distances, summed over layers and cells: of each cell to the mean of its segment, by
/// segment; of those means, and of the cells, to the mean of all.
struct Scatter {
  std::vector<double> within;
  double between = 0.0;
  double total = 0.0;
};

void add_layer(Scatter& scatter,
               const CellSegmentation& segmentation,
               const std::vector<std::int64_t>& sizes,
               const LogOddsGrid& grid) {
  std::vector<double> p;
  p.reserve(grid.cells().size());
  for (const LogOddsSteps steps : grid.cells()) {
    p.push_back(from_steps(steps).probability().value());
  }
  std::vector<double> means(sizes.size(), 0.0);
  double mean = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    means[place_of(segmentation.labels[i])] += p[i];
    mean += p[i];
  }
  for (std::size_t k = 0; k < means.size(); ++k) means[k] /= static_cast<double>(sizes[k]);
  mean /= static_cast<double>(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    const std::size_t segment = place_of(segmentation.labels[i]);
    const double to_own = p[i] - means[segment];
    const double to_all = p[i] - mean;
    scatter.within[segment] += to_own * to_own;
    scatter.between += (means[segment] - mean) * (means[segment] - mean);
    scatter.total += to_all * to_all;
  }
}

Scatter scatter_of(const CellSegmentation& segmentation,
                   const std::vector<std::int64_t>& sizes,
                   const GridStack& stack) {
  Scatter scatter{.within = std::vector<double>(sizes.size(), 0.0)};
  for (const auto& [name, grid] : stack.layers()) add_layer(scatter, segmentation, sizes, grid);
  return scatter;
}

double intra_cluster_variation_of(const Scatter& scatter, const std::vector<std::int64_t>& sizes) {
  double sum = 0.0;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    sum += std::sqrt(scatter.within[k] / static_cast<double>(sizes[k]));
  }
  return sum / static_cast<double>(sizes.size());
}

double explained_variation_of(const Scatter& scatter) {
  return scatter.total > 0.0 ? scatter.between / scatter.total : 1.0;
}

double undersegmentation_error_of(const std::vector<Intersection>& common,
                                  const std::vector<std::int64_t>& sizes,
                                  std::size_t num_cells) {
  std::int64_t leaked = 0;
  for (const Intersection& part : common) {
    leaked += std::min(part.num_cells, sizes[place_of(part.label)] - part.num_cells);
  }
  return static_cast<double>(leaked) / static_cast<double>(num_cells);
}

double pureness_of(const std::vector<Intersection>& common,
                   const std::vector<std::int64_t>& sizes) {
  std::vector<std::int64_t> largest(sizes.size(), 0);
  for (const Intersection& part : common) {
    std::int64_t& most = largest[place_of(part.label)];
    most = std::max(most, part.num_cells);
  }
  double sum = 0.0;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    sum += static_cast<double>(largest[k]) / static_cast<double>(sizes[k]);
  }
  return sum / static_cast<double>(sizes.size());
}

/// Where cells lie on outlines.
std::vector<bool> outlines_of(const CellSegmentation& segmentation) {
  const auto cols = static_cast<std::size_t>(segmentation.cols);
  const auto rows = static_cast<std::size_t>(segmentation.rows);
  const auto& labels = segmentation.labels;
  std::vector<bool> is_outline(labels.size(), false);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t col = 0; col < cols; ++col) {
      const std::size_t i = row * cols + col;
      const auto mark = [&](std::size_t other) {
        if (labels[i] == labels[other]) return;
        is_outline[i] = true;
        is_outline[other] = true;
      };
      if (col + 1 < cols) mark(i + 1);
      if (row + 1 < rows) mark(i + cols);
    }
  }
  return is_outline;
}

bool has_marked_around(
    const std::vector<bool>& marks, const CellSegmentation& grid, int col, int row, int radius) {
  for (int y = std::max(row - radius, 0); y <= std::min(row + radius, grid.rows - 1); ++y) {
    for (int x = std::max(col - radius, 0); x <= std::min(col + radius, grid.cols - 1); ++x) {
      const auto place = static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.cols) +
                         static_cast<std::size_t>(x);
      if (marks[place]) return true;
    }
  }
  return false;
}

Result<void> check_segmentation(const CellSegmentation& segmentation,
                                const GridGeometry& geometry,
                                const char* name) {
  const bool is_match = segmentation.cols == geometry.cols && segmentation.rows == geometry.rows &&
                        segmentation.labels.size() == geometry.num_cells();
  if (!is_match) return fail(ErrorCode::kInvalidArgument, "must be of the stack's cells", name);
  const bool is_in_range = std::ranges::all_of(segmentation.labels, [&](std::int32_t label) {
    return label >= 0 && label < segmentation.count;
  });
  if (!is_in_range) {
    return fail(ErrorCode::kInvalidArgument,
                "labels must be 0 to " + std::to_string(segmentation.count - 1),
                name);
  }
  const std::vector<std::int64_t> sizes = sizes_of(segmentation);
  const auto empty = std::ranges::find(sizes, 0);
  if (empty == sizes.end()) return {};
  return fail(ErrorCode::kInvalidArgument,
              "segment " + std::to_string(empty - sizes.begin()) + " has no cells",
              name);
}

}  // namespace

CellSegmentation connected_segments(int cols, int rows, std::span<const std::int32_t> labels) {
  CellSegmentation found{.cols = cols,
                         .rows = rows,
                         .count = 0,
                         .labels = std::vector<std::int32_t>(labels.size(), -1)};
  std::vector<Cell> waiting;
  const auto index = [cols](Cell cell) {
    return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(cols) +
           static_cast<std::size_t>(cell.col);
  };
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      const std::size_t first = index({col, row});
      if (found.labels[first] >= 0) continue;
      found.labels[first] = found.count;
      waiting.push_back({col, row});
      while (!waiting.empty()) {
        const Cell here = waiting.back();
        waiting.pop_back();
        for (const auto& [x, y] :
             std::array<std::array<int, 2>, 4>{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}}) {
          const Cell next{here.col + x, here.row + y};
          const bool is_inside =
              next.col >= 0 && next.row >= 0 && next.col < cols && next.row < rows;
          if (!is_inside) continue;
          const std::size_t place = index(next);
          if (found.labels[place] >= 0 || labels[place] != labels[first]) continue;
          found.labels[place] = found.count;
          waiting.push_back(next);
        }
      }
      ++found.count;
    }
  }
  return found;
}

double intra_cluster_variation(const CellSegmentation& segmentation, const GridStack& stack) {
  const std::vector<std::int64_t> sizes = sizes_of(segmentation);
  return intra_cluster_variation_of(scatter_of(segmentation, sizes, stack), sizes);
}

double explained_variation(const CellSegmentation& segmentation, const GridStack& stack) {
  return explained_variation_of(scatter_of(segmentation, sizes_of(segmentation), stack));
}

double undersegmentation_error(const CellSegmentation& segmentation,
                               const CellSegmentation& truth) {
  return undersegmentation_error_of(
      intersections(segmentation, truth), sizes_of(segmentation), segmentation.labels.size());
}

double boundary_recall(const CellSegmentation& segmentation,
                       const CellSegmentation& truth,
                       int radius_cells) {
  const std::vector<bool> is_outline = outlines_of(segmentation);
  const std::vector<bool> is_true_outline = outlines_of(truth);
  std::size_t num_true = 0;
  std::size_t num_found = 0;
  std::size_t place = 0;
  for (int row = 0; row < truth.rows; ++row) {
    for (int col = 0; col < truth.cols; ++col, ++place) {
      if (!is_true_outline[place]) continue;
      ++num_true;
      if (has_marked_around(is_outline, truth, col, row, radius_cells)) ++num_found;
    }
  }
  return num_true > 0 ? static_cast<double>(num_found) / static_cast<double>(num_true) : 1.0;
}

int boundary_radius(const CellSegmentation& truth) {
  return static_cast<int>(
      std::lround(kRadiusOfDiagonal * std::hypot(static_cast<double>(truth.cols), truth.rows)));
}

double pureness(const CellSegmentation& segmentation, const CellSegmentation& truth) {
  return pureness_of(intersections(segmentation, truth), sizes_of(segmentation));
}

Result<SegmentationMetrics> segmentation_metrics(const CellSegmentation& segmentation,
                                                 const CellSegmentation& truth,
                                                 const GridStack& stack) {
  if (stack.layers().empty()) {
    return fail(ErrorCode::kInvalidArgument, "has no layers", "stack");
  }
  HYPERMAP_TRY(check_segmentation(segmentation, stack.geometry(), "segmentation"));
  HYPERMAP_TRY(check_segmentation(truth, stack.geometry(), "truth"));
  const std::vector<std::int64_t> sizes = sizes_of(segmentation);
  const Scatter scatter = scatter_of(segmentation, sizes, stack);
  const std::vector<Intersection> common = intersections(segmentation, truth);
  return SegmentationMetrics{
      .count = segmentation.count,
      .intra_cluster_variation = intra_cluster_variation_of(scatter, sizes),
      .explained_variation = explained_variation_of(scatter),
      .undersegmentation_error =
          undersegmentation_error_of(common, sizes, segmentation.labels.size()),
      .boundary_recall = boundary_recall(segmentation, truth, boundary_radius(truth)),
      .pureness = pureness_of(common, sizes)};
}

}  // namespace hypermap
