// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Regions of a mask that are joined to each other by narrow gaps only.
#pragma once

#include "grids/clearance.hpp"
#include "hypermap/projection/grids/rooms.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hypermap {

/// No region.
inline constexpr std::uint32_t kNoRegion = 0xFFFFFFFFU;

/// Regions, and of each cell its own or kNoRegion.
struct RoomRegions {
  std::vector<std::uint32_t> cells;
  std::vector<std::size_t> widest;     ///< Of each region the cell of the largest clearance.
  std::vector<std::size_t> num_cells;  ///< Of each region.
};

/// The cells of the mask, flooded from the largest clearance down: where two regions meet they are
/// one unless the gap parts them (`RoomOptions::doorway_m`, `max_gap_share`).
/// Requires: `clearance` is that of a mask that holds `mask`. Cost: O(n log n).
[[nodiscard]] RoomRegions flood_regions(const CellMask& mask,
                                        const std::vector<std::int64_t>& clearance,
                                        double resolution_m,
                                        const RoomOptions& options);

/// Width of the gap in whose middle a cell of such a clearance lies, to one cell.
[[nodiscard]] double gap_width_m(std::int64_t squared_clearance, double resolution_m);

/// Regions of fewer than `min_cells` become, the smallest first, part of the neighbour with the
/// widest gap to them, or no region where they have none. Cost: O(n log n), however many they are.
[[nodiscard]] RoomRegions without_niches(RoomRegions regions,
                                         const CellMask& mask,
                                         const std::vector<std::int64_t>& clearance,
                                         std::size_t min_cells);

}  // namespace hypermap
