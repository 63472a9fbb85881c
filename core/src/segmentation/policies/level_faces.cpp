// SPDX-License-Identifier: BSD-3-Clause
#include "level_faces.hpp"

#include "segmentation/plane_fit.hpp"
#include "surface_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace hypermap {
namespace {

/// The normal of a level face points so far up: it is less than 26 degrees from upright.
constexpr float kLevelNormal = 0.9F;
/// Level faces that lie farther apart in height are of two things.
constexpr float kLevelGapM = 0.1F;

struct LevelFace {
  float low_m = std::numeric_limits<float>::infinity();
  float high_m = -std::numeric_limits<float>::infinity();
};

/// Between which heights a surface lies, where it is a level face.
std::optional<LevelFace> level_face(const DepthWindow& window,
                                    const DepthComponents& labelled,
                                    std::uint32_t id,
                                    const Eigen::Matrix3f& gravity_aligned_from_camera) {
  LevelFace face;
  PlaneFit fit;
  for_each_cell_of(window, labelled, id, [&](int x, int y) {
    const Eigen::Vector3f point = gravity_aligned_from_camera * window.point_in_camera(x, y);
    fit.add(point);
    face.low_m = std::min(face.low_m, point.z());
    face.high_m = std::max(face.high_m, point.z());
  });
  const std::optional<Plane> plane = fit.plane();
  return plane && std::abs(plane->normal.z()) >= kLevelNormal ? std::optional(face) : std::nullopt;
}

}  // namespace

bool are_two_levels(const DepthWindow& window,
                    const DepthComponents& labelled,
                    std::uint32_t best,
                    std::uint32_t id,
                    const Eigen::Matrix3f& gravity_aligned_from_camera) {
  const auto part = level_face(window, labelled, id, gravity_aligned_from_camera);
  if (!part) return false;
  const auto of_best = level_face(window, labelled, best, gravity_aligned_from_camera);
  return of_best &&
         std::max(part->low_m - of_best->high_m, of_best->low_m - part->high_m) > kLevelGapM;
}

}  // namespace hypermap
