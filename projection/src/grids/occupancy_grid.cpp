// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/occupancy_grid.hpp"

#include <algorithm>
#include <cassert>
#include <new>
#include <string>

namespace hypermap {
namespace {

bool is_occupancy(std::int8_t value) {
  return value >= kUnknownCell && value <= kOccupiedCell;
}

Unexpected not_an_occupancy(std::int8_t value) {
  return fail(ErrorCode::kInvalidArgument,
              "must be from -1 to 100, is " + std::to_string(value),
              "occupancy");
}

}  // namespace

Result<OccupancyGrid> OccupancyGrid::create(const GridGeometry& geometry, std::int8_t fill) {
  HYPERMAP_TRY(validate(geometry));
  if (!is_occupancy(fill)) return not_an_occupancy(fill);
  try {
    return create(geometry, std::vector<std::int8_t>(geometry.num_cells(), fill));
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for the grid", "size");
  }
}

Result<OccupancyGrid> OccupancyGrid::create(const GridGeometry& geometry,
                                            std::vector<std::int8_t> cells) {
  HYPERMAP_TRY(validate(geometry));
  if (cells.size() != geometry.num_cells()) {
    return fail(ErrorCode::kInvalidArgument,
                std::to_string(cells.size()) + " cells given, the geometry has " +
                    std::to_string(geometry.num_cells()),
                "cells");
  }
  const auto wrong = std::find_if_not(cells.begin(), cells.end(), is_occupancy);
  if (wrong != cells.end()) return not_an_occupancy(*wrong);
  OccupancyGrid grid;
  grid.geometry_ = geometry;
  grid.cells_ = std::move(cells);
  return grid;
}

void OccupancyGrid::set(Cell cell, std::int8_t value) {
  assert(geometry_.contains(cell) && is_occupancy(value));
  cells_[geometry_.index(cell)] = value;
}

std::optional<std::int8_t> OccupancyGrid::at_point(const Eigen::Vector2d& point) const {
  const auto cell = cell_at(geometry_, point);
  return cell ? std::optional<std::int8_t>(at(*cell)) : std::nullopt;
}

OccupancyCounts OccupancyGrid::counts() const {
  OccupancyCounts counts;
  for (const std::int8_t cell : cells_) {
    if (cell == kOccupiedCell) {
      ++counts.occupied;
    } else if (cell == kFreeCell) {
      ++counts.free;
    } else if (cell == kUnknownCell) {
      ++counts.unknown;
    } else {
      ++counts.between;
    }
  }
  return counts;
}

std::string_view occupancy_string(std::int8_t occupancy) {
  if (occupancy == kFreeCell) return "Free";
  return occupancy == kOccupiedCell ? "Occupied" : "Unknown";
}

}  // namespace hypermap
