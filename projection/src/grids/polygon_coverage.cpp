// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/grid_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hypermap {
namespace {

/// Less is rounding, not area.
constexpr double kLeastCovered = 1e-9;

/// An edge in cell units, running upwards; `turn` is +1 if the ring runs down along it, else -1, so
/// that the sum over all edges of (turn x area to their right) is the covered area.
struct Edge {
  Eigen::Vector2d low;
  Eigen::Vector2d high;
  double turn = 1.0;

  [[nodiscard]] double x_at(double y) const {
    const double part = (y - low.y()) / (high.y() - low.y());
    return low.x() + part * (high.x() - low.x());
  }
};

void append_edges(std::vector<Edge>& edges, const GridGeometry& geometry, const Ring& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d from = to_cells(geometry, ring[i]);
    const Eigen::Vector2d to = to_cells(geometry, ring[(i + 1) % ring.size()]);
    if (from.y() == to.y()) continue;
    const bool is_up = from.y() < to.y();
    edges.push_back({is_up ? from : to, is_up ? to : from, is_up ? -1.0 : 1.0});
  }
}

std::vector<Edge> edges_from_below(const GridGeometry& geometry, const Polygon& polygon) {
  std::vector<Edge> edges;
  append_edges(edges, geometry, polygon.outer);
  for (const Ring& hole : polygon.holes) append_edges(edges, geometry, hole);
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return a.low.y() < b.low.y();
  });
  return edges;
}

/// The areas of one row. `area[c]` is what edges cover within cell c itself, `carry[c]` what they
/// cover of every cell from c on.
class RowCoverage {
 public:
  explicit RowCoverage(int cols)
      : cols_(cols),
        area_(static_cast<std::size_t>(cols) + 1, 0.0),
        carry_(static_cast<std::size_t>(cols) + 1, 0.0) {}

  /// Adds the area to the right of an edge piece that lies within the row.
  void add(double x0, double x1, double height, double turn) {
    const double left = std::min(x0, x1);
    const double right = std::max(x0, x1);
    if (left >= cols_) return;
    if (right <= 0.0) return add_carry(0, turn * height);
    if (left < 0.0) {  // the piece left of the grid covers whole rows of cells
      const double outside = (0.0 - left) / (right - left);
      add_carry(0, turn * height * outside);
      return add(0.0, right, height * (1.0 - outside), turn);
    }
    add_inside(left, right, height, turn);
  }

  /// Hands the cells out and forgets them.
  void flush(int row, const CoverageVisitor& visit) {
    double covered_so_far = 0.0;
    for (int col = first_; col < cols_; ++col) {
      const auto c = static_cast<std::size_t>(col);
      covered_so_far += carry_[c];
      const double covered = std::clamp(covered_so_far + area_[c], 0.0, 1.0);
      carry_[c] = area_[c] = 0.0;
      if (covered > kLeastCovered) visit({col, row}, covered);
      if (col > last_ && covered_so_far <= kLeastCovered) break;
    }
    carry_.back() = area_.back() = 0.0;
    first_ = cols_;
    last_ = -1;
  }

 private:
  void add_carry(int col, double amount) {
    carry_[static_cast<std::size_t>(col)] += amount;
    first_ = std::min(first_, col);
    last_ = std::max(last_, col);
  }

  /// Splits the piece at the cells' edges; each part covers a trapezoid of its own cell and all
  /// cells further right.
  void add_inside(double left, double right, double height, double turn) {
    const int last = std::min(static_cast<int>(std::floor(right)), cols_ - 1);
    for (int col = static_cast<int>(std::floor(left)); col <= last; ++col) {
      const double from = std::max(left, static_cast<double>(col));
      const double to = std::min(right, static_cast<double>(col) + 1.0);
      const double part = right > left ? height * (to - from) / (right - left) : height;
      const double free_width = (from + to) / 2.0 - col;  // mean distance from the cell's left edge
      area_[static_cast<std::size_t>(col)] += turn * part * (1.0 - free_width);
      first_ = std::min(first_, col);
      add_carry(col + 1, turn * part);
    }
  }

  int cols_;
  std::vector<double> area_;
  std::vector<double> carry_;
  int first_ = 0;
  int last_ = -1;
};

int clamped_row(double y, int rows) {
  return static_cast<int>(std::clamp(std::floor(y), 0.0, static_cast<double>(rows)));
}

}  // namespace

void for_each_covered_cell(const GridGeometry& geometry,
                           const Polygon& polygon,
                           const CoverageVisitor& visit) {
  const std::vector<Edge> edges = edges_from_below(geometry, polygon);
  if (edges.empty() || geometry.num_cells() == 0) return;
  RowCoverage coverage(geometry.cols);
  std::vector<Edge> active;
  auto next = edges.begin();
  for (int row = clamped_row(edges.front().low.y(), geometry.rows); row < geometry.rows; ++row) {
    const double bottom = row;
    const double top = row + 1.0;
    for (; next != edges.end() && next->low.y() < top; ++next) active.push_back(*next);
    std::erase_if(active, [&](const Edge& edge) { return edge.high.y() <= bottom; });
    if (active.empty() && next == edges.end()) return;
    for (const Edge& edge : active) {
      const double low = std::max(edge.low.y(), bottom);
      const double high = std::min(edge.high.y(), top);
      coverage.add(edge.x_at(low), edge.x_at(high), high - low, edge.turn);
    }
    coverage.flush(row, visit);
  }
}

}  // namespace hypermap
