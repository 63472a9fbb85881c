// SPDX-License-Identifier: BSD-3-Clause
#include "supercell_moves.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace hypermap {
namespace {

/// Less is rounding.
constexpr double kLeastFall = 1e-12;

/// With cells counted, the standard deviation sqrt(D') of n cells counts n to this power. Measured:
/// docs/RESULTS.md, "Supercells against superpixels".
constexpr double kSizeExponent = 0.75;
constexpr std::int64_t kNumTabledWeights = 4096;

double size_weight(std::int64_t num_cells) {
  return std::pow(static_cast<double>(num_cells), kSizeExponent);
}

/// Around a block, from the right on, counter-clockwise; those beside it have even places.
constexpr std::array<std::array<int, 2>, 8> kRing{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// How many squares fit side by side; at least one, what is left over goes to the last.
int num_squares(int side, int level) {
  return std::max(side >> level, 1);
}

}  // namespace

SupercellMoves::SupercellMoves(const BinnedCells& cells, const SupercellOptions& options)
    : cells_(&cells), options_(options), cell_(1, cells.num_layers) {
  if (options.cell_weighted) {
    weights_.reserve(static_cast<std::size_t>(kNumTabledWeights));
    for (std::int64_t n = 0; n < kNumTabledWeights; ++n) weights_.push_back(size_weight(n));
  }
  const int cols = num_squares(cells.cols, options.num_levels);
  const int rows = num_squares(cells.rows, options.num_levels);
  const auto count = static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows);
  labels_.reserve(static_cast<std::size_t>(cells.cols) * static_cast<std::size_t>(cells.rows));
  supercells_ = CellSums(count, cells.num_layers);
  for (int row = 0; row < cells.rows; ++row) {
    for (int col = 0; col < cells.cols; ++col) {
      const int square_col = std::min(col >> options.num_levels, cols - 1);
      const int square_row = std::min(row >> options.num_levels, rows - 1);
      labels_.push_back(square_row * cols + square_col);
      supercells_.add_cell(static_cast<std::size_t>(labels_.back()),
                           cells.of_cell(cell_index(col, row)));
    }
  }
  terms_.resize(count);
  has_variance_.resize(count);
  changed_at_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    update_supercell(static_cast<int>(i));
    energy_ += terms_[i];
  }
  if (options.contour_weight > 0.0) {
    energy_ -= options.contour_weight * contour_reward(cells.cols, cells.rows, labels_);
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
  asked_at_.assign(num_blocks, 0);
  pull_ = ContourPull(cells_->cols, cells_->rows, level);
  blocks_ = CellSums();
  ++num_moves_;  // every block is asked once
  std::ranges::fill(changed_at_, num_moves_);
  if (level == 0) return;
  blocks_ = CellSums(num_blocks, cells_->num_layers);
  for (int row = 0; row < cells_->rows; ++row) {
    for (int col = 0; col < cells_->cols; ++col) {
      blocks_.add_cell(block_index({col >> level, row >> level}),
                       cells_->of_cell(cell_index(col, row)));
    }
  }
}

SetSums SupercellMoves::set_of(Block block) {
  const std::size_t place = block_index(block);
  if (level_ > 0) return blocks_.of(place);
  cell_.clear(0);
  cell_.add_cell(0, cells_->of_cell(place));
  return cell_.of(0);
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

bool SupercellMoves::stays_connected(Block block, const std::array<int, 4>& beside) const {
  const int own = label(block);
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

bool SupercellMoves::may_leave(Block block) const {
  const int own = label(block);
  return has_variance_[static_cast<std::size_t>(own)] &&
         stays_connected(block, labels_beside(block));
}

double SupercellMoves::weighted(double variance, std::int64_t num_cells) const {
  if (!options_.cell_weighted) return variance;
  const bool is_tabled = num_cells < kNumTabledWeights;
  const double weight =
      is_tabled ? weights_[static_cast<std::size_t>(num_cells)] : size_weight(num_cells);
  return weight * std::sqrt(std::max(variance, 0.0));
}

double SupercellMoves::term_change(int label, SetSums set, int sign) const {
  const auto place = static_cast<std::size_t>(label);
  const double variance = variance_with(supercells_.of(place), set, sign, cells_->num_bins);
  return weighted(variance, supercells_.num_cells(place) + sign * set[0]) - terms_[place];
}

double SupercellMoves::cost_of_leaving(Block block, SetSums set) const {
  const int from = label(block);
  const bool counts = options_.total || options_.cell_weighted;
  double cost = counts ? term_change(from, set, -1) : 0.0;
  if (options_.contour_weight > 0.0) {
    cost += options_.contour_weight * pull_.of(from, block, labels_);
  }
  return cost;
}

double SupercellMoves::cost_of_joining(Block block, SetSums set, int to) const {
  const double cost = term_change(to, set, 1);
  if (options_.contour_weight == 0.0) return cost;
  return cost - options_.contour_weight * pull_.of(to, block, labels_);
}

double SupercellMoves::energy_change(Block block, int to) {
  const SetSums set = set_of(block);
  return cost_of_leaving(block, set) + cost_of_joining(block, set, to);
}

bool SupercellMoves::is_news(Block block, const std::array<int, 4>& beside) {
  std::uint64_t& asked_at = asked_at_[block_index(block)];
  std::uint64_t last_change = changed_at_[static_cast<std::size_t>(label(block))];
  for (const int label : beside) {
    if (label >= 0)
      last_change = std::max(last_change, changed_at_[static_cast<std::size_t>(label)]);
  }
  if (last_change <= asked_at) return false;
  asked_at = num_moves_;
  return true;
}

std::optional<int> SupercellMoves::best_taker(Block block) {
  const int own = label(block);
  if (!has_variance_[static_cast<std::size_t>(own)]) return std::nullopt;
  const std::array<int, 4> beside = labels_beside(block);
  const bool is_inner =
      std::ranges::all_of(beside, [own](int label) { return label == own || label < 0; });
  if (is_inner || !is_news(block, beside) || !stays_connected(block, beside)) return std::nullopt;
  const SetSums set = set_of(block);
  const double leaving = cost_of_leaving(block, set);
  std::optional<int> best;
  double best_change = -kLeastFall;
  for (const int to : beside) {
    if (to < 0 || to == own || to == best) continue;
    const double change = leaving + cost_of_joining(block, set, to);
    const bool is_better = change < best_change || (best && change == best_change && to < *best);
    if (!is_better) continue;
    best = to;
    best_change = change;
  }
  return best;
}

void SupercellMoves::update_supercell(int label) {
  const auto place = static_cast<std::size_t>(label);
  terms_[place] =
      weighted(variance_of(supercells_.of(place), cells_->num_bins), supercells_.num_cells(place));
  has_variance_[place] = !has_no_variance(supercells_.of(place));
  changed_at_[place] = num_moves_;
}

void SupercellMoves::move(Block block, int to) {
  assert(may_leave(block) && to != label(block));
  const SetSums set = set_of(block);
  const int from = label(block);
  ++num_moves_;
  if (options_.contour_weight > 0.0) {
    energy_ -=
        options_.contour_weight * (pull_.of(to, block, labels_) - pull_.of(from, block, labels_));
  }
  supercells_.remove(static_cast<std::size_t>(from), set);
  supercells_.add(static_cast<std::size_t>(to), set);
  for (const int label : {from, to}) {
    energy_ -= terms_[static_cast<std::size_t>(label)];
    update_supercell(label);
    energy_ += terms_[static_cast<std::size_t>(label)];
  }
  const int right = std::min((block.col + 1) << level_, cells_->cols);
  const int high = std::min((block.row + 1) << level_, cells_->rows);
  for (int row = block.row << level_; row < high; ++row) {
    for (int col = block.col << level_; col < right; ++col) labels_[cell_index(col, row)] = to;
  }
}

}  // namespace hypermap
