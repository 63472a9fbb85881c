// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Part of a map: what an archive holds of a region.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <Eigen/Core>

#include <limits>
#include <string>
#include <vector>

namespace hypermap {

/// An area of the plane of frame `map`, between two heights.
struct CropRegion {
  Polygon area = {};
  double min_z_m = -std::numeric_limits<double>::infinity();
  double max_z_m = std::numeric_limits<double>::infinity();

  /// Half open: a point that two regions share as their border is in one of them, so that regions
  /// without a gap divide the plane. Cost: linear in the corners.
  [[nodiscard]] bool contains(const Eigen::Vector2d& point) const;
  [[nodiscard]] bool contains(const Eigen::Vector3d& point) const;
  friend bool operator==(const CropRegion&, const CropRegion&) = default;
};

/// Errors: kInvalidArgument naming the field: an area that make_polygon refuses; heights that are
/// NaN or not in ascending order.
[[nodiscard]] Result<void> validate(const CropRegion& region);

struct CroppedMap {
  MapArchive map;
  /// Layers and extensions that cannot be divided, by name: they are not in the part.
  std::vector<std::string> left_out = {};
  /// Vertices of the whole topological map, in its order; support vertices that the part alone has
  /// come behind them.
  std::size_t num_own_vertices = 0;
};

/// What the map holds of a region. Ids, classes, belief, logs, sessions and all names stay.
///
/// In the part are voxels and cells of grids whose centres lie in the region, objects and shapes
/// whose centroids do (a shape of a layer goes with the map's object of its id), as a whole, and
/// the places of the topological map with the ways between them, and support vertices where an
/// object's own place is outside. Voxels of objects that are not in
/// it are of none. Heights are asked of voxels, objects and places. So parts of regions that
/// divide the plane have each voxel, cell and object once. Layers in other frames are cropped where
/// these lie in `map`.
/// Left out: stacks and supercells (made anew from the part), octrees of other programs, layers
/// that nothing here knows or whose frame nothing connects to `map`. Members that nobody knows
/// stay as they are; a run cannot be resumed from a part.
/// Errors: those of validate; kOutOfMemory. Cost: linear in the map.
[[nodiscard]] Result<CroppedMap> cropped(const MapArchive& archive, const CropRegion& region);

/// The square regions of edge `edge_m`, with corners at its multiples, in which the map has
/// something: by rows from the lowest, columns ascending. Errors: kInvalidArgument for an edge
/// outside 0.1 .. 1e5 m; kLimit for more than kMaxMapTiles.
inline constexpr std::size_t kMaxMapTiles = 10'000;
[[nodiscard]] Result<std::vector<CropRegion>> map_tiles(const MapArchive& archive, double edge_m);

}  // namespace hypermap
