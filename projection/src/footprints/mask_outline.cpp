// SPDX-License-Identifier: BSD-3-Clause
#include "mask_outline.hpp"

#include <Eigen/Geometry>

#include <optional>
#include <utility>

namespace hypermap {
namespace {

using Lattice = Eigen::Vector2i;  ///< A corner of pixels; (0, 0) is that of `MaskFrame::corner`.

std::optional<Lattice> first_pixel(const PlanMask& mask) {
  for (int row = 0; row < mask.rows(); ++row) {
    for (int col = 0; col < mask.cols(); ++col) {
      if (mask.at(col, row)) return Lattice(col, row);
    }
  }
  return std::nullopt;
}

Lattice turned_left(const Lattice& direction) {
  return {-direction.y(), direction.x()};
}

/// The pixel beside the edge that starts at `corner` towards `direction`: on its left, or on its
/// right.
bool is_set_beside(const PlanMask& mask,
                   const Lattice& corner,
                   const Lattice& direction,
                   bool left) {
  const Lattice side = left ? turned_left(direction) : Lattice(-turned_left(direction));
  // Twice the pixel's centre: from the corner half an edge on and half an edge to the side.
  const Lattice twice = 2 * corner + direction + side;
  return mask.at((twice.x() - 1) / 2, (twice.y() - 1) / 2);
}

/// The edge after one that ends at `corner`: inside stays on the left.
Lattice next_direction(const PlanMask& mask, const Lattice& corner, const Lattice& direction) {
  if (is_set_beside(mask, corner, direction, false)) return -turned_left(direction);
  if (is_set_beside(mask, corner, direction, true)) return direction;
  return turned_left(direction);
}

/// Middles of the edges of the outer ring, counter-clockwise from the first pixel's lower edge.
Ring edge_middles(const PlanMask& mask, const Lattice& first, const MaskFrame& frame) {
  Ring ring;
  Lattice corner = first;
  Lattice direction(1, 0);
  do {
    const Eigen::Vector2d middle = corner.cast<double>() + 0.5 * direction.cast<double>();
    ring.emplace_back(frame.corner + frame.edge_m * middle);
    corner += direction;
    direction = next_direction(mask, corner, direction);
  } while (corner != first || direction != Lattice(1, 0));
  return ring;
}

}  // namespace

Result<Polygon> outline_of(const PlanMask& mask, const MaskFrame& frame) {
  const auto first = first_pixel(mask);
  if (!first) return fail(ErrorCode::kNotFound, "no pixel is set");
  HYPERMAP_ASSIGN_OR_RETURN(Polygon polygon, make_polygon(edge_middles(mask, *first, frame)));
  return simplified(polygon, 0.25 * frame.edge_m);
}

}  // namespace hypermap
