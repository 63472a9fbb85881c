// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A folder of tiles, ours or those of [sogm]'s public implementation, as one stack.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"

#include <filesystem>
#include <optional>

namespace hypermap {

/// The `.bin` files of a folder (sogm_tile.hpp) as one stack, or of them what lies in an area;
/// their layers are named below the parent: "/ism/amiro6/ism/cam".
///
/// Where tiles overlap, the later one counts in the cells that it knows: what it says there it
/// has from the earlier one and from its own time. The cells are those of the earliest tile; a tile
/// that is turned, or lies between them by more than a thousandth, is resampled by biodds.
/// Frame: as `options` say, since the files do not. Errors: kNotFound when there are none, or none
/// in the area; kInvalidArgument for an area without an inside, or tiles of different resolutions,
/// naming both; kLimit for more cells than a grid may have; those of read_sogm_tile and
/// GridStack::replace_cells, with the file. Cost: one tile in memory beside the stack;
/// for one that is turned, as much as a layer.
[[nodiscard]] Result<GridStack> stack_of_sogm_tiles(const std::filesystem::path& folder,
                                                    const std::optional<Rect>& area = {},
                                                    const GridStackOptions& options = {});

/// stack_of_tiles of a TileFolder where there are `.tile` files, else stack_of_sogm_tiles.
/// Errors: also kInvalidArgument when there are files of both kinds.
[[nodiscard]] Result<GridStack> read_tile_map(const std::filesystem::path& folder,
                                              const std::optional<Rect>& area = {},
                                              const GridStackOptions& options = {});

}  // namespace hypermap
