// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which cells two lists of voted cells have in common.
#pragma once

#include "hypermap/core/geometry/occupancy_votes.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace hypermap {

/// Walks two lists of voted cells together: finds the coarser cell around each finer one.
///
/// Cells ascend by x, then y, then z. All with one x are a slab, all with one x and y a column; the
/// cells around those of a column are in one column, and ascend.
class CommonCellWalk {
 public:
  CommonCellWalk(std::span<const PointVote> finer, std::span<const PointVote> coarser, int shift)
      : finer_(finer), coarser_(coarser), shift_(shift) {}

  /// Calls `visit(position in finer, position in coarser)`.
  template <class Visit>
  void run(Visit visit) const {
    std::size_t fine = 0;
    std::size_t slab = 0;
    while (fine < finer_.size() && slab < coarser_.size()) {
      const std::int64_t x = finer_[fine].cell.x >> shift_;
      slab = first_with_x(coarser_, slab, x);
      if (slab == coarser_.size()) return;
      if (coarser_[slab].cell.x != x) {  // steps over all finer slabs before it
        fine = first_with_x(finer_, fine, coarser_[slab].cell.x * (std::int64_t{1} << shift_));
        continue;
      }
      const std::size_t fine_end =
          first_with_x(finer_, fine, std::int64_t{finer_[fine].cell.x} + 1);
      walk_slab(fine, fine_end, slab, first_with_x(coarser_, slab, x + 1), visit);
      fine = fine_end;
    }
  }

 private:
  using Votes = std::span<const PointVote>;

  /// The first position from `from` on whose cell has this x or a larger one; the end if none has.
  static std::size_t first_with_x(Votes votes, std::size_t from, std::int64_t x) {
    const auto at = std::lower_bound(
        votes.begin() + static_cast<std::ptrdiff_t>(from),
        votes.end(),
        x,
        [](const PointVote& vote, std::int64_t wanted) { return vote.cell.x < wanted; });
    return static_cast<std::size_t>(at - votes.begin());
  }

  template <class Visit>
  void walk_slab(std::size_t fine,
                 std::size_t fine_end,
                 std::size_t column,
                 std::size_t coarse_end,
                 Visit& visit) const {
    while (fine < fine_end && column < coarse_end) {
      const std::int32_t fine_y = finer_[fine].cell.y;
      const std::int32_t y = fine_y >> shift_;
      const std::int32_t column_y = coarser_[column].cell.y;
      if (column_y < y) {
        ++column;
      } else if (column_y > y) {
        ++fine;
      } else {
        fine = walk_column(fine, fine_end, column, coarse_end, visit);
        // The next finer column may lie in the same coarser one.
      }
    }
  }

  /// Returns where the finer column ends.
  template <class Visit>
  std::size_t walk_column(std::size_t fine,
                          std::size_t fine_end,
                          std::size_t coarse,
                          std::size_t coarse_end,
                          Visit& visit) const {
    const std::int32_t fine_y = finer_[fine].cell.y;
    const std::int32_t y = coarser_[coarse].cell.y;
    for (; fine < fine_end && finer_[fine].cell.y == fine_y; ++fine) {
      const std::int32_t z = finer_[fine].cell.z >> shift_;
      const auto is_before = [&](const PointCell& cell) { return cell.y == y && cell.z < z; };
      while (coarse < coarse_end && is_before(coarser_[coarse].cell)) ++coarse;
      if (coarse < coarse_end && coarser_[coarse].cell.y == y && coarser_[coarse].cell.z == z) {
        visit(fine, coarse);
      }
    }
    return fine;
  }

  Votes finer_;
  Votes coarser_;
  int shift_;
};

/// Calls `visit(i, k)` for each cell `finer[i]` that lies in a cell `coarser[k]`, in ascending
/// order of i. The edges of the coarser cells are 2^shift times those of the finer ones. Requires:
/// both lists ascend by cell, each cell once. Cost: O(cells of the slabs of x that both have, the
/// coarser ones 2^shift times), else a bisection for each slab; no allocation.
template <class Visit>
void for_each_common_cell(std::span<const PointVote> finer,
                          std::span<const PointVote> coarser,
                          int shift,
                          Visit visit) {
  CommonCellWalk(finer, coarser, shift).run(visit);
}

}  // namespace hypermap
