// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The voted cells of an object in few bytes: some four bits a cell.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/occupancy_votes.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hypermap {

/// Cells as an octree over the cube of 2^levels cells that begins at `origin`, level by level from
/// the root; of a node the child (x, y, z), each 0 or 1, is number 4 x + 2 y + z.
struct VotedCellsCode {
  PointCell origin;
  int levels = 0;               ///< 0 .. 32. 0: one cell or none.
  std::uint32_t num_cells = 0;  ///< At most `kMaxCellsPerByte` for each of the bytes.
  /// As BitEncoder has them: of each node which children there are, in the order of numbers, then
  /// of each cell its votes. How probable a child is follows from the cells of its level beside it
  /// and from the nodes beside its parent, how probable votes are from those of the cells beside.
  std::string bytes;
};

/// So that few bytes never stand for much memory; bytes that are too few get zeros behind.
inline constexpr std::uint32_t kMaxCellsPerByte = 4;

/// `votes`: of different cells, none without votes. Boundary: no bytes for no cells.
/// Cost: O(cells times levels).
[[nodiscard]] VotedCellsCode voted_cells_code(std::span<const PointVote> votes);

/// The cells again, ascending.
/// Errors: kMalformedFile for a code that `voted_cells_code` never makes and for more than
/// `max_cells` cells, with the reason and the field: "levels", "num_cells" or "bytes".
/// Cost: O(cells times levels), memory 60 bytes a cell while it reads.
[[nodiscard]] Result<std::vector<PointVote>> voted_cells(const VotedCellsCode& code,
                                                         std::uint32_t max_cells);

}  // namespace hypermap
