// SPDX-License-Identifier: BSD-3-Clause
#include "supercell_moves.hpp"

#include <algorithm>
#include <cassert>

namespace hypermap {
namespace {

/// Around a block, from the right on, counter-clockwise; those beside it have even places.
constexpr std::array<std::array<int, 2>, 8> kRing{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

CellSums empty_set(int num_layers) {
  return {.num_cells = 0,
          .layers = std::vector<HistogramSums>(static_cast<std::size_t>(num_layers))};
}

/// How many squares fit side by side; at least one, what is left over goes to the last.
int num_squares(int side, int level) {
  return std::max(side >> level, 1);
}

}  // namespace

SupercellMoves::SupercellMoves(const BinnedCells& cells, const SupercellOptions& options)
    : cells_(&cells), options_(options), cell_(empty_set(cells.num_layers)) {
  const int cols = num_squares(cells.cols, options.num_levels);
  const int rows = num_squares(cells.rows, options.num_levels);
  const auto num_cells =
      static_cast<std::size_t>(cells.cols) * static_cast<std::size_t>(cells.rows);
  labels_.reserve(num_cells);
  supercells_.assign(static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows),
                     empty_set(cells.num_layers));
  for (int row = 0; row < cells.rows; ++row) {
    for (int col = 0; col < cells.cols; ++col) {
      const int square_col = std::min(col >> options.num_levels, cols - 1);
      const int square_row = std::min(row >> options.num_levels, rows - 1);
      labels_.push_back(square_row * cols + square_col);
      add_cell(supercells_[static_cast<std::size_t>(labels_.back())],
               cells.of_cell(cell_index(col, row)));
    }
  }
  for (const CellSums& set : supercells_) energy_ += variance_of(set, cells.num_bins);
  const CellRect none{};
  for (int row = 0; row < cells.rows; ++row) {
    for (int col = 0; col < cells.cols; ++col) {
      energy_ -= options.contour_weight * contour_at(col, row, none, -1);
    }
  }
  set_level(options.num_levels - 1);
}

void SupercellMoves::set_level(int level) {
  level_ = level;
  const int edge = 1 << level;
  block_cols_ = (cells_->cols + edge - 1) / edge;
  block_rows_ = (cells_->rows + edge - 1) / edge;
  const auto num_blocks =
      static_cast<std::size_t>(block_cols_) * static_cast<std::size_t>(block_rows_);
  blocks_.clear();
  if (level == 0) return;
  blocks_.assign(num_blocks, empty_set(cells_->num_layers));
  for (int row = 0; row < cells_->rows; ++row) {
    for (int col = 0; col < cells_->cols; ++col) {
      const int block = (row >> level) * block_cols_ + (col >> level);
      add_cell(blocks_[static_cast<std::size_t>(block)], cells_->of_cell(cell_index(col, row)));
    }
  }
}

SupercellMoves::CellRect SupercellMoves::rect_of(Block block) const {
  return {.left = block.col << level_,
          .low = block.row << level_,
          .right = std::min((block.col + 1) << level_, cells_->cols),
          .high = std::min((block.row + 1) << level_, cells_->rows)};
}

const CellSums& SupercellMoves::set_of(Block block) {
  const std::size_t place =
      static_cast<std::size_t>(block.row) * static_cast<std::size_t>(block_cols_) +
      static_cast<std::size_t>(block.col);
  if (level_ > 0) return blocks_[place];
  cell_.num_cells = 0;
  std::ranges::fill(cell_.layers, HistogramSums{});
  add_cell(cell_, cells_->of_cell(place));
  return cell_;
}

int SupercellMoves::label(Block block) const {
  return labels_[cell_index(block.col << level_, block.row << level_)];
}

std::array<int, 4> SupercellMoves::labels_beside(Block block) const {
  std::array<int, 4> labels{};
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const Block beside{block.col + kRing[2 * i][0], block.row + kRing[2 * i][1]};
    const bool is_inside =
        beside.col >= 0 && beside.row >= 0 && beside.col < block_cols_ && beside.row < block_rows_;
    labels[i] = is_inside ? label(beside) : -1;
  }
  return labels;
}

bool SupercellMoves::may_leave(Block block) const {
  const int own = label(block);
  if (has_no_variance(supercells_[static_cast<std::size_t>(own)])) return false;
  const std::array<int, 4> beside = labels_beside(block);
  const auto num_beside = std::ranges::count(beside, own);
  // Neighbours that are connected with the next one around the block, by the corner between.
  int num_links = 0;
  for (std::size_t i = 0; i < beside.size(); ++i) {
    if (beside[i] != own || beside[(i + 1) % 4] != own) continue;
    const auto& corner = kRing[2 * i + 1];
    if (label({block.col + corner[0], block.row + corner[1]}) == own) ++num_links;
  }
  return num_beside > 0 && num_links >= num_beside - 1;
}

double SupercellMoves::contour_at(int col, int row, const CellRect& rect, int label_inside) const {
  // The share of equal pairs among the cells around: the sum of squared shares of labels.
  std::array<int, 9> labels{};
  std::size_t n = 0;
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, cells_->rows - 1); ++y) {
    for (int x = std::max(col - 1, 0); x <= std::min(col + 1, cells_->cols - 1); ++x) {
      const bool is_in_rect = x >= rect.left && x < rect.right && y >= rect.low && y < rect.high;
      labels[n++] = is_in_rect ? label_inside : labels_[cell_index(x, y)];
    }
  }
  std::size_t num_equal = n;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = i + 1; k < n; ++k) num_equal += labels[i] == labels[k] ? 2U : 0U;
  }
  return static_cast<double>(num_equal) / static_cast<double>(n * n);
}

double SupercellMoves::contour_around(const CellRect& rect, int label_inside) const {
  double sum = 0.0;
  for (int row = std::max(rect.low - 1, 0); row < std::min(rect.high + 1, cells_->rows); ++row) {
    const bool is_deep_row = row > rect.low && row < rect.high - 1;
    for (int col = std::max(rect.left - 1, 0); col < std::min(rect.right + 1, cells_->cols);
         ++col) {
      const bool is_deep = is_deep_row && col > rect.left && col < rect.right - 1;
      if (!is_deep) sum += contour_at(col, row, rect, label_inside);
    }
  }
  return sum;
}

double SupercellMoves::contour_change(const CellRect& rect, int from, int to) const {
  if (options_.contour_weight == 0.0) return 0.0;
  return contour_around(rect, to) - contour_around(rect, from);
}

double SupercellMoves::variance_change(int label, const CellSums& set, int sign) const {
  const CellSums& supercell = supercells_[static_cast<std::size_t>(label)];
  return variance_with(supercell, set, sign, cells_->num_bins) -
         variance_of(supercell, cells_->num_bins);
}

double SupercellMoves::energy_change(Block block, int to) {
  const CellSums& set = set_of(block);
  const int from = label(block);
  const double growing = variance_change(to, set, 1);
  const double shrinking = options_.total ? variance_change(from, set, -1) : 0.0;
  return growing + shrinking - options_.contour_weight * contour_change(rect_of(block), from, to);
}

void SupercellMoves::move(Block block, int to) {
  assert(may_leave(block) && to != label(block));
  const CellSums& set = set_of(block);
  const int from = label(block);
  const CellRect rect = rect_of(block);
  energy_ += variance_change(to, set, 1) + variance_change(from, set, -1) -
             options_.contour_weight * contour_change(rect, from, to);
  remove_cells(supercells_[static_cast<std::size_t>(from)], set);
  add_cells(supercells_[static_cast<std::size_t>(to)], set);
  for (int row = rect.low; row < rect.high; ++row) {
    for (int col = rect.left; col < rect.right; ++col) labels_[cell_index(col, row)] = to;
  }
}

}  // namespace hypermap
