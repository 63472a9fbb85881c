// SPDX-License-Identifier: BSD-3-Clause
#include "resampler.hpp"

#include "hypermap/core/base/number_text.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace hypermap {
namespace {

/// A source is seen up to so far beyond its edge: half a cell, by interpolation.
constexpr double kReachCells = 0.5;
/// Cells of one size stay so in spite of rounding, also a thousand kilometres from the origin.
constexpr double kSameArea = 1.0 + 1e-6;
/// A corner that lies so near to one of the lattice, in cells, is that one.
constexpr double kWholeCells = 1e-6;
/// Cells of the lattice are counted so far.
constexpr double kFarthestOfLattice = 1e9;
/// Third coordinates smaller than this part of that of the middle lie at the horizon.
constexpr double kHorizon = 1e-9;
/// What is farther away, in cells, lies there too.
constexpr double kFarthest = 1e9;
/// Of the entries of a homography between cells; what has larger ones has no inverse in numbers.
constexpr double kLargestEntry = 1e30;

Eigen::Matrix3d frame_from_cells(const GridGeometry& geometry) {
  const Eigen::Vector2d x = from_cells(geometry, {1, 0}) - geometry.origin;
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix.col(0).head<2>() = x;
  matrix.col(1).head<2>() = Eigen::Vector2d(-x.y(), x.x());
  matrix.col(2).head<2>() = geometry.origin;
  return matrix;
}

/// The cells of a grid among those of the lattice of its resolution and yaw that begins at the
/// frame's origin: what a cell takes from a source then depends on the lattice alone, and not, by
/// rounding, on the grid that it is a part of.
struct OnLattice {
  GridGeometry geometry;  ///< Of its cells the first one is `first` of the grid, if that fits.
  Cell first;
};

OnLattice on_lattice(const GridGeometry& target) {
  GridGeometry lattice = target;
  lattice.origin = Eigen::Vector2d::Zero();
  const Eigen::Vector2d cells = to_cells(lattice, target.origin);
  const Eigen::Vector2d whole = cells.array().round();
  const bool fits = (cells - whole).cwiseAbs().maxCoeff() <= kWholeCells &&
                    whole.cwiseAbs().maxCoeff() <= kFarthestOfLattice;
  if (!fits) return {target, {}};
  return {lattice, {static_cast<int>(whole.x()), static_cast<int>(whole.y())}};
}

Eigen::Vector3d middle_of(const GridGeometry& geometry) {
  return {geometry.cols / 2.0, geometry.rows / 2.0, 1.0};
}

/// Both in cells; scaled so that the middle of the source has the third coordinate 1.
Result<Eigen::Matrix3d> cells_from_cells(const GridGeometry& target,
                                         const GridGeometry& source,
                                         const Eigen::Matrix3d& target_from_source) {
  if (!target_from_source.allFinite()) {
    return fail(ErrorCode::kInvalidArgument, "must be finite", "homography");
  }
  const Eigen::Matrix3d matrix =
      frame_from_cells(target).inverse() * target_from_source * frame_from_cells(source);
  const Eigen::Vector3d terms = matrix.row(2).transpose().cwiseProduct(middle_of(source));
  if (!(std::abs(terms.sum()) > kHorizon * terms.cwiseAbs().sum())) {
    return fail(
        ErrorCode::kInvalidArgument, "has the middle of the grid at its horizon", "homography");
  }
  const Eigen::Matrix3d scaled = matrix / terms.sum();
  const Eigen::Matrix3d inverse = scaled.inverse();
  const bool has_inverse = scaled.cwiseAbs().maxCoeff() < kLargestEntry && inverse.allFinite() &&
                           inverse.cwiseAbs().maxCoeff() < kLargestEntry;
  if (!has_inverse) return fail(ErrorCode::kInvalidArgument, "has no inverse", "homography");
  return scaled;
}

/// Cells of `target` that may see something of the source; all when its horizon crosses that.
CellWindow window_of(const OnLattice& target,
                     const GridGeometry& source,
                     const Eigen::Matrix3d& lattice_from_source) {
  const Eigen::Vector2d size(target.geometry.cols, target.geometry.rows);
  const Eigen::Vector2d before(target.first.col, target.first.row);
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e300);
  Eigen::Vector2d high = -low;
  for (const double x : {-kReachCells, source.cols + kReachCells}) {
    for (const double y : {-kReachCells, source.rows + kReachCells}) {
      const Eigen::Vector3d corner = lattice_from_source * Eigen::Vector3d(x, y, 1.0);
      if (corner.z() <= kHorizon) return {{0, 0}, {target.geometry.cols, target.geometry.rows}};
      low = low.cwiseMin(corner.hnormalized());
      high = high.cwiseMax(corner.hnormalized());
    }
  }
  const Eigen::Vector2d first =
      (low.array().floor().matrix() - before).cwiseMax(0.0).cwiseMin(size);
  const Eigen::Vector2d end = (high.array().ceil().matrix() - before).cwiseMax(0.0).cwiseMin(size);
  return {{static_cast<int>(first.x()), static_cast<int>(first.y())},
          {static_cast<int>(end.x()), static_cast<int>(end.y())}};
}

double signed_area(const std::array<Eigen::Vector2d, 4>& quad) {
  const Eigen::Vector2d a = quad[2] - quad[0];
  const Eigen::Vector2d b = quad[3] - quad[1];
  return (a.x() * b.y() - a.y() * b.x()) / 2.0;
}

Result<void> check_cells(const GridGeometry& geometry, const char* which) {
  HYPERMAP_TRY(validate(geometry));
  if (geometry.num_cells() > 0) return {};
  return fail(ErrorCode::kInvalidArgument, "has no cells", which);
}

}  // namespace

Resampler::Resampler(const LogOddsGrid& source, const ResamplingOptions& options)
    : source_(&source), options_(options), bound_(-1.0 * LogOdds::of(options.epsilon)) {}

Result<Resampler> Resampler::create(const LogOddsGrid& source,
                                    const GridGeometry& target,
                                    const Eigen::Matrix3d& target_from_source,
                                    const ResamplingOptions& options) {
  HYPERMAP_TRY(validate(options));
  HYPERMAP_TRY(check_cells(source.geometry(), "grid"));
  HYPERMAP_TRY(check_cells(target, "target"));
  const OnLattice lattice = on_lattice(target);
  HYPERMAP_ASSIGN_OR_RETURN(
      const Eigen::Matrix3d lattice_from_source,
      cells_from_cells(lattice.geometry, source.geometry(), target_from_source));
  Resampler resampler(source, options);
  resampler.source_from_lattice_ = lattice_from_source.inverse();
  resampler.first_ = lattice.first;
  resampler.window_ = window_of(lattice, source.geometry(), lattice_from_source);
  if (resampler.window_.is_empty()) {
    const Eigen::Vector3d at = lattice_from_source * middle_of(source.geometry());
    return fail(ErrorCode::kInvalidArgument,
                "lies outside: its middle is at column " +
                    number_text(std::round(at.x()) - lattice.first.col) + ", row " +
                    number_text(std::round(at.y()) - lattice.first.row) + " of " +
                    std::to_string(target.cols) + " x " + std::to_string(target.rows),
                "grid");
  }
  return resampler;
}

std::optional<Eigen::Vector2d> Resampler::in_source(double col, double row) const {
  const Eigen::Vector3d point =
      source_from_lattice_ * Eigen::Vector3d(first_.col + col, first_.row + row, 1.0);
  if (!(point.z() > kHorizon)) return std::nullopt;
  const Eigen::Vector2d cells = point.hnormalized();
  if (cells.cwiseAbs().maxCoeff() > kFarthest) return std::nullopt;
  return cells;
}

std::optional<Resampler::Quad> Resampler::quad_of(Cell target) const {
  const auto a = in_source(target.col, target.row);
  const auto b = in_source(target.col + 1.0, target.row);
  const auto c = in_source(target.col + 1.0, target.row + 1.0);
  const auto d = in_source(target.col, target.row + 1.0);
  if (!a || !b || !c || !d) return std::nullopt;
  Quad quad{*a, *b, *c, *d};
  const bool is_mirrored = signed_area(quad) < 0.0;
  if (is_mirrored) std::swap(quad[1], quad[3]);
  return quad;
}

LogOdds Resampler::value(int col, int row) const {
  return source_->geometry().contains({col, row}) ? source_->log_odds({col, row}) : LogOdds();
}

LogOdds Resampler::at_point(const Eigen::Vector2d& cells) const {
  const GridGeometry& geometry = source_->geometry();
  const Eigen::Vector2d from_centre = cells.array() - 0.5;
  const bool is_near = from_centre.minCoeff() > -1.0 && from_centre.x() < geometry.cols &&
                       from_centre.y() < geometry.rows;
  if (!is_near) return {};
  const Eigen::Vector2d low = from_centre.array().floor();
  const int col = static_cast<int>(low.x());
  const int row = static_cast<int>(low.y());
  const CellSquare square{.l00 = value(col, row),
                          .l10 = value(col + 1, row),
                          .l01 = value(col, row + 1),
                          .l11 = value(col + 1, row + 1)};
  return interpolated(square, from_centre.x() - low.x(), from_centre.y() - low.y(), options_);
}

LogOdds Resampler::mean_over(const Quad& quad, double area) const {
  const GridGeometry& geometry = source_->geometry();
  Eigen::Vector2d low = quad[0];
  Eigen::Vector2d high = quad[0];
  for (const Eigen::Vector2d& corner : quad) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const Eigen::Vector2d size(geometry.cols, geometry.rows);
  const Eigen::Vector2d first = low.array().floor().matrix().cwiseMax(0.0).cwiseMin(size);
  const Eigen::Vector2d end = high.array().ceil().matrix().cwiseMax(0.0).cwiseMin(size);
  // Only the cells that the quad meets, counted from the first of them.
  const GridGeometry met{.resolution_m = 1.0,
                         .origin = first,
                         .cols = static_cast<int>(end.x() - first.x()),
                         .rows = static_cast<int>(end.y() - first.y())};
  const Cell offset{static_cast<int>(first.x()), static_cast<int>(first.y())};
  double sum = 0.0;
  const Polygon polygon{.outer = {quad.begin(), quad.end()}, .holes = {}};
  for_each_covered_cell(met, polygon, [&](Cell cell, double covered) {
    const LogOdds l = value(offset.col + cell.col, offset.row + cell.row);
    sum += covered * std::clamp(l, -1.0 * bound_, bound_).value();
  });
  return LogOdds(sum / area);
}

LogOddsSteps Resampler::at(Cell target) const {
  const auto quad = quad_of(target);
  if (!quad) return 0;
  const double area = signed_area(*quad);
  const bool is_larger = area > kSameArea && options_.rule != ResamplingRule::kNearest;
  if (is_larger) return to_steps(mean_over(*quad, area));
  const auto centre = in_source(target.col + 0.5, target.row + 0.5);
  return centre ? to_steps(at_point(*centre)) : LogOddsSteps{0};
}

}  // namespace hypermap
