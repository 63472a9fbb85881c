// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/grid_agreement.hpp"

namespace hypermap {
namespace {

enum class CellState { kUnknown, kFree, kBlocked };

CellState cell_state(std::int8_t occupancy) {
  if (occupancy == kUnknownCell) return CellState::kUnknown;
  return occupancy < kLeastBlocked ? CellState::kFree : CellState::kBlocked;
}

CellState state_at(const OccupancyGrid& grid, const Eigen::Vector2d& point) {
  return cell_state(grid.at_point(point).value_or(kUnknownCell));
}

bool is_blocked_around(const OccupancyGrid& grid, const Eigen::Vector2d& point) {
  const Eigen::Vector2d in_cells = to_cells(grid.geometry(), point);
  for (int row = -1; row <= 1; ++row) {
    for (int col = -1; col <= 1; ++col) {
      const Eigen::Vector2d beside = in_cells + Eigen::Vector2d(col, row);
      if (state_at(grid, from_cells(grid.geometry(), beside)) == CellState::kBlocked) return true;
    }
  }
  return false;
}

/// Calls `visit(middle, state)` for each cell that is known.
template <class Visit>
void for_each_known(const OccupancyGrid& grid, Visit visit) {
  for (int row = 0; row < grid.geometry().rows; ++row) {
    for (int col = 0; col < grid.geometry().cols; ++col) {
      const Cell cell{.col = col, .row = row};
      const CellState state = cell_state(grid.at(cell));
      if (state != CellState::kUnknown) visit(centre(grid.geometry(), cell), state);
    }
  }
}

std::optional<double> share(std::size_t part, std::size_t whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

std::optional<double> GridAgreement::free_precision() const {
  return share(free_right, free);
}
std::optional<double> GridAgreement::free_recall() const {
  return share(free_found, true_free);
}
std::optional<double> GridAgreement::occupied_precision() const {
  return share(occupied_right, occupied);
}
std::optional<double> GridAgreement::occupied_recall() const {
  return share(occupied_found, true_occupied);
}

GridAgreement grid_agreement(const OccupancyGrid& map, const OccupancyGrid& truth) {
  GridAgreement agreement;
  for_each_known(map, [&](const Eigen::Vector2d& middle, CellState state) {
    const CellState true_state = state_at(truth, middle);
    if (true_state == CellState::kUnknown) return;
    if (state == CellState::kFree) {
      ++agreement.free;
      agreement.free_right += true_state == CellState::kFree ? 1U : 0U;
    } else {
      ++agreement.occupied;
      agreement.occupied_right += is_blocked_around(truth, middle) ? 1U : 0U;
    }
  });
  for_each_known(truth, [&](const Eigen::Vector2d& middle, CellState true_state) {
    const bool is_free = state_at(map, middle) == CellState::kFree;
    if (true_state == CellState::kFree) {
      ++agreement.true_free;
      agreement.free_found += is_free ? 1U : 0U;
    } else {
      ++agreement.true_occupied;
      agreement.occupied_found += is_blocked_around(map, middle) ? 1U : 0U;
      agreement.occupied_free += is_free ? 1U : 0U;
    }
  });
  return agreement;
}

}  // namespace hypermap
