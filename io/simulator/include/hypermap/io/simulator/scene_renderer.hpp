// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a perfect camera sees of a furnished scene.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/camera.hpp"
#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/io/simulator/scene.hpp"

#include <memory>
#include <span>

namespace hypermap {

/// Which object each pixel shows; kNoObject where it shows the room.
using InstanceImage = Image<ObjectId>;

/// An image without noise. Shape: all images have the camera's size.
struct RenderedView {
  DepthImage depth_m;          ///< Along the optical axis; 0 where no ray hits.
  Image<float> incidence_cos;  ///< |cos| between ray and surface normal; 0 where no ray hits.
  InstanceImage instances;
  ColorImage color;
};

/// Casts one ray per pixel centre with Embree; the same bytes at any thread count.
///
/// Depth is computed from the hit triangle's plane in double precision, independent of the
/// instruction set that Embree picks.
class SceneRenderer {
 public:
  /// `bodies` are shapes in frames of their own that each view may put elsewhere. Their ids follow
  /// those of the objects.
  /// Errors: kUnavailable when Embree gives no device; kOutOfMemory.
  [[nodiscard]] static Result<SceneRenderer> create(const FurnishedScene& scene,
                                                    std::span<const TriangleMesh> bodies = {});
  SceneRenderer(SceneRenderer&&) noexcept;
  SceneRenderer& operator=(SceneRenderer&&) noexcept;
  ~SceneRenderer();

  /// Rows in parallel, on the threads of the caller's TBB arena.
  /// `map_from_bodies`: where the bodies of `create` are. Requires: a valid camera; a pose for each
  /// body. Cost: two rays a pixel (the second for shadows), and as many for each body.
  [[nodiscard]] RenderedView render(const PinholeCamera& camera,
                                    const MapFromCamera& map_from_camera,
                                    std::span<const Eigen::Isometry3d> map_from_bodies = {}) const;

  /// How much of each object's own silhouette is unhidden in the view: pixels of the object over
  /// pixels that it would fill alone, both counted on a grid, 0 .. 1.
  ///
  /// The silhouette reaches beyond the image (to twice its size on each side), so that what the
  /// image's edge cuts off counts as hidden. Result: one number per id in `objects`.
  /// Requires: `view` was rendered with the same camera and poses.
  [[nodiscard]] std::vector<double> unhidden_shares(
      const RenderedView& view,
      std::span<const ObjectId> objects,
      const PinholeCamera& camera,
      const MapFromCamera& map_from_camera,
      std::span<const Eigen::Isometry3d> map_from_bodies = {}) const;

 private:
  struct Impl;
  explicit SceneRenderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace hypermap
