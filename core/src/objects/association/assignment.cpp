// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/assignment.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace hypermap {
namespace {

using Index = Eigen::Index;
constexpr Index kUnassigned = -1;

/// Rows and columns with potentials and the pairs made so far; more columns than rows, or equal.
class Matching {
 public:
  explicit Matching(Eigen::MatrixXd costs)
      : costs_(std::move(costs)),
        row_potential_(Eigen::VectorXd::Zero(costs_.rows())),
        column_potential_(Eigen::VectorXd::Zero(costs_.cols())),
        row_of_(static_cast<std::size_t>(costs_.cols()), kUnassigned) {}

  /// Pairs one more row along the cheapest path of exchanges.
  void add_row(Index row) {
    const auto num_columns = static_cast<std::size_t>(costs_.cols());
    std::vector<double> distance(num_columns, std::numeric_limits<double>::infinity());
    std::vector<Index> came_from(num_columns, kUnassigned);
    std::vector<bool> settled(num_columns, false);
    Index column = kUnassigned;
    Index at_row = row;
    while (at_row != kUnassigned) {
      relax(at_row, column, distance, came_from, settled);
      column = nearest_open(distance, settled);
      advance(row, distance[idx(column)], distance, settled);
      settled[idx(column)] = true;
      at_row = row_of_[idx(column)];
    }
    exchange(row, column, came_from);
  }

  [[nodiscard]] Index row_of(Index column) const { return row_of_[idx(column)]; }

 private:
  static std::size_t idx(Index i) { return static_cast<std::size_t>(i); }

  void relax(Index row,
             Index via,
             std::vector<double>& distance,
             std::vector<Index>& came_from,
             const std::vector<bool>& settled) const {
    for (Index c = 0; c < costs_.cols(); ++c) {
      if (settled[idx(c)]) continue;
      const double reduced = costs_(row, c) - row_potential_[row] - column_potential_[c];
      if (reduced < distance[idx(c)]) {
        distance[idx(c)] = reduced;
        came_from[idx(c)] = via;
      }
    }
  }

  static Index nearest_open(const std::vector<double>& distance, const std::vector<bool>& settled) {
    Index best = kUnassigned;
    for (std::size_t c = 0; c < distance.size(); ++c) {
      if (settled[c]) continue;
      if (best == kUnassigned || distance[c] < distance[idx(best)]) best = static_cast<Index>(c);
    }
    return best;
  }

  /// Moves the potentials so that the nearest open column is reached at no cost.
  void advance(Index row,
               double step,
               std::vector<double>& distance,
               const std::vector<bool>& settled) {
    row_potential_[row] += step;
    for (Index c = 0; c < costs_.cols(); ++c) {
      if (settled[idx(c)]) {
        column_potential_[c] -= step;
        row_potential_[row_of_[idx(c)]] += step;
      } else {
        distance[idx(c)] -= step;
      }
    }
  }

  void exchange(Index row, Index column, const std::vector<Index>& came_from) {
    while (column != kUnassigned) {
      const Index previous = came_from[idx(column)];
      row_of_[idx(column)] = previous == kUnassigned ? row : row_of_[idx(previous)];
      column = previous;
    }
  }

  Eigen::MatrixXd costs_;
  Eigen::VectorXd row_potential_;
  Eigen::VectorXd column_potential_;
  std::vector<Index> row_of_;
};

/// Forbidden pairs cost more than any assignment of allowed ones, so that they are made last.
Eigen::MatrixXd without_infinity(const Eigen::MatrixXd& costs) {
  double most = 0.0;
  for (Index i = 0; i < costs.size(); ++i) {
    if (std::isfinite(costs.data()[i])) most = std::max(most, std::abs(costs.data()[i]));
  }
  const double forbidden =
      (2.0 * most + 1.0) * static_cast<double>(std::min(costs.rows(), costs.cols()) + 1);
  return costs.unaryExpr([forbidden](double c) { return std::isfinite(c) ? c : forbidden; });
}

}  // namespace

std::vector<std::optional<std::size_t>> assign(const Eigen::MatrixXd& costs) {
  std::vector<std::optional<std::size_t>> column_of(static_cast<std::size_t>(costs.rows()));
  if (costs.size() == 0) return column_of;
  const bool is_tall = costs.rows() > costs.cols();
  const Eigen::MatrixXd finite = without_infinity(costs);
  Matching matching(is_tall ? Eigen::MatrixXd(finite.transpose()) : finite);
  for (Index row = 0; row < std::min(costs.rows(), costs.cols()); ++row) matching.add_row(row);
  for (Index other = 0; other < std::max(costs.rows(), costs.cols()); ++other) {
    const Index paired = matching.row_of(other);
    if (paired == kUnassigned) continue;
    const Index row = is_tall ? other : paired;
    const Index column = is_tall ? paired : other;
    if (!std::isfinite(costs(row, column))) continue;
    column_of[static_cast<std::size_t>(row)] = static_cast<std::size_t>(column);
  }
  return column_of;
}

}  // namespace hypermap
