// SPDX-License-Identifier: BSD-3-Clause
#include "scene_shapes.hpp"

#include "hypermap/viewer_offscreen/annotation/scale_bar.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace hypermap {
namespace {

constexpr Rgb8 kTrajectoryColor{214, 40, 57};
constexpr Rgb8 kGridColor{120, 132, 148};
constexpr float kDarkest = 0.60F;
constexpr double kGridStepPx = 140.0;  // at most, between two lines of the grid
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

}  // namespace

Result<std::vector<PaintedFace>> paint_voxels(const VisibleVoxels& voxels,
                                              const ClassColors& colors,
                                              const SnapshotCamera& camera) {
  const auto directions = directions_seen(camera);
  HYPERMAP_ASSIGN_OR_RETURN(const auto faces, exposed_faces(voxels.voxels, directions));
  std::vector<PaintedFace> painted;
  painted.reserve(faces.size());
  for (const VoxelFace& face : faces) {
    const OccupiedVoxel& voxel = voxels.voxels[face.voxel_index];
    if (camera.eye_in_map() && !faces_eye(voxel, face.direction, *camera.eye_in_map())) continue;
    const Rgb8 color =
        voxel.class_id
            ? colors.of(voxel.class_id)
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

std::vector<PaintedLine> paint_boxes(std::span<const SnapshotObject> objects,
                                     const ClassColors& colors) {
  std::vector<PaintedLine> lines;
  lines.reserve(objects.size() * 12);
  for (const SnapshotObject& object : objects) {
    const auto corners = object.box.corners();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      for (const std::size_t axis : {1U, 2U, 4U}) {  // corners that differ in one bit share an edge
        if ((k & axis) != 0) continue;
        lines.push_back(
            {floats(corners[k]), floats(corners[k | axis]), {colors.of(object.class_id)}});
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
