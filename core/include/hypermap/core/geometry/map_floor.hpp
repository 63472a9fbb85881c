// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// At which height of a map people stand.
#pragma once

#include <cstdint>
#include <string_view>

namespace hypermap {

/// Who says where a floor is.
enum class FloorSource : std::uint8_t {
  kAssumed,  ///< Nobody: it is at z = 0 of the world that was set upright, or where that was moved.
  kFound,    ///< The map's own voxels.
  kStated,   ///< An option.
};

/// One word, as files and JSON have it: "assumed", "found", "stated".
[[nodiscard]] constexpr std::string_view name_of(FloorSource source) noexcept {
  if (source == FloorSource::kAssumed) return "assumed";
  return source == FloorSource::kFound ? "found" : "stated";
}

/// No floor is farther from z = 0. Unit: metre.
inline constexpr double kMaxFloorHeightM = 1e5;

/// Heights that mean something to a robot or a person (obstacles, "on the floor") are over it.
/// Frame: Map. Unit: metre.
struct MapFloor {
  double height_m = 0.0;
  FloorSource source = FloorSource::kAssumed;
  friend bool operator==(const MapFloor&, const MapFloor&) = default;
};

}  // namespace hypermap
