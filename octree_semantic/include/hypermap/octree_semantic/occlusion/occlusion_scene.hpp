// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether the map's own geometry stands between two points.
///
/// The occupied voxels as an Embree scene, in voxels as its unit: one primitive per brick, whose
/// bits are walked in the callback. Source: I. Wald et al., "Embree", ACM TOG 33 (2014); J.
/// Amanatides and A. Woo, "A fast voxel traversal algorithm for ray tracing", Eurographics 1987.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace hypermap {

/// A ray between two points that is tested for occlusion.
struct OcclusionRay {
  PointInMap from;
  PointInMap to;
  /// So much before `to` is left out, so that the object does not occlude itself.
  double margin_m = 0.0;
};

/// Occlusion queries against one tree.
///
/// Threads: queries may run concurrently, not while `update` runs.
class OcclusionScene {
 public:
  /// An empty scene: nothing occludes. Rays are traced in packets of 4, 8 or 16: as many as the
  /// processor's vectors hold, not more than `max_lanes`. Requires: max_lanes >= 4. Errors:
  /// kUnavailable when Embree cannot start or has no packets of rays.
  [[nodiscard]] static Result<OcclusionScene> create(std::size_t max_lanes = 16);
  OcclusionScene(OcclusionScene&&) noexcept;
  OcclusionScene& operator=(OcclusionScene&&) noexcept;
  OcclusionScene(const OcclusionScene&) = delete;
  OcclusionScene& operator=(const OcclusionScene&) = delete;
  ~OcclusionScene();

  /// Brings the scene up to the tree's present state. Only bricks that changed since the last call
  /// are copied, only the regions that they lie in built again. Returns how many bricks.
  /// Requires: always the same tree (or a later state of it); another one wants another scene.
  /// Errors: kOutOfMemory, kUnavailable. The scene is empty then, and the next call fills it anew.
  [[nodiscard]] Result<std::size_t> update(const SemanticOctree& tree, int num_threads = 1);

  /// Whether an occupied voxel lies on the way from `from` to `to` less the margin.
  ///
  /// Boundary: on a face the voxel is hit by one of its neighbours; within a thousandth of a voxel
  /// and a millionth of the coordinates from an edge, either answer. A start inside an occupied
  /// voxel is occluded. Not longer than the margin, not finite, or starting beyond 10^9 voxels from
  /// the origin: not occluded.
  [[nodiscard]] bool occluded(const OcclusionRay& ray) const;
  /// One result per ray: 1 when occluded; the same as for the ray alone. Fast for coherent rays, a
  /// camera's to one object. The result does not depend on the number of threads.
  [[nodiscard]] std::vector<std::uint8_t> occluded(std::span<const OcclusionRay> rays,
                                                   int num_threads = 1) const;

  [[nodiscard]] std::size_t num_bricks() const noexcept;

 private:
  struct Scene;
  explicit OcclusionScene(std::unique_ptr<Scene> scene);
  std::unique_ptr<Scene> scene_;
};

}  // namespace hypermap
