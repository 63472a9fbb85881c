// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// An object as relations see it.
#pragma once

#include "hypermap/core/objects/object.hpp"
#include "hypermap/core/places/relation_options.hpp"
#include "places/column_surface.hpp"

#include <optional>

namespace hypermap {

/// Where an object is. Frame: Map. Unit: metre.
struct PlacedShape {
  ObjectId id;
  std::optional<ClassId> class_id;
  Box box;
  Polygon footprint;            ///< Of its points, else of its shapes, else of its box.
  ColumnSurface surface;        ///< Empty without points.
  double longest_side_m = 0.0;  ///< Horizontal, of the box.
  double volume_m3 = 0.0;       ///< Of the prism over the footprint, as high as the box.

  [[nodiscard]] double foot_m() const { return box.min_in_map.z(); }
  [[nodiscard]] double top_m() const { return box.max_in_map.z(); }
  [[nodiscard]] double height_m() const { return top_m() - foot_m(); }
};

/// Requires: validate(options).
[[nodiscard]] inline double voxel_of(const RelationOptions& options) {
  return options.voxel_m.value_or(kUsualVoxelM);
}

/// None when the object covers no area.
[[nodiscard]] std::optional<PlacedShape> placed_shape_of(const Object& object,
                                                         const RelationOptions& options);

/// Length that two intervals of heights have in common; 0 when none.
[[nodiscard]] double common_height_m(const PlacedShape& a, const PlacedShape& b);
/// No pair of footprints has more in common than the rectangles around them: an upper bound of
/// `covered_share(a.footprint, b.footprint)`, cheap.
[[nodiscard]] double most_covered_share(const PlacedShape& a, const PlacedShape& b);

}  // namespace hypermap
