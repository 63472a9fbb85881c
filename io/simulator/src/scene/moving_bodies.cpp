// SPDX-License-Identifier: BSD-3-Clause
#include "moving_bodies.hpp"

#include "hypermap/core/base/random_numbers.hpp"
#include "hypermap/io/simulator/furniture.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace hypermap {
namespace {

constexpr std::uint64_t kStartStream = 0x7374617274;  // which numbers: "start"
constexpr double kShortestLegM = 0.01;

/// Length of the way. Errors: kInvalidArgument as `MovingBodies::create` says.
Result<double> length_m(const MovingBody& body) {
  if (body.way_in_map.size() < 2)
    return fail(ErrorCode::kInvalidArgument, "must have 2 points or more", "way");
  if (!(body.speed_m_per_s > 0.0))
    return fail(ErrorCode::kInvalidArgument,
                "must be above 0, is " + std::to_string(body.speed_m_per_s),
                "speed");
  double sum = 0.0;
  for (std::size_t i = 1; i < body.way_in_map.size(); ++i) {
    const double leg = (body.way_in_map[i] - body.way_in_map[i - 1]).norm();
    if (!(leg >= kShortestLegM))
      return fail(ErrorCode::kInvalidArgument, "has points less than 1 cm apart", "way");
    sum += leg;
  }
  return sum;
}

/// A frame at `along_m` of the way (0 .. its length), x towards the way's end or, `back`, its
/// beginning.
Eigen::Isometry3d pose_on(const std::vector<Eigen::Vector2d>& way, double along_m, bool back) {
  std::size_t leg = 1;
  double left = along_m;
  for (; leg + 1 < way.size(); ++leg) {
    const double length = (way[leg] - way[leg - 1]).norm();
    if (left <= length) break;
    left -= length;
  }
  const Eigen::Vector2d ahead = (way[leg] - way[leg - 1]).normalized();
  const Eigen::Vector2d place = way[leg - 1] + left * ahead;
  const Eigen::Vector2d front = back ? Eigen::Vector2d(-ahead) : ahead;
  return Eigen::Translation3d(place.x(), place.y(), 0.0) *
         Eigen::AngleAxisd(std::atan2(front.y(), front.x()), Eigen::Vector3d::UnitZ());
}

}  // namespace

Result<MovingBodies> MovingBodies::create(std::span<const MovingBody> bodies, std::uint64_t seed) {
  const auto naming = [](Error error, const std::string& name) {
    error.entry = name;
    return tl::make_unexpected(std::move(error));
  };
  MovingBodies result;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const MovingBody& body = bodies[i];
    const auto way_m = length_m(body);
    if (!way_m) return naming(way_m.error(), body.name);
    auto mesh = build_furniture({body.shape, body.size_m, body.colors});
    if (!mesh) return naming(mesh.error(), body.name);
    CounterRng random(seed, kStartStream, i);
    result.bodies_.push_back({body.way_in_map,
                              *way_m,
                              body.speed_m_per_s,
                              seed == 0 ? 0.0 : 2.0 * *way_m * random.uniform()});
    result.meshes_.push_back(*std::move(mesh));
  }
  return result;
}

std::vector<Eigen::Isometry3d> MovingBodies::poses_at(double time_s) const {
  std::vector<Eigen::Isometry3d> poses;
  poses.reserve(bodies_.size());
  for (const Body& body : bodies_) {
    const double round_m = 2.0 * body.way_m;
    const double gone = std::fmod(body.start_m + time_s * body.speed_m_per_s, round_m);
    const bool back = gone > body.way_m;
    poses.push_back(pose_on(body.way, back ? round_m - gone : gone, back));
  }
  return poses;
}

}  // namespace hypermap
