// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/tiles/tile_map.hpp"

#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/codec/source_name.hpp"
#include "hypermap/io/tiles/sogm_tile.hpp"
#include "hypermap/io/tiles/tile_folder.hpp"
#include "hypermap/projection/stack/resampling.hpp"
#include "hypermap/projection/tiles/stored_map.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

/// What is off the cells by less counts as on them: names tell places by few digits.
constexpr double kSlackCells = 1e-3;

struct NamedTile {
  fs::path path;
  SogmTileName name;
};

/// By time.
Result<std::vector<NamedTile>> named_tiles(const fs::path& folder) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto names, files_in(folder, ".bin"));
  std::vector<NamedTile> tiles;
  tiles.reserve(names.size());
  for (const std::string& file : names) {
    auto name = parse_sogm_tile_name(file);
    if (!name) {
      return Unexpected(with_source(std::move(name).error(), {(folder / file).string()}));
    }
    tiles.push_back({folder / file, std::move(*name)});
  }
  std::ranges::sort(
      tiles, {}, [](const NamedTile& tile) { return std::tie(tile.name.stamp, tile.path); });
  return tiles;
}

Result<void> check_resolutions(const std::vector<NamedTile>& tiles) {
  const double first_m = tiles.front().name.geometry.resolution_m;
  for (const NamedTile& tile : tiles) {
    const double resolution_m = tile.name.geometry.resolution_m;
    if (resolution_m == first_m) continue;
    Error error{.code = ErrorCode::kInvalidArgument,
                .what = "has cells of " + number_text(resolution_m) + " m, others of " +
                        number_text(first_m) + " m",
                .file = tile.path.string()};
    return Unexpected(std::move(error));
  }
  return {};
}

bool meets(const Rect& a, const Rect& b) {
  return (a.min.array() < b.max.array()).all() && (b.min.array() < a.max.array()).all();
}

/// Corners on the cells of the first tile, which `whole` holds.
GridGeometry cells_around(const GridGeometry& first, const Rect& whole) {
  const double resolution_m = first.resolution_m;
  Eigen::Vector2d phase =
      first.origin - (first.origin / resolution_m).array().round().matrix() * resolution_m;
  if (phase.cwiseAbs().maxCoeff() < kSlackCells * resolution_m) phase.setZero();
  const Eigen::Vector2d low =
      ((whole.min - phase) / resolution_m).array().operator+(kSlackCells).floor();
  const Eigen::Vector2d high =
      ((whole.max - phase) / resolution_m).array().operator-(kSlackCells).ceil();
  const Eigen::Vector2d size = (high - low).cwiseMax(0.0).cwiseMin(1e9);
  return {.resolution_m = resolution_m,
          .origin = low * resolution_m + phase,
          .cols = static_cast<int>(size.x()),
          .rows = static_cast<int>(size.y())};
}

/// Cells of a stack.
struct StackPart {
  LogOddsGrid grid;
  Cell first;
};

/// As it is, where the tile's cells are the stack's; else resampled on those that it meets.
Result<StackPart> on_cells(const LogOddsGrid& tile, const GridGeometry& stack) {
  const GridGeometry& cells = tile.geometry();
  const Eigen::Vector2d offset = to_cells(stack, cells.origin);
  const Eigen::Vector2d whole = offset.array().round();
  const bool is_same = cells.yaw_rad == 0.0 &&
                       (offset - whole).cwiseAbs().maxCoeff() <= kSlackCells &&
                       whole.cwiseAbs().maxCoeff() < 1e9;
  if (is_same) {
    return StackPart{tile, {static_cast<int>(whole.x()), static_cast<int>(whole.y())}};
  }
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  HYPERMAP_ASSIGN_OR_RETURN(LogOddsGrid grid, resampled(tile, stack, identity));
  return StackPart{std::move(grid), {}};
}

/// Cells that the part does not know stay as they are.
Result<void> lay_over(StackPart part, const std::string& layer, GridStack& stack) {
  const auto known = stack.layers().find(layer);
  if (known != stack.layers().end()) {
    const GridGeometry& cells = part.grid.geometry();
    for (int row = 0; row < cells.rows; ++row) {
      for (int col = 0; col < cells.cols; ++col) {
        const Cell cell{part.first.col + col, part.first.row + row};
        const bool is_old = part.grid.at({col, row}) == 0 && stack.geometry().contains(cell);
        if (is_old) part.grid.set({col, row}, known->second.at(cell));
      }
    }
  }
  return stack.replace_cells(layer, part.grid, part.first);
}

std::string name_below(const std::string& parent, const std::string& layer) {
  return is_at_or_below(layer, parent) ? layer : parent + layer;
}

Result<void> add_tile(const NamedTile& tile, GridStack& stack) {
  HYPERMAP_ASSIGN_OR_RETURN(const SogmTile read, read_sogm_tile(tile.path));
  auto added = [&]() -> Result<void> {
    HYPERMAP_ASSIGN_OR_RETURN(StackPart part, on_cells(read.grid, stack.geometry()));
    return lay_over(std::move(part), name_below(stack.options().parent, read.name.layer), stack);
  }();
  if (!added) return Unexpected(with_source(std::move(added).error(), {tile.path.string()}));
  return {};
}

Rect around(const std::vector<NamedTile>& tiles) {
  Rect whole = bounds(tiles.front().name.geometry);
  for (const NamedTile& tile : tiles) {
    const Rect rect = bounds(tile.name.geometry);
    whole.min = whole.min.cwiseMin(rect.min);
    whole.max = whole.max.cwiseMax(rect.max);
  }
  return whole;
}

}  // namespace

Result<GridStack> stack_of_sogm_tiles(const fs::path& folder,
                                      const std::optional<Rect>& area,
                                      const GridStackOptions& options) {
  const bool is_area = !area || (area->min.allFinite() && area->max.allFinite() &&
                                 (area->min.array() < area->max.array()).all());
  if (!is_area) {
    return fail(ErrorCode::kInvalidArgument, "must be finite and have an inside", "area");
  }
  HYPERMAP_ASSIGN_OR_RETURN(std::vector<NamedTile> tiles, named_tiles(folder));
  if (!tiles.empty()) HYPERMAP_TRY(check_resolutions(tiles));
  const GridGeometry first = tiles.empty() ? GridGeometry{} : tiles.front().name.geometry;
  if (area) {
    std::erase_if(tiles,
                  [&](const NamedTile& tile) { return !meets(bounds(tile.name.geometry), *area); });
  }
  if (tiles.empty()) {
    return Unexpected(Error{.code = ErrorCode::kNotFound,
                            .what = area ? "no tile lies in the area" : "has no tiles",
                            .file = folder.string()});
  }
  const GridGeometry geometry = cells_around(first, area ? *area : around(tiles));
  HYPERMAP_ASSIGN_OR_RETURN(GridStack stack, GridStack::create(geometry, options));
  for (const NamedTile& tile : tiles) HYPERMAP_TRY(add_tile(tile, stack));
  return stack;
}

Result<GridStack> read_tile_map(const fs::path& folder,
                                const std::optional<Rect>& area,
                                const GridStackOptions& options) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto ours, files_in(folder, ".tile"));
  HYPERMAP_ASSIGN_OR_RETURN(const auto others, files_in(folder, ".bin"));
  if (!ours.empty() && !others.empty()) {
    return Unexpected(Error{.code = ErrorCode::kInvalidArgument,
                            .what = "has tiles of two kinds, .tile and .bin",
                            .file = folder.string()});
  }
  if (ours.empty()) return stack_of_sogm_tiles(folder, area, options);
  HYPERMAP_ASSIGN_OR_RETURN(const TileFolder opened, TileFolder::open(folder));
  auto stack = stack_of_tiles(opened, area, options);
  if (!stack) return Unexpected(with_source(std::move(stack).error(), {folder.string()}));
  return stack;
}

}  // namespace hypermap
