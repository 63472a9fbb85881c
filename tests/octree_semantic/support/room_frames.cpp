// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/box.hpp"
#include "octree_semantic/support/labelled_frame.hpp"
#include "support/camera_pose.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <random>

namespace hypermap::test {
namespace {

constexpr int kNumClasses = 8;

struct Furniture {
  Box box;
  std::uint32_t class_id = 0;
  std::uint32_t object = 0;
};

Box make_box(double x, double y, double z, double width, double depth, double height) {
  return {{x, y, z}, {x + width, y + depth, z + height}};
}

/// A plate on four legs.
void add_table(std::vector<Furniture>& room,
               const Eigen::Vector2d& corner,
               const Eigen::Vector3d& size,
               std::uint32_t class_id) {
  const std::uint32_t object = room.empty() ? 1 : room.back().object + 1;
  constexpr double kPlate = 0.04;
  constexpr double kLeg = 0.05;
  const double under = size.z() - kPlate;
  room.push_back(
      {make_box(corner.x(), corner.y(), under, size.x(), size.y(), kPlate), class_id, object});
  for (const double along : {0.0, size.x() - kLeg}) {
    for (const double across : {0.0, size.y() - kLeg}) {
      room.push_back({make_box(corner.x() + along, corner.y() + across, 0.0, kLeg, kLeg, under),
                      class_id,
                      object});
    }
  }
}

void add_block(std::vector<Furniture>& room, const Box& box, std::uint32_t class_id) {
  room.push_back({box, class_id, room.empty() ? 1 : room.back().object + 1});
}

std::vector<Furniture> furnish() {
  std::vector<Furniture> room;
  add_table(room, {1.0, 1.0}, {1.6, 0.8, 0.74}, 0);
  add_table(room, {4.5, 2.2}, {1.8, 1.0, 0.75}, 0);
  for (const Eigen::Vector2d& corner :
       {Eigen::Vector2d(1.4, 2.0), {4.7, 1.6}, {5.5, 3.4}, {6.2, 2.4}}) {
    add_table(room, corner, {0.45, 0.45, 0.46}, 1);
  }
  add_block(room, make_box(7.5, 0.5, 0.0, 0.45, 1.5, 2.0), 2);
  add_block(room, make_box(0.05, 3.5, 0.0, 0.9, 2.0, 0.42), 3);
  add_block(room, make_box(1.2, 1.1, 0.74, 0.55, 0.2, 0.36), 4);
  add_block(room, make_box(5.0, 2.5, 0.75, 0.08, 0.08, 0.24), 5);
  add_block(room, make_box(3.0, 5.5, 0.0, 1.2, 0.45, 1.2), 6);
  add_block(room, make_box(6.8, 5.2, 0.0, 0.5, 0.5, 0.6), 7);
  return room;
}

/// Where a ray enters a box, or leaves it when it starts inside.
std::optional<double> distance_to(const Box& box,
                                  const Eigen::Vector3d& origin,
                                  const Eigen::Vector3d& direction) {
  double enters = -1e9;
  double leaves = 1e9;
  for (int i = 0; i < 3; ++i) {
    double a = (box.min_in_map[i] - origin[i]) / direction[i];
    double b = (box.max_in_map[i] - origin[i]) / direction[i];
    if (a > b) std::swap(a, b);
    enters = std::max(enters, a);
    leaves = std::min(leaves, b);
  }
  if (enters > leaves || leaves <= 0.0) return std::nullopt;
  return enters > 0.0 ? enters : leaves;
}

MapFromCamera camera_pose(double turn) {
  const Eigen::Vector3d origin(
      4.0 + 2.2 * std::cos(turn), 3.0 + 1.3 * std::sin(turn), 1.25 + 0.1 * std::sin(3.0 * turn));
  const double yaw = turn + 2.4 + 0.5 * std::sin(2.0 * turn);
  constexpr double kPitchRad = -0.22;
  return camera_at(origin, yaw, kPitchRad);
}

void render(LabelledFrame& into, const std::vector<Furniture>& room, std::mt19937& random) {
  const Box walls = make_box(0.0, 0.0, 0.0, 8.0, 6.0, 2.7);
  const Eigen::Vector3d origin = into.frame.map_from_camera.origin().xyz;
  const Eigen::Matrix3d rotation = into.frame.map_from_camera.isometry().linear();
  // Sum of four uniform numbers: near enough to a Gaussian, and the same with every library.
  const auto noise = [&random] {
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) sum += static_cast<double>(random()) / 4294967296.0 - 0.5;
    return sum * std::numbers::sqrt3;
  };
  DepthImage& depth_m = into.frame.depth_m;
  for (int v = 0; v < depth_m.height_px(); ++v) {
    for (int u = 0; u < depth_m.width_px(); ++u) {
      Eigen::Vector3d ray = rotation * into.frame.camera.unproject(u, v, 1.0).xyz;
      ray = ray.unaryExpr([](double x) { return std::abs(x) < 1e-9 ? 1e-9 : x; });
      double nearest = distance_to(walls, origin, ray).value_or(0.0);
      const Furniture* seen = nullptr;
      for (const Furniture& piece : room) {
        const auto distance = distance_to(piece.box, origin, ray);
        if (!distance || *distance >= nearest) continue;
        nearest = *distance;
        seen = &piece;
      }
      const double far = nearest - 0.4;
      const double measured = nearest + noise() * (0.0012 + 0.0019 * far * far);
      const double rounded = std::round(measured * 1000.0) / 1000.0;
      if (rounded < 0.3 || rounded > 10.0 || random() % 128 == 0) continue;
      depth_m.at(u, v) = static_cast<float>(rounded);
      if (seen == nullptr) continue;
      into.labels[seen->object - 1].pixel_indices.push_back(
          static_cast<std::uint32_t>(depth_m.index(u, v)));
    }
  }
}

}  // namespace

std::vector<ClassEvidence> class_vector(ClassId id, double p, int num_classes) {
  std::vector<ClassEvidence> scores;
  const double share = (1.0 - p) / (num_classes - 1);
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(num_classes); ++i) {
    scores.push_back({ClassId{i}, Probability(i == id.value ? p : share)});
  }
  return scores;
}

std::vector<LabelledFrame> room_frames(int num_frames, int width_px) {
  const std::vector<Furniture> room = furnish();
  std::mt19937 random(7);
  std::vector<LabelledFrame> frames(static_cast<std::size_t>(num_frames));
  const int height_px = width_px * 3 / 4;
  const double focal_px = 525.0 * width_px / 640.0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    RgbdFrame& frame = frames[i].frame;
    frame.index = i;
    frame.camera = {
        width_px, height_px, focal_px, focal_px, width_px / 2.0 - 0.5, height_px / 2.0 - 0.5};
    frame.depth_m = DepthImage(width_px, height_px);
    frame.map_from_camera =
        camera_pose(2.0 * std::numbers::pi * static_cast<double>(i) / num_frames);
    for (const Furniture& piece : room) {
      if (piece.object <= frames[i].labels.size()) continue;
      frames[i].labels.push_back(
          {ObjectId{piece.object}, class_vector(ClassId{piece.class_id}, 0.7, kNumClasses), {}});
    }
    render(frames[i], room, random);
  }
  return frames;
}

std::vector<Eigen::Vector3f> measured_points(const RgbdFrame& frame) {
  std::vector<Eigen::Vector3f> points;
  for (int v = 0; v < frame.depth_m.height_px(); ++v) {
    for (int u = 0; u < frame.depth_m.width_px(); ++u) {
      const float depth_m = frame.depth_m.at(u, v);
      if (!(depth_m > 0.0F) || !std::isfinite(depth_m)) continue;
      const auto point = frame.camera.unproject(u, v, static_cast<double>(depth_m));
      points.emplace_back((frame.map_from_camera * point).xyz.cast<float>());
    }
  }
  return points;
}

}  // namespace hypermap::test
