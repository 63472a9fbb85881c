// SPDX-License-Identifier: BSD-3-Clause
#include "seen_surfaces.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace hypermap {
namespace {

/// The slab of points near a triangle's plane: cheaper to ask than the triangle, and most cells of
/// the box around a slanting one lie outside.
class Slab {
 public:
  /// All points no farther than `reach_m` from the triangle lie in it.
  /// Boundary: around a triangle without an area it is all of space.
  Slab(const Triangle& triangle, double reach_m)
      : corner_(triangle[0]),
        normal_((triangle[1] - corner_).cross(triangle[2] - corner_)),
        // A little wider than the reach: rounding takes no point away that the triangle would keep.
        max_offset_(1.000001 * reach_m * normal_.norm()) {}

  [[nodiscard]] bool contains(const Eigen::Vector3d& point) const {
    const double offset = normal_.x() * (point.x() - corner_.x()) +
                          normal_.y() * (point.y() - corner_.y()) +
                          normal_.z() * (point.z() - corner_.z());
    return std::abs(offset) <= max_offset_;
  }

 private:
  Eigen::Vector3d corner_;
  Eigen::Vector3d normal_;  ///< Of any length.
  double max_offset_;       ///< Along `normal_`, times its length.
};

/// The cells whose centres are no farther from the triangle than half their diagonal.
void append_cells_of(const Triangle& triangle, double edge_m, std::vector<SurfaceCell>& cells) {
  const double reach_m = 0.5 * std::sqrt(3.0) * edge_m;
  const Eigen::Vector3d low = triangle[0].cwiseMin(triangle[1]).cwiseMin(triangle[2]);
  const Eigen::Vector3d high = triangle[0].cwiseMax(triangle[1]).cwiseMax(triangle[2]);
  const SurfaceCell first = cell_of(low.array() - reach_m, edge_m);
  const SurfaceCell last = cell_of(high.array() + reach_m, edge_m);
  const Slab slab(triangle, reach_m);
  SurfaceCell cell;
  for (cell.x = first.x; cell.x <= last.x; ++cell.x) {
    for (cell.y = first.y; cell.y <= last.y; ++cell.y) {
      for (cell.z = first.z; cell.z <= last.z; ++cell.z) {
        const Eigen::Vector3d centre = centre_of(cell, edge_m);
        if (slab.contains(centre) && squared_distance(centre, triangle) <= reach_m * reach_m)
          cells.push_back(cell);
      }
    }
  }
}

std::vector<SurfaceCell> cells_of(const TrueSurface& surface, double edge_m) {
  std::vector<SurfaceCell> cells;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    append_cells_of(triangle_at(surface, i), edge_m, cells);
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

}  // namespace

std::vector<bool> nameable_objects(const Simulator& simulator) {
  std::vector<bool> is_nameable;
  for (const PlacedObject& object : simulator.objects())
    is_nameable.push_back(simulator.detector().knows_class(object.class_name));
  return is_nameable;
}

SeenSurfaces::SeenSurfaces(std::span<const PlacedObject> objects,
                           const std::vector<bool>& is_nameable) {
  for (std::size_t i = 0; i < objects.size(); ++i) {
    surfaces_.objects.push_back({.id = objects[i].id,
                                 .class_name = objects[i].class_name,
                                 .is_nameable = is_nameable[i],
                                 .vertices = objects[i].mesh.vertices,
                                 .triangles = objects[i].mesh.triangles});
    cells_.push_back(cells_of(surfaces_.objects.back(), surfaces_.seen_cell_m));
    is_seen_.emplace_back(cells_.back().size(), false);
  }
}

std::vector<SeenCell> SeenSurfaces::seen_in(const SimulatedFrame& frame) const {
  std::vector<std::pair<ObjectId, SurfaceCell>> measured;
  const DepthImage& depth_m = frame.frame.depth_m;
  for (int v = 0; v < depth_m.height_px(); ++v) {
    for (int u = 0; u < depth_m.width_px(); ++u) {
      const ObjectId id = frame.instances.at(u, v);
      const auto depth = static_cast<double>(depth_m.at(u, v));
      if (id == kNoObject || id.value > cells_.size() || !(depth > 0.0)) continue;
      const PointInMap point = frame.true_pose * frame.frame.camera.unproject(u, v, depth);
      const SurfaceCell cell = cell_of(point.xyz, surfaces_.seen_cell_m);
      if (measured.empty() || measured.back() != std::pair(id, cell))
        measured.emplace_back(id, cell);
    }
  }
  std::sort(measured.begin(), measured.end());
  measured.erase(std::unique(measured.begin(), measured.end()), measured.end());
  std::vector<SeenCell> seen;
  for (const auto& [id, cell] : measured) {
    const std::uint32_t object = id.value - 1;
    const std::vector<SurfaceCell>& cells = cells_[object];
    const auto found = std::lower_bound(cells.begin(), cells.end(), cell);
    if (found == cells.end() || *found != cell) continue;
    seen.push_back({object, static_cast<std::uint32_t>(found - cells.begin())});
  }
  return seen;
}

void SeenSurfaces::add(std::span<const SeenCell> seen) {
  for (const SeenCell& cell : seen) is_seen_[cell.object][cell.cell] = true;
}

TrueSurfaces SeenSurfaces::surfaces() const {
  TrueSurfaces result = surfaces_;
  for (std::size_t object = 0; object < cells_.size(); ++object) {
    for (std::size_t i = 0; i < cells_[object].size(); ++i) {
      if (is_seen_[object][i]) result.objects[object].seen_cells.push_back(cells_[object][i]);
    }
  }
  return result;
}

double seen_footprint_share(const TrueSurface& surface,
                            double seen_cell_m,
                            const Polygon& footprint) {
  std::set<std::pair<std::int32_t, std::int32_t>> seen;
  for (const SurfaceCell& cell : surface.seen_cells) seen.emplace(cell.x, cell.y);
  const Rect rect = bounds(footprint);
  const SurfaceCell first = cell_of({rect.min.x(), rect.min.y(), 0.0}, seen_cell_m);
  const SurfaceCell last = cell_of({rect.max.x(), rect.max.y(), 0.0}, seen_cell_m);
  std::size_t num_columns = 0;
  std::size_t num_seen = 0;
  SurfaceCell cell;
  for (cell.x = first.x; cell.x <= last.x; ++cell.x) {
    for (cell.y = first.y; cell.y <= last.y; ++cell.y) {
      if (!contains(footprint, centre_of(cell, seen_cell_m).head<2>())) continue;
      ++num_columns;
      num_seen += seen.contains({cell.x, cell.y}) ? 1U : 0U;
    }
  }
  if (num_columns == 0) return seen.empty() ? 0.0 : 1.0;
  return static_cast<double>(num_seen) / static_cast<double>(num_columns);
}

}  // namespace hypermap
