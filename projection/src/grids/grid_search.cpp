// SPDX-License-Identifier: BSD-3-Clause
#include "grids/grid_search.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

namespace hypermap {
namespace {

struct Step {
  int cols;
  int rows;
  double cells;
};

constexpr std::array<Step, 8> kSteps{{{1, 0, 1.0},
                                      {0, 1, 1.0},
                                      {-1, 0, 1.0},
                                      {0, -1, 1.0},
                                      {1, 1, std::numbers::sqrt2},
                                      {-1, 1, std::numbers::sqrt2},
                                      {-1, -1, std::numbers::sqrt2},
                                      {1, -1, std::numbers::sqrt2}}};
constexpr std::uint8_t kNoStep = 255;

bool is_possible(const FreeSpace& space, Cell from, const Step& step) {
  if (!space.fits({from.col + step.cols, from.row + step.rows})) return false;
  if (step.cols == 0 || step.rows == 0) return true;
  return space.fits({from.col + step.cols, from.row}) &&
         space.fits({from.col, from.row + step.rows});
}

}  // namespace

GridSearch::GridSearch(const FreeSpace& space, Cell start, const SearchVisitor& visit)
    : geometry_(space.geometry()),
      cells_(geometry_.num_cells(), std::numeric_limits<double>::infinity()),
      step_(geometry_.num_cells(), kNoStep) {
  const std::size_t first = geometry_.index(start);
  cells_[first] = 0.0;
  heap_.emplace_back(0.0, first);
  while (!heap_.empty()) {
    std::ranges::pop_heap(heap_, std::greater<>());
    const auto [cells, place] = heap_.back();
    heap_.pop_back();
    if (cells > cells_[place]) continue;  // a shorter way came before
    if (!visit(place, cells)) return;
    for (std::size_t i = 0; i < kSteps.size(); ++i) {
      relax(space, cell_of(place), cells, static_cast<int>(i));
    }
  }
}

void GridSearch::relax(const FreeSpace& space, Cell from, double cells, int step) {
  const Step& taken = kSteps[static_cast<std::size_t>(step)];
  if (!is_possible(space, from, taken)) return;
  const std::size_t place = geometry_.index({from.col + taken.cols, from.row + taken.rows});
  const double here = cells + taken.cells;
  if (!(here < cells_[place])) return;
  cells_[place] = here;
  step_[place] = static_cast<std::uint8_t>(step);
  heap_.emplace_back(here, place);
  std::ranges::push_heap(heap_, std::greater<>());
}

Cell GridSearch::cell_of(std::size_t place) const {
  const auto cols = static_cast<std::size_t>(geometry_.cols);
  return {static_cast<int>(place % cols), static_cast<int>(place / cols)};
}

std::vector<Cell> GridSearch::way_to(std::size_t place) const {
  std::vector<Cell> way{cell_of(place)};
  for (std::uint8_t step = step_[place]; step != kNoStep;
       step = step_[geometry_.index(way.back())]) {
    const Step& taken = kSteps[step];
    way.push_back({way.back().col - taken.cols, way.back().row - taken.rows});
  }
  std::ranges::reverse(way);
  return way;
}

bool is_straight_free(const FreeSpace& space, Cell from, Cell to) {
  const std::int64_t cols = std::abs(to.col - from.col);
  const std::int64_t rows = std::abs(to.row - from.row);
  const int right = to.col > from.col ? 1 : -1;
  const int up = to.row > from.row ? 1 : -1;
  Cell at = from;
  // The next edge between columns is crossed after (2 i + 1) / (2 cols) of the line, that between
  // rows after (2 j + 1) / (2 rows): in whole numbers over their common denominator.
  std::int64_t next_col = rows;
  std::int64_t next_row = cols;
  while (space.fits(at)) {
    if (at == to) return true;
    const bool is_corner = next_col == next_row && cols > 0 && rows > 0;
    if (is_corner && !(space.fits({at.col + right, at.row}) && space.fits({at.col, at.row + up}))) {
      return false;
    }
    const bool takes_col = is_corner || (cols > 0 && (rows == 0 || next_col < next_row));
    const bool takes_row = is_corner || !takes_col;
    if (takes_col) {
      at.col += right;
      next_col += 2 * rows;
    }
    if (takes_row) {
      at.row += up;
      next_row += 2 * cols;
    }
  }
  return false;
}

}  // namespace hypermap
