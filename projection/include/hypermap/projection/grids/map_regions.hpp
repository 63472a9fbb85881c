// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which parts of a map lie far apart from each other, as one wrong pose leaves them.
#pragma once

#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/geometry/leaf.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// Parts of a map with a wider gap between them are different regions: one grid around both would
/// be mostly of nothing. Unit: metre.
inline constexpr double kMaxRegionGapM = 50.0;

/// Leaves that no wider gap than kMaxRegionGapM divides.
struct MapRegion {
  Box bounds_in_map;  ///< Around the leaves.
  LeafCount leaves;

  [[nodiscard]] std::size_t num_leaves() const noexcept { return leaves.occupied + leaves.free; }
  friend bool operator==(const MapRegion&, const MapRegion&) = default;
};

/// The known leaves of a map by region. A value.
class MapRegions {
 public:
  /// Cubes of 25 m hold leaves that belong together; two cubes are of one region when the boxes
  /// around their leaves are less than kMaxRegionGapM apart, directly or by way of others.
  ///
  /// Boundary: a gap of exactly kMaxRegionGapM divides. A map without leaves has no region.
  /// Cost: one walk over the leaves; 125 look-ups for each cube.
  [[nodiscard]] static MapRegions find(const LeafSource& leaves);

  /// The one of most leaves first; equal ones by their place.
  [[nodiscard]] std::span<const MapRegion> regions() const noexcept { return regions_; }
  /// The index of the region that a leaf with this centre is of; none where there was no leaf.
  [[nodiscard]] std::optional<std::size_t> region_at(const Eigen::Vector3d& centre_in_map) const;

 private:
  std::vector<MapRegion> regions_;
  std::map<std::array<std::int32_t, 3>, std::size_t> region_of_;  ///< Of a cube.
};

/// How far two boxes are apart; 0 when they touch. Unit: metre.
[[nodiscard]] double gap_between_m(const Box& a, const Box& b);

/// The leaves of the largest region, in their order; all, untouched, where there is only one.
/// Requires: `regions` are those of `leaves`.
[[nodiscard]] LeafSource leaves_of_largest(LeafSource leaves, MapRegions regions);

}  // namespace hypermap
