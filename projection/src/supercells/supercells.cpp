// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/supercells/supercells.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/option_rows.hpp"
#include "supercell_moves.hpp"

namespace hypermap {
namespace {

/// Less is rounding.
constexpr double kLeastFall = 1e-12;

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
    option::count<&SupercellOptions::max_passes>(
        "max_passes", {1, 1000}, {.effect = "Most passes over all blocks of one size."}),
};

/// The neighbour by whose taking the block the energy falls most; none when it falls by none.
std::optional<int> best_taker(SupercellMoves& moves, Block block) {
  const int own = moves.label(block);
  std::optional<int> best;
  double best_change = -kLeastFall;
  for (const int to : moves.labels_beside(block)) {
    if (to < 0 || to == own || to == best) continue;
    const double change = moves.energy_change(block, to);
    const bool is_better = change < best_change || (best && change == best_change && to < *best);
    if (!is_better) continue;
    best = to;
    best_change = change;
  }
  return best;
}

bool has_other_beside(const SupercellMoves& moves, Block block) {
  const int own = moves.label(block);
  for (const int label : moves.labels_beside(block)) {
    if (label >= 0 && label != own) return true;
  }
  return false;
}

/// Tries each block once; gives how many changed sides.
std::size_t pass_over_blocks(SupercellMoves& moves) {
  std::size_t num_moves = 0;
  for (int row = 0; row < moves.block_rows(); ++row) {
    for (int col = 0; col < moves.block_cols(); ++col) {
      const Block block{col, row};
      if (!has_other_beside(moves, block) || !moves.may_leave(block)) continue;
      const auto to = best_taker(moves, block);
      if (!to) continue;
      moves.move(block, *to);
      ++num_moves;
    }
  }
  return num_moves;
}

}  // namespace

const OptionTable& option_table(const SupercellOptions&) {
  static constexpr OptionTable kTable{kSupercellRows};
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
    for (int level = options.num_levels - 1; level >= 0; --level) {
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
