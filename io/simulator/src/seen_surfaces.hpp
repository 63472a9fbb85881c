// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which parts of the true surfaces the frames of a simulation have measured.
#pragma once

#include "hypermap/core/evaluation/true_surfaces.hpp"
#include "hypermap/io/simulator/simulator.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// Whether the detector can name each of the simulation's objects.
[[nodiscard]] std::vector<bool> nameable_objects(const Simulator& simulator);

/// A cell of the surface of an object that a frame has measured.
struct SeenCell {
  std::uint32_t object = 0;  ///< Position in the list of objects.
  std::uint32_t cell = 0;    ///< Position in the cells of its surface.
  friend auto operator<=>(const SeenCell&, const SeenCell&) = default;
};

/// The surfaces of placed objects as cells of a lattice, and which of them were seen.
///
/// A cell belongs to a surface when its centre is no farther from it than half its own diagonal:
/// so every cell that a surface meets does.
class SeenSurfaces {
 public:
  /// Whether the detector can name them stands in `is_nameable`, for each object.
  SeenSurfaces(std::span<const PlacedObject> objects, const std::vector<bool>& is_nameable);

  /// Cells in which a measured pixel of their object lies, ascending, each once. Pixels of other
  /// ids than those of the objects are passed over. Threads: may be called concurrently.
  [[nodiscard]] std::vector<SeenCell> seen_in(const SimulatedFrame& frame) const;
  void add(std::span<const SeenCell> seen);

  /// What was seen by now.
  [[nodiscard]] TrueSurfaces surfaces() const;

 private:
  TrueSurfaces surfaces_;                        ///< Without seen cells.
  std::vector<std::vector<SurfaceCell>> cells_;  ///< Of each object, ascending.
  std::vector<std::vector<bool>> is_seen_;       ///< Of the same positions.
};

/// Share of an object's footprint over which cells of its surface were seen: of the columns of
/// cells whose middle lies in the footprint, those with a seen cell.
/// Boundary: a footprint without any such column is seen when any cell was (1), else not (0).
[[nodiscard]] double seen_footprint_share(const TrueSurface& surface,
                                          double seen_cell_m,
                                          const Polygon& footprint);

}  // namespace hypermap
