// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The voted cells of an object as two texts, as files of version 2 have them.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/occupancy_votes.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace hypermap {

/// Cells as an octree over the cube of 2^levels cells that begins at `origin`, depth first; of a
/// node the child (x, y, z), each 0 or 1, is number 4 x + 2 y + z.
struct VotedCellsText {
  PointCell origin;
  int levels = 0;  ///< 0 .. 32. 0: one cell or none.
  std::string
      masks;  ///< Of each inner node its children, bit k for child k: two hexadecimal digits.
  /// Of each cell its votes: base64 digits of five bits, the lowest first, all but the last with
  /// the sixth bit set (the variable-length quantity of "Source Map Revision 3", unsigned).
  std::string votes;
};

/// The cells, ascending. Boundary: none for empty texts.
/// Errors: kMalformedFile for texts that no writer made and for more than `max_cells` cells, with
/// the reason and the field, "levels", "cells" (the masks) or "votes". Cost: O(text), memory of at
/// most `max_cells` cells.
[[nodiscard]] Result<std::vector<PointVote>> voted_cells(const VotedCellsText& text,
                                                         std::uint32_t max_cells);

}  // namespace hypermap
