// SPDX-License-Identifier: BSD-3-Clause
#include "scene_content.hpp"

#include "hypermap/viewer_offscreen/rendering/cutaway.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace hypermap {
namespace {

constexpr double kTrimShare = 0.001;
constexpr std::size_t kTrimFrom = 2000;  // fewer voxels are framed to the last

/// Lowest and highest of the voxels along an axis, their halves included.
std::array<double, 2> span_along(std::span<const OccupiedVoxel> voxels,
                                 const Eigen::Vector3d& axis) {
  std::vector<float> places;
  places.reserve(voxels.size());
  for (const OccupiedVoxel& voxel : voxels) {
    places.push_back(static_cast<float>(axis.dot(voxel.centre_in_map.cast<double>())));
  }
  const auto trim = voxels.size() < kTrimFrom
                        ? std::size_t{0}
                        : static_cast<std::size_t>(kTrimShare * double(voxels.size()));
  const auto rank = [&](std::size_t index) {
    const auto place = places.begin() + static_cast<std::ptrdiff_t>(index);
    std::nth_element(places.begin(), place, places.end());
    return static_cast<double>(*place);
  };
  const double half = 0.5 * static_cast<double>(finest_edge_m(voxels)) * axis.cwiseAbs().sum();
  return {rank(trim) - half, rank(places.size() - 1 - trim) + half};
}

/// Corners of the box around the voxels that stands square to the view.
void add_voxel_corners(std::span<const OccupiedVoxel> voxels,
                       const SnapshotView& view,
                       std::vector<Eigen::Vector3d>& points) {
  if (voxels.empty()) return;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if (std::holds_alternative<IsoView>(view)) {
    axes.col(2) = *direction_to_eye(view);
    axes.col(0) = Eigen::Vector3d::UnitZ().cross(axes.col(2)).normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
  }
  std::array<std::array<double, 2>, 3> spans{};
  for (int i = 0; i < 3; ++i) {
    spans[static_cast<std::size_t>(i)] = span_along(voxels, axes.col(i));
  }
  for (std::size_t k = 0; k < 8; ++k) {
    points.emplace_back(
        axes * Eigen::Vector3d(spans[0][k & 1U], spans[1][(k >> 1U) & 1U], spans[2][k >> 2U]));
  }
}

/// First and last column and row of what is known of a grid.
struct KnownCells {
  Cell first{std::numeric_limits<int>::max(), std::numeric_limits<int>::max()};
  Cell last{-1, -1};

  [[nodiscard]] bool empty() const { return last.col < 0; }
};

KnownCells known_cells(const OccupancyGrid& grid) {
  KnownCells known;
  for (int row = 0; row < grid.geometry().rows; ++row) {
    for (int col = 0; col < grid.geometry().cols; ++col) {
      if (grid.at({col, row}) == kUnknownCell) continue;
      known.first = {std::min(known.first.col, col), std::min(known.first.row, row)};
      known.last = {std::max(known.last.col, col), std::max(known.last.row, row)};
    }
  }
  return known;
}

void add_grid_corners(const GridGeometry& geometry,
                      double height_m,
                      std::vector<Eigen::Vector3d>& points) {
  for (const int col : {0, geometry.cols}) {
    for (const int row : {0, geometry.rows}) {
      const Eigen::Vector2d plan = from_cells(geometry, {double(col), double(row)});
      points.emplace_back(plan.x(), plan.y(), height_m);
    }
  }
}

/// Of a large grid every so many rows and columns.
void add_cell_centres(const GridGeometry& geometry,
                      double height_m,
                      std::vector<Eigen::Vector3d>& points) {
  constexpr int kMostSteps = 256;
  const int step = 1 + std::max(geometry.cols, geometry.rows) / kMostSteps;
  for (int row = 0; row < geometry.rows; row += step) {
    for (int col = 0; col < geometry.cols; col += step) {
      const Eigen::Vector2d plan = from_cells(geometry, {col + 0.5, row + 0.5});
      points.emplace_back(plan.x(), plan.y(), height_m);
    }
  }
}

void add_overlay_points(const SnapshotOverlay& overlay,
                        double height_m,
                        std::vector<Eigen::Vector3d>& points) {
  for (const DrawnCells& cells : overlay.cells) add_grid_corners(cells.geometry, height_m, points);
  for (const DrawnLine& line : overlay.lines) {
    for (const Eigen::Vector2d& point : line.points)
      points.emplace_back(point.x(), point.y(), height_m);
  }
  for (const DrawnText& text : overlay.texts)
    points.emplace_back(text.position.x(), text.position.y(), height_m);
}

}  // namespace

ClassRegistry drawn_classes(const SnapshotScene& scene) {
  ClassRegistry registry = scene.classes;
  for (const SemanticObject& object : scene.semantic) {
    // A name that no registry takes (too long, too many) stays without a class: drawn grey.
    [[maybe_unused]] const auto id = registry.add(object.name);
  }
  return registry;
}

SnapshotLayers drawn_layers(const SnapshotScene& scene, const SnapshotOptions& options) {
  if (options.layers) return *options.layers;
  const bool has_plan =
      scene.occupancy.has_value() || !scene.semantic.empty() || !scene.overlay.empty();
  const bool has_space = static_cast<bool>(scene.leaves) || !scene.objects.empty();
  if (has_plan && (std::holds_alternative<TopView>(options.view) || !has_space)) {
    // Cells are opaque: over an occupancy grid they would be all that is seen.
    const bool hides_occupancy = scene.occupancy.has_value() && !scene.overlay.cells.empty();
    return {.occupancy = true, .semantic = true, .overlay = !hides_occupancy};
  }
  return {.voxels = true, .objects = true, .trajectory = true};
}

VisibleVoxels visible_voxels(const SnapshotScene& scene, const SnapshotOptions& options) {
  VisibleVoxels drawn;
  std::vector<OccupiedVoxel> all = occupied_voxels(scene.leaves);
  drawn.num_occupied = all.size();
  drawn.floor_m = scene.floor_m.value_or(floor_height_m(all));
  const double ceiling_m = ceiling_cut_m(all, drawn.floor_m);
  drawn.light = SkyLight(cut_away(all, {.floor_m = drawn.floor_m, .cut_above_m = ceiling_m}));
  const auto to_eye = direction_to_eye(options.view);
  if (!to_eye) {
    drawn.voxels = std::move(all);
    return drawn;
  }
  drawn.cut_m = options.cut_above_m.value_or(ceiling_m);
  CutawayOptions cut{.floor_m = drawn.floor_m, .cut_above_m = drawn.cut_m};
  if (options.cut_near_walls && std::holds_alternative<IsoView>(options.view)) {
    cut.towards_eye = to_eye->head<2>().normalized();
  }
  drawn.voxels = cut_away(all, cut);
  const double highest_m = drawn.floor_m + drawn.cut_m;
  drawn.num_too_high = static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [highest_m](const OccupiedVoxel& voxel) {
        return static_cast<double>(voxel.centre_in_map.z()) > highest_m;
      }));
  drawn.num_near_walls = all.size() - drawn.num_too_high - drawn.voxels.size();
  return drawn;
}

OccupancyGrid known_part(const OccupancyGrid& grid) {
  const KnownCells known = known_cells(grid);
  if (known.empty()) return grid;
  GridGeometry part = grid.geometry();
  part.origin = from_cells(grid.geometry(), {double(known.first.col), double(known.first.row)});
  part.cols = known.last.col - known.first.col + 1;
  part.rows = known.last.row - known.first.row + 1;
  std::vector<std::int8_t> cells;
  cells.reserve(part.num_cells());
  for (int row = known.first.row; row <= known.last.row; ++row) {
    for (int col = known.first.col; col <= known.last.col; ++col) {
      cells.push_back(grid.at({col, row}));
    }
  }
  return OccupancyGrid::create(part, std::move(cells)).value_or(grid);
}

std::vector<Eigen::Vector3d> points_drawn(const SnapshotScene& scene,
                                          const SnapshotLayers& layers,
                                          const VisibleVoxels& voxels) {
  SnapshotLayers flat = layers;
  flat.voxels = false;
  flat.occupancy = false;
  std::vector<Eigen::Vector3d> points = points_to_frame(scene, flat, voxels, TopView{});
  if (layers.voxels) {
    for (const OccupiedVoxel& voxel : voxels.voxels) {
      const auto half = Eigen::Vector3d::Constant(0.5 * static_cast<double>(voxel.edge_m));
      points.emplace_back(voxel.centre_in_map.cast<double>() - half);
      points.emplace_back(voxel.centre_in_map.cast<double>() + half);
    }
  }
  if (layers.occupancy && scene.occupancy)
    add_cell_centres(known_part(*scene.occupancy).geometry(), voxels.floor_m, points);
  return points;
}

std::vector<Eigen::Vector3d> points_to_frame(const SnapshotScene& scene,
                                             const SnapshotLayers& layers,
                                             const VisibleVoxels& voxels,
                                             const SnapshotView& view) {
  std::vector<Eigen::Vector3d> points;
  if (layers.voxels) add_voxel_corners(voxels.voxels, view, points);
  if (layers.objects) {
    for (const SnapshotObject& object : scene.objects) {
      for (const Eigen::Vector3d& corner : object.box.corners()) points.push_back(corner);
    }
  }
  if (layers.occupancy && scene.occupancy && scene.occupancy->geometry().num_cells() > 0) {
    add_grid_corners(known_part(*scene.occupancy).geometry(), voxels.floor_m, points);
  }
  if (layers.semantic) {
    for (const SemanticObject& object : scene.semantic) {
      const Rect around = bounds_of(object);
      points.emplace_back(around.min.x(), around.min.y(), voxels.floor_m);
      points.emplace_back(around.max.x(), around.max.y(), voxels.floor_m);
    }
  }
  if (layers.overlay) add_overlay_points(scene.overlay, voxels.floor_m, points);
  if (points.empty() && layers.trajectory) points = scene.trajectory_in_map;
  std::erase_if(points, [](const Eigen::Vector3d& point) { return !point.allFinite(); });
  return points;
}

}  // namespace hypermap
