// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Triangle meshes that answer rays, with Embree kept in one file.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/simulator/triangle_mesh.hpp"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace hypermap {

/// What a ray met first.
struct RayHit {
  std::uint32_t mesh = 0;  ///< Position among the meshes given to `create`.
  std::uint32_t triangle = 0;
};

/// Copies the meshes' triangles. Const calls are safe in parallel.
class EmbreeScene {
 public:
  static constexpr int kPacket = 8;  ///< Rays that are followed together.

  EmbreeScene() = default;  ///< Empty: to be assigned to before use.

  /// Errors: kUnavailable when Embree gives no device or refuses the scene.
  [[nodiscard]] static Result<EmbreeScene> create(std::span<const TriangleMesh* const> meshes);

  using Packet = std::array<Eigen::Vector3f, kPacket>;

  /// The first hit of each of eight rays from one origin.
  [[nodiscard]] std::array<std::optional<RayHit>, kPacket> nearest(const Eigen::Vector3f& origin,
                                                                   const Packet& directions) const;

  /// Which of the `wanted` targets cannot be seen from the origin because something lies before
  /// them; a target's own surface, within a thousandth of the way, does not hide it.
  [[nodiscard]] std::array<bool, kPacket> hidden(const Eigen::Vector3f& origin,
                                                 const Packet& targets,
                                                 const std::array<bool, kPacket>& wanted) const;

 private:
  std::shared_ptr<void> scene_;  ///< An RTCScene with its release function.
};

}  // namespace hypermap
