// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a layer looks like, as primitives that any viewer can draw.
///
/// Source: [hypermap] 3.3.6 (displays of the layers).
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace hypermap {

/// A filled shape, outlined, in the colour of a class, labelled with class and number.
struct DrawnArea {
  std::vector<Polygon> parts;
  std::string class_name;
  std::uint64_t id = 0;  ///< The number by which the layer is asked for it.
};

/// A grid shaded by occupancy.
struct DrawnOccupancy {
  OccupancyGrid grid;
};

/// A grid with a colour per cell. Shape: rows x cols, row-major, row 0 = min y.
/// Requires: as many colours as cells.
struct DrawnCells {
  GridGeometry geometry;
  std::vector<Rgb8> colors;
};

/// A line from point to point.
struct DrawnLine {
  std::vector<Eigen::Vector2d> points;
  Rgb8 color;
};

/// A text that stands over a point.
struct DrawnText {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  std::string text;
  Rgb8 color;
};

/// A box in the colour of a class, labelled with class and number.
struct DrawnBox {
  Box box;
  std::string class_name;
  std::uint64_t id = 0;  ///< The number by which the layer is asked for it.
};

/// Voxels in the colours of their classes. Requires: what `leaves` looks at outlives it.
struct DrawnVoxels {
  LeafSource leaves;
};

/// In the frame of the layer that gave it. Unit: metre.
using LayerPrimitive = std::
    variant<DrawnArea, DrawnOccupancy, DrawnCells, DrawnLine, DrawnText, DrawnBox, DrawnVoxels>;

}  // namespace hypermap
