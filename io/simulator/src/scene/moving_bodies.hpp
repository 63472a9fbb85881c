// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where those are at a moment that go to and fro through a scene.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/simulator/scene.hpp"

#include <Eigen/Geometry>

#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// The moving bodies of a scene. Const calls are safe in parallel.
class MovingBodies {
 public:
  /// `seed` says where on its round trip each begins; with seed 0 all begin at the first point.
  ///
  /// Errors: kNotFound and kInvalidArgument of `build_furniture`, or kInvalidArgument for a way of
  /// fewer than two points, points less than 1 cm apart or a speed that is not above 0. `entry`
  /// names the body.
  [[nodiscard]] static Result<MovingBodies> create(std::span<const MovingBody> bodies,
                                                   std::uint64_t seed);

  /// Their shapes, each in its own frame as `build_furniture` gives it.
  [[nodiscard]] std::span<const TriangleMesh> meshes() const noexcept { return meshes_; }
  /// Where they are at that time (map from mesh), looking where they go.
  [[nodiscard]] std::vector<Eigen::Isometry3d> poses_at(double time_s) const;

 private:
  struct Body {
    std::vector<Eigen::Vector2d> way;
    double way_m = 0.0;
    double speed_m_per_s = 1.0;
    double start_m = 0.0;  ///< On the round trip of twice `way_m`.
  };
  std::vector<Body> bodies_;
  std::vector<TriangleMesh> meshes_;
};

}  // namespace hypermap
