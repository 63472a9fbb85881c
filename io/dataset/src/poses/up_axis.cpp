// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/up_axis.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/io/codec/bounded_json.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::size_t kMinLevelPoints = 200;
constexpr std::size_t kMaxHypotheses = 512;
constexpr double kSameDirectionCosine = 0.9848;  // 10 degrees
constexpr double kLevelNormalCosine = 0.9397;    // 20 degrees: normals of single pixels are noisy

struct NamedAxis {
  std::string_view name;
  Eigen::Vector3d direction;
};

/// The smallest turn that brings a direction to the z axis; about x where it is opposite to it.
Eigen::Isometry3d turn_to_z(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d up = direction.normalized();
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  if (up.z() < -1.0 + 1e-12) {
    turn.linear() = Eigen::Vector3d(1, -1, -1).asDiagonal();
    return turn;
  }
  // Half of the angle by its cosine. FromTwoVectors of Eigen also decomposes matrices, for opposite
  // vectors, which are turned above: twenty seconds of a sanitizer's compiler.
  const double twice_cosine = std::sqrt((1.0 + up.z()) * 2.0);
  const Eigen::Vector3d axis = up.cross(Eigen::Vector3d::UnitZ()) * (1.0 / twice_cosine);
  const Eigen::Quaterniond half_turn(twice_cosine * 0.5, axis.x(), axis.y(), axis.z());
  turn.linear() = half_turn.toRotationMatrix();
  return turn;
}

/// The direction that most of the points' normals share, near to `camera_up`.
std::optional<Eigen::Vector3d> common_normal(std::span<const SurfacePoint> points,
                                             const Eigen::Vector3d& camera_up,
                                             const FloorOptions& options) {
  std::vector<Eigen::Vector3d> normals;
  for (const SurfacePoint& point : points) {
    if (point.normal.dot(camera_up) > std::cos(options.max_tilt_rad))
      normals.push_back(point.normal);
  }
  if (normals.size() < kMinLevelPoints) return std::nullopt;
  const std::size_t step = std::max<std::size_t>(1, normals.size() / kMaxHypotheses);
  Eigen::Vector3d best = camera_up;
  std::size_t best_votes = 0;
  for (std::size_t i = 0; i < normals.size(); i += step) {
    std::size_t votes = 0;
    for (const Eigen::Vector3d& normal : normals) {
      votes += normal.dot(normals[i]) > kSameDirectionCosine ? 1U : 0U;
    }
    if (votes > best_votes) {
      best_votes = votes;
      best = normals[i];
    }
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& normal : normals) {
    if (normal.dot(best) > kSameDirectionCosine) sum += normal;
  }
  return sum.normalized();
}

/// Points whose surface is level under `up`, ordered by height.
struct LevelPoint {
  double height_m = 0.0;
  std::size_t index = 0;
};

std::vector<LevelPoint> level_points(std::span<const SurfacePoint> points,
                                     const Eigen::Vector3d& up) {
  std::vector<LevelPoint> level;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].normal.dot(up) < kLevelNormalCosine) continue;
    level.push_back({points[i].position.dot(up), i});
  }
  std::sort(level.begin(), level.end(), [](const LevelPoint& a, const LevelPoint& b) {
    return a.height_m != b.height_m ? a.height_m < b.height_m : a.index < b.index;
  });
  return level;
}

/// A run of level points no thicker than a plane.
struct HeightLayer {
  std::size_t first = 0;
  std::size_t end = 0;
  [[nodiscard]] std::size_t size() const { return end - first; }
};

/// For each point the run that begins with it; the fullest one, or the lowest full peak.
template <class Accept>
HeightLayer search_layers(const std::vector<LevelPoint>& level,
                          double thickness_m,
                          const Accept& accept) {
  HeightLayer best;
  std::size_t end = 0;
  for (std::size_t first = 0; first < level.size(); ++first) {
    while (end < level.size() && level[end].height_m <= level[first].height_m + thickness_m) ++end;
    const HeightLayer layer{first, end};
    if (!accept(layer, best)) continue;
    best = layer;
  }
  return best;
}

HeightLayer fullest_layer(const std::vector<LevelPoint>& level, double thickness_m) {
  return search_layers(level, thickness_m, [](const HeightLayer& layer, const HeightLayer& best) {
    return layer.size() > best.size();
  });
}

/// The lowest layer with enough points, moved up to where it is fullest.
HeightLayer lowest_full_layer(const std::vector<LevelPoint>& level,
                              double thickness_m,
                              std::size_t min_size) {
  return search_layers(level, thickness_m, [&](const HeightLayer& layer, const HeightLayer& best) {
    if (layer.size() < min_size) return false;
    if (best.size() == 0) return true;
    const bool overlaps = layer.first < best.end;
    return overlaps && layer.size() > best.size();
  });
}

/// Normal of the plane through a layer's points by least squares, on the side of `up`.
Eigen::Vector3d fitted_normal(std::span<const SurfacePoint> points,
                              const std::vector<LevelPoint>& level,
                              const HeightLayer& layer,
                              const Eigen::Vector3d& up) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = layer.first; i < layer.end; ++i) mean += points[level[i].index].position;
  mean /= static_cast<double>(layer.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (std::size_t i = layer.first; i < layer.end; ++i) {
    const Eigen::Vector3d d = points[level[i].index].position - mean;
    scatter += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  return normal.dot(up) < 0.0 ? Eigen::Vector3d(-normal) : normal;
}

double median_height(const std::vector<LevelPoint>& level, const HeightLayer& layer) {
  return level[layer.first + layer.size() / 2].height_m;
}

FloorEstimate summary_of(const Eigen::Vector3d& up,
                         double height_m,
                         const Eigen::Vector3d& camera_up,
                         std::span<const SurfacePoint> points,
                         double thickness_m) {
  FloorEstimate out;
  out.up_in_input = up;
  out.floor_height_m = height_m;
  out.tilt_from_camera_rad = std::acos(std::clamp(up.dot(camera_up), -1.0, 1.0));
  const auto on_floor = std::count_if(points.begin(), points.end(), [&](const SurfacePoint& p) {
    return std::abs(p.position.dot(up) - height_m) <= 0.5 * thickness_m;
  });
  out.inlier_share = static_cast<double>(on_floor) / static_cast<double>(points.size());
  out.num_points = points.size();
  Eigen::Isometry3d map_from_input = turn_to_z(up);
  map_from_input.pretranslate(Eigen::Vector3d(0.0, 0.0, -height_m));
  out.map_from_input = MapFromInput(map_from_input);
  return out;
}

/// The surface at a pixel from its neighbours; none at edges, holes and jumps of depth.
std::optional<SurfacePoint> surface_at(const RgbdFrame& frame,
                                       int u,
                                       int v,
                                       const FloorOptions& o) {
  constexpr int kReach = 3;
  const auto point = [&](int x, int y) -> std::optional<Eigen::Vector3d> {
    if (!frame.depth_m.contains(x, y)) return std::nullopt;
    const double z = static_cast<double>(frame.depth_m.at(x, y));
    if (!(z >= o.min_range_m && z <= o.max_range_m)) return std::nullopt;
    return frame.camera.unproject(x, y, z).xyz;
  };
  const auto centre = point(u, v);
  const auto left = point(u - kReach, v);
  const auto right = point(u + kReach, v);
  const auto above = point(u, v - kReach);
  const auto below = point(u, v + kReach);
  if (!centre || !left || !right || !above || !below) return std::nullopt;
  const double max_jump_m = 0.06 * centre->z();
  for (const auto& other : {left, right, above, below}) {
    if (std::abs(other->z() - centre->z()) > max_jump_m) return std::nullopt;
  }
  Eigen::Vector3d normal = (*right - *left).cross(*above - *below).normalized();
  if (normal.dot(*centre) > 0.0) normal = -normal;
  const Eigen::Isometry3d& pose = frame.map_from_camera.isometry();
  return SurfacePoint{pose * *centre, pose.linear() * normal};
}

}  // namespace

Result<MapFromInput> map_from_input_axis(std::string_view axis) {
  const std::array<NamedAxis, 6> axes{{{"x", Eigen::Vector3d::UnitX()},
                                       {"-x", -Eigen::Vector3d::UnitX()},
                                       {"y", Eigen::Vector3d::UnitY()},
                                       {"-y", -Eigen::Vector3d::UnitY()},
                                       {"z", Eigen::Vector3d::UnitZ()},
                                       {"-z", -Eigen::Vector3d::UnitZ()}}};
  std::vector<std::string_view> names;
  for (const NamedAxis& named : axes) {
    if (named.name == axis) return MapFromInput(turn_to_z(named.direction));
    names.push_back(named.name);
  }
  return fail(ErrorCode::kInvalidArgument, not_one_of(axis, names), "up");
}

std::string to_string(const FloorEstimate& estimate) {
  const auto rounded = [](double value) { return json_number(std::round(value * 1e4) / 1e4); };
  const Eigen::Vector3d& n = estimate.up_in_input;
  return "floor plane: normal (" + rounded(n.x()) + ", " + rounded(n.y()) + ", " + rounded(n.z()) +
         "), height " + rounded(estimate.floor_height_m) + " m, " +
         json_number(std::round(estimate.inlier_share * 1000.0) / 10.0) + " % of " +
         std::to_string(estimate.num_points) + " points, " +
         json_number(std::round(estimate.tilt_from_camera_rad * 1800.0 / std::numbers::pi) / 10.0) +
         " degrees from the cameras' up";
}

Result<FloorEstimate> find_floor(std::span<const SurfacePoint> points,
                                 const Eigen::Vector3d& camera_up_in_input,
                                 const FloorOptions& options) {
  HYPERMAP_TRY(validate(options));
  const auto start = common_normal(points, camera_up_in_input, options);
  if (!start) {
    return fail(ErrorCode::kNotFound,
                "no level surface seen, expected at least " + std::to_string(kMinLevelPoints) +
                    " points with a normal near the cameras' up",
                "floor");
  }
  Eigen::Vector3d up = *start;
  constexpr int kRefinements = 4;
  for (int i = 0; i < kRefinements; ++i) {  // the fullest plane, often a table, is as level
    const auto level = level_points(points, up);
    const HeightLayer layer = fullest_layer(level, options.thickness_m);
    if (layer.size() < 3) break;
    up = fitted_normal(points, level, layer, up);
  }
  for (int i = 0; i < kRefinements; ++i) {
    const auto level = level_points(points, up);
    const auto enough = static_cast<std::size_t>(
        std::ceil(options.min_level_share * static_cast<double>(level.size())));
    const HeightLayer floor =
        lowest_full_layer(level, options.thickness_m, std::max<std::size_t>(enough, 3));
    if (level.size() < kMinLevelPoints || floor.size() == 0) {
      return fail(ErrorCode::kNotFound, "no plane holds enough of the level points", "floor");
    }
    if (i + 1 == kRefinements) {
      return summary_of(
          up, median_height(level, floor), camera_up_in_input, points, options.thickness_m);
    }
    up = fitted_normal(points, level, floor, up);
  }
  return fail(ErrorCode::kNotFound, "no plane holds enough of the level points", "floor");
}

Result<FloorEstimate> estimate_floor(const DatasetReader& reader, const FloorOptions& options) {
  HYPERMAP_TRY(validate(options));
  std::vector<SurfacePoint> points;
  Eigen::Vector3d camera_up = Eigen::Vector3d::Zero();
  const std::size_t wanted = std::min(options.num_frames, reader.size());
  for (std::size_t i = 0; i < wanted; ++i) {
    const auto frame = reader.read(i * reader.size() / wanted);
    if (!frame) continue;
    camera_up -= frame->map_from_camera.isometry().linear().col(1);
    for (int v = 0; v < frame->depth_m.height_px(); v += options.pixel_step) {
      for (int u = 0; u < frame->depth_m.width_px(); u += options.pixel_step) {
        if (const auto point = surface_at(*frame, u, v, options)) points.push_back(*point);
      }
    }
  }
  if (points.empty() || camera_up.norm() < 1e-9) {
    return fail(ErrorCode::kNotFound, "no frame shows a surface", "floor");
  }
  return find_floor(points, camera_up.normalized(), options);
}

}  // namespace hypermap
