// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which cells of a stack belong together: connected regions whose cells say much the same on every
/// layer (SEVDS).
///
/// Source: [sogm] III-D.2, Eq. (7) to (10), figure 5; [seeds] M. Van den Bergh et al., SEEDS, ECCV
/// 2012, for the hierarchy of moves and the contour reward G.
/// Erratum: Eq. (9) divides the argument of the boxcar by K; bins of width 1/K need it times K.
/// Here bin k is [k/K, (k+1)/K), the last one closed, so that 0, 0.5 and 1 have a bin. Erratum: H
/// of Eq. (7) is maximised in [seeds], D' is to be minimised: here H = D' - gamma G. Deviation: the
/// variance of a marginal histogram, bin centres weighted by counts, follows from its count and two
/// whole sums, so a tried move costs O(N) for N layers instead of O(K N).
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/grids/grid_geometry.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hypermap {

struct OptionTable;

struct SupercellOptions {
  /// The first supercells are squares of 2^num_levels cells, about the smallest object to be found;
  /// then blocks of half that edge change sides, of a quarter and so on, at last single cells.
  int num_levels = 3;
  int num_bins = 16;  ///< K of [sogm] Eq. (9): probabilities are told apart by 1/K.
  /// gamma of [sogm] Eq. (7): larger makes outlines smoother.
  double contour_weight = 1e-4;
  /// A block changes sides when both supercells together gain, instead of the growing one alone.
  /// Goes without `cell_weighted`, by which both must gain anyway.
  bool total = false;
  /// Ours, for outlines that keep to those of objects: a supercell of n cells has n^(3/4) sqrt(D')
  /// in H instead of D', so that it is no gain to be large and mixed; both supercells together must
  /// gain by a move; and blocks are of two cells a side at most. Measured: docs/RESULTS.md.
  bool cell_weighted = false;
  int max_passes = 10;  ///< Over all blocks of one size; fewer when none changes sides.
  friend bool operator==(const SupercellOptions&, const SupercellOptions&) = default;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const SupercellOptions& options);
[[nodiscard]] const OptionTable& option_table(const SupercellOptions& options);

/// Every cell of a stack belongs to one supercell; each supercell is connected over edges.
struct Supercells {
  GridGeometry geometry;
  std::vector<std::int32_t> labels;  ///< Of each cell, 0 .. count - 1; row-major, row 0 = min y.
  int count = 0;
  double first_energy = 0.0;  ///< H of the squares at the start, summed over all supercells.
  double energy = 0.0;        ///< H at the end.
  std::size_t num_moves = 0;  ///< Blocks and cells that changed sides.
  friend bool operator==(const Supercells&, const Supercells&) = default;
};

/// Lets squares exchange blocks and cells until no exchange helps.
///
/// Source: [sogm] Eq. (7) to (10). A block goes to the neighbour that gains most by it: the printed
/// rule, D'(c and block) < D'(c), with the change of gamma G. Unknown cells have p = 0.5. A
/// supercell whose cells all lie in one bin of each layer does not shrink ([sogm] III-D.2, last
/// paragraph), and none is parted or vanishes. Deviation: whether a supercell would be parted is
/// asked of the block's eight neighbours alone; some moves are refused that only a longer way round
/// would allow. Boundary: where sides are no multiples of the first edge, the last supercells are
/// larger; a stack smaller than one square is one supercell. Errors: those of validate;
/// kInvalidArgument when the stack has no layers; kOutOfMemory. Cost: O(passes * boundary blocks *
/// N), memory O(N) a cell. One order, no threads.
[[nodiscard]] Result<Supercells> extract_supercells(const GridStack& stack,
                                                    const SupercellOptions& options = {});

/// The supercell that holds a point of the stack's frame; none outside.
[[nodiscard]] std::optional<int> supercell_at(const Supercells& supercells,
                                              const Eigen::Vector2d& point);

}  // namespace hypermap
