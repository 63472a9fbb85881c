// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/supercells/supercells.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/option_rows.hpp"
#include "supercell_moves.hpp"

#include <algorithm>

namespace hypermap {
namespace {

/// With cells counted, blocks are of two cells a side at most. Measured: docs/RESULTS.md.
constexpr int kLargestLevelByCells = 1;

constexpr OptionRow kSupercellRows[] = {
    option::count<&SupercellOptions::num_levels>(
        "num_levels",
        {1, 10},
        {.source = "[sogm] IV", .effect = "The first supercells have edges of 2^n cells."}),
    option::count<&SupercellOptions::num_bins>(
        "num_bins",
        {2, 256},
        {.source = "[sogm] Eq. (9), K", .effect = "Probabilities are told apart by 1/K."}),
    option::number<&SupercellOptions::contour_weight>(
        "contour_weight",
        {0, 1000},
        {.source = "[sogm] Eq. (7), gamma", .effect = "Larger makes outlines smoother."}),
    option::flag<&SupercellOptions::total>(
        "total", {.effect = "Both supercells together must gain by a move, not the growing one."}),
    option::flag<&SupercellOptions::cell_weighted>(
        "cell_weighted",
        {.effect = "Variances count by cells; both supercells must gain; small blocks move."}),
    option::count<&SupercellOptions::max_passes>(
        "max_passes", {1, 1000}, {.effect = "Most passes over all blocks of one size."}),
};

/// Who counts cells asks both supercells already.
Result<void> check_rules(const SupercellOptions& options) {
  if (!(options.total && options.cell_weighted)) return {};
  return fail(ErrorCode::kInvalidArgument,
              "goes without cell_weighted, by which both supercells must gain anyway",
              "total");
}

/// Tries each block once; gives how many changed sides.
std::size_t pass_over_blocks(SupercellMoves& moves) {
  std::size_t num_moves = 0;
  for (int row = 0; row < moves.block_rows(); ++row) {
    for (int col = 0; col < moves.block_cols(); ++col) {
      const Block block{col, row};
      const auto to = moves.best_taker(block);
      if (!to) continue;
      moves.move(block, *to);
      ++num_moves;
    }
  }
  return num_moves;
}

}  // namespace

const OptionTable& option_table(const SupercellOptions&) {
  static constexpr OptionTable kTable{kSupercellRows, kRule<check_rules>};
  return kTable;
}

Result<void> validate(const SupercellOptions& options) {
  return check_options(options);
}

Result<Supercells> extract_supercells(const GridStack& stack, const SupercellOptions& options) {
  HYPERMAP_TRY(validate(options));
  if (stack.layers().empty()) {
    return fail(ErrorCode::kInvalidArgument, "has no layers", "stack");
  }
  return guarded(ErrorCode::kInvalidArgument, "the supercells", [&]() -> Result<Supercells> {
    const BinnedCells cells = binned(stack, options.num_bins);
    SupercellMoves moves(cells, options);
    Supercells found{.geometry = stack.geometry(), .labels = {}, .count = moves.count()};
    found.first_energy = moves.energy();
    const int largest_level = options.cell_weighted ? kLargestLevelByCells : options.num_levels;
    const int first_level = std::min(largest_level, options.num_levels - 1);
    for (int level = first_level; level >= 0; --level) {
      moves.set_level(level);
      for (int pass = 0; pass < options.max_passes; ++pass) {
        const std::size_t num_moves = pass_over_blocks(moves);
        found.num_moves += num_moves;
        if (num_moves == 0) break;
      }
    }
    found.energy = moves.energy();
    found.labels = moves.labels();
    return found;
  });
}

std::optional<int> supercell_at(const Supercells& supercells, const Eigen::Vector2d& point) {
  const auto cell = cell_at(supercells.geometry, point);
  if (!cell) return std::nullopt;
  return supercells.labels[supercells.geometry.index(*cell)];
}

}  // namespace hypermap
