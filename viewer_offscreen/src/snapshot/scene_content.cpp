// SPDX-License-Identifier: BSD-3-Clause
#include "scene_content.hpp"

#include "hypermap/core/base/class_palette.hpp"
#include "hypermap/viewer_offscreen/annotation/scale_bar.hpp"
#include "hypermap/viewer_offscreen/rendering/cutaway.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace hypermap {
namespace {

constexpr Rgb8 kNoClassColor{120, 126, 134};
constexpr Rgb8 kTrajectoryColor{214, 40, 57};
constexpr Rgb8 kGridColor{120, 132, 148};
constexpr float kDarkest = 0.60F;
constexpr double kTrimShare = 0.001;
constexpr std::size_t kTrimFrom = 2000;  // fewer voxels are framed to the last
constexpr double kGridStepPx = 140.0;    // at most, between two lines of the grid
constexpr double kMaxGridLines = 400.0;

std::array<float, 3> floats(const Eigen::Vector3d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

/// Unlabelled voxels: warm floor, then from sand to slate with height over the floor.
Rgb8 height_color(double height_m) {
  constexpr std::array<Rgb8, 4> kStops{
      {{226, 219, 208}, {224, 222, 220}, {200, 207, 217}, {166, 178, 196}}};
  constexpr std::array<double, 4> kHeightsM{0.05, 0.15, 1.0, 2.4};
  if (height_m <= kHeightsM.front()) return kStops.front();
  for (std::size_t i = 1; i < kStops.size(); ++i) {
    if (height_m > kHeightsM[i]) continue;
    const double share = (height_m - kHeightsM[i - 1]) / (kHeightsM[i] - kHeightsM[i - 1]);
    const auto mix = [share](std::uint8_t a, std::uint8_t b) {
      return static_cast<std::uint8_t>(std::lround(a + share * (b - a)));
    };
    return {mix(kStops[i - 1].r, kStops[i].r),
            mix(kStops[i - 1].g, kStops[i].g),
            mix(kStops[i - 1].b, kStops[i].b)};
  }
  return kStops.back();
}

/// A colour under part of the light; what is dark stays recognisable.
Rgb8 shaded(Rgb8 color, float light) {
  const float share = kDarkest + (1.0F - kDarkest) * light;
  const auto scale = [share](std::uint8_t channel) {
    return static_cast<std::uint8_t>(std::lround(share * static_cast<float>(channel)));
  };
  return {scale(color.r), scale(color.g), scale(color.b)};
}

bool faces_eye(const OccupiedVoxel& voxel, FaceDirection direction, const Eigen::Vector3d& eye) {
  const Eigen::Vector3d normal = normal_of(direction).cast<double>();
  const double beyond = normal.dot(eye - voxel.centre_in_map.cast<double>());
  return beyond > 0.5 * static_cast<double>(voxel.edge_m);
}

std::vector<FaceDirection> directions_seen(const SnapshotCamera& camera) {
  std::vector<FaceDirection> seen;
  for (std::size_t i = 0; i < kNumFaceDirections; ++i) {
    const auto direction = static_cast<FaceDirection>(i);
    const double towards = normal_of(direction).cast<double>().dot(camera.backwards_in_map());
    if (camera.eye_in_map() || towards > 1e-9) seen.push_back(direction);
  }
  return seen;
}

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

Rgb8 color_of(const std::optional<ClassId>& class_id) {
  return class_id ? class_color(*class_id) : kNoClassColor;
}

ClassRegistry classes_shown(const SnapshotScene& scene) {
  ClassRegistry registry = scene.classes;
  for (const SemanticObject& object : scene.semantic) {
    // A name that no registry takes (too long, too many) stays without a class: drawn grey.
    [[maybe_unused]] const auto id = registry.add(object.name);
  }
  return registry;
}

SnapshotLayers layers_shown(const SnapshotScene& scene, const SnapshotOptions& options) {
  if (options.layers) return *options.layers;
  const bool has_plan =
      scene.occupancy.has_value() || !scene.semantic.empty() || !scene.overlay.empty();
  const bool has_space = static_cast<bool>(scene.leaves) || !scene.objects.empty();
  if (has_plan && (std::holds_alternative<TopView>(options.view) || !has_space)) {
    return {.occupancy = true, .semantic = true, .overlay = true};
  }
  return {.voxels = true, .objects = true, .trajectory = true};
}

ShownVoxels voxels_shown(const SnapshotScene& scene, const SnapshotOptions& options) {
  ShownVoxels shown;
  std::vector<OccupiedVoxel> all = occupied_voxels(scene.leaves);
  shown.num_occupied = all.size();
  shown.floor_m = floor_height_m(all);
  const double ceiling_m = ceiling_cut_m(all, shown.floor_m);
  shown.light = SkyLight(cut_away(all, {.floor_m = shown.floor_m, .cut_above_m = ceiling_m}));
  const auto to_eye = direction_to_eye(options.view);
  if (!to_eye) {
    shown.voxels = std::move(all);
    return shown;
  }
  shown.cut_m = options.cut_above_m.value_or(ceiling_m);
  CutawayOptions cut{.floor_m = shown.floor_m, .cut_above_m = shown.cut_m};
  if (options.cut_near_walls && std::holds_alternative<IsoView>(options.view)) {
    cut.towards_eye = to_eye->head<2>().normalized();
  }
  shown.voxels = cut_away(all, cut);
  return shown;
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

std::vector<Eigen::Vector3d> points_to_frame(const SnapshotScene& scene,
                                             const SnapshotLayers& layers,
                                             const ShownVoxels& voxels,
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

Result<std::vector<PaintedFace>> paint_voxels(const ShownVoxels& voxels,
                                              const SnapshotCamera& camera) {
  const auto directions = directions_seen(camera);
  HYPERMAP_ASSIGN_OR_RETURN(const auto faces, bare_faces(voxels.voxels, directions));
  std::vector<PaintedFace> painted;
  painted.reserve(faces.size());
  for (const VoxelFace& face : faces) {
    const OccupiedVoxel& voxel = voxels.voxels[face.voxel_index];
    if (camera.eye_in_map() && !faces_eye(voxel, face.direction, *camera.eye_in_map())) continue;
    const Rgb8 color =
        voxel.class_id
            ? color_of(voxel.class_id)
            : height_color(static_cast<double>(voxel.centre_in_map.z()) - voxels.floor_m);
    const Eigen::Vector3f before_face =
        voxel.centre_in_map + voxel.edge_m * normal_of(face.direction);
    painted.push_back({.centre_in_map = {voxel.centre_in_map.x(),
                                         voxel.centre_in_map.y(),
                                         voxel.centre_in_map.z()},
                       .edge_m = voxel.edge_m,
                       .paint = {shaded(color, voxels.light.at(before_face, face.direction))},
                       .openness = face.openness,
                       .direction = static_cast<std::uint8_t>(face.direction)});
  }
  return painted;
}

std::vector<PaintedLine> paint_boxes(std::span<const SnapshotObject> objects) {
  std::vector<PaintedLine> lines;
  lines.reserve(objects.size() * 12);
  for (const SnapshotObject& object : objects) {
    const auto corners = object.box.corners();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      for (const std::size_t axis : {1U, 2U, 4U}) {  // corners that differ in one bit share an edge
        if ((k & axis) != 0) continue;
        lines.push_back(
            {floats(corners[k]), floats(corners[k | axis]), {color_of(object.class_id)}});
      }
    }
  }
  return lines;
}

std::vector<PaintedLine> paint_trajectory(std::span<const Eigen::Vector3d> points) {
  std::vector<PaintedLine> lines;
  for (std::size_t i = 1; i < points.size(); ++i) {
    lines.push_back({floats(points[i - 1]), floats(points[i]), {kTrajectoryColor, 230}});
  }
  return lines;
}

std::vector<PaintedLine> paint_overlay_lines(std::span<const DrawnLine> lines, double height_m) {
  std::vector<PaintedLine> painted;
  for (const DrawnLine& line : lines) {
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      const Eigen::Vector2d& a = line.points[i - 1];
      const Eigen::Vector2d& b = line.points[i];
      painted.push_back(
          {floats({a.x(), a.y(), height_m}), floats({b.x(), b.y(), height_m}), {line.color}});
    }
  }
  return painted;
}

std::vector<PaintedLine> paint_outline(const Polygon& polygon, double height_m, Paint paint) {
  std::vector<PaintedLine> lines;
  const auto add_ring = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d& a = ring[i];
      const Eigen::Vector2d& b = ring[(i + 1) % ring.size()];
      lines.push_back({floats({a.x(), a.y(), height_m}), floats({b.x(), b.y(), height_m}), paint});
    }
  };
  add_ring(polygon.outer);
  for (const Ring& hole : polygon.holes) add_ring(hole);
  return lines;
}

std::vector<PaintedLine> paint_metric_grid(std::span<const Eigen::Vector3d> framed,
                                           double height_m,
                                           double pixels_per_m) {
  std::vector<PaintedLine> lines;
  if (framed.empty()) return lines;
  const double step = round_length_m(kGridStepPx / pixels_per_m);
  Eigen::Vector2d low = framed.front().head<2>();
  Eigen::Vector2d high = low;
  for (const Eigen::Vector3d& point : framed) {
    low = low.cwiseMin(point.head<2>());
    high = high.cwiseMax(point.head<2>());
  }
  const Eigen::Vector2d first = (low / step).array().floor();
  const Eigen::Vector2d last = (high / step).array().ceil();
  if ((last - first).maxCoeff() > kMaxGridLines) return lines;
  const Paint paint{kGridColor, 84};
  for (double i = first.x(); i <= last.x(); i += 1.0) {
    lines.push_back({floats({i * step, first.y() * step, height_m}),
                     floats({i * step, last.y() * step, height_m}),
                     paint});
  }
  for (double i = first.y(); i <= last.y(); i += 1.0) {
    lines.push_back({floats({first.x() * step, i * step, height_m}),
                     floats({last.x() * step, i * step, height_m}),
                     paint});
  }
  return lines;
}

}  // namespace hypermap
