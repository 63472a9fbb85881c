// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where surfaces touch the level planes beside an object, and rims: the top of the desk that a
/// chair is pushed under, and its edge.
#pragma once

#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "segmentation/background_planes.hpp"
#include "segmentation/depth_components.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hypermap {

/// Of a window's surfaces, how they touch its level background planes. Two neighbouring cells touch
/// that differ in depth by no more than the step of one surface. A plane that ends with the box may
/// be the object's own top, and none is counted that does.
///
/// `depth_m` is the picture that the window was cut out of. Planes are numbered by the surfaces'
/// kinds, from 1; `up_in_camera` is of length 1. The picture, the window, the surfaces and the
/// planes must outlive it. Not in the sources.
class SupportContacts {
 public:
  /// Cost: O(cells of the box and below it), and O(surfaces) for each plane.
  SupportContacts(const DepthImage& depth_m,
                  const DepthWindow& window,
                  const DepthComponents& labelled,
                  const std::vector<Plane>& planes,
                  const Eigen::Vector3f& up_in_camera);

  /// Whether the surface is the rim of a support that goes on outside the box, as that of a desk
  /// with the legs below it: in most of its columns of the picture thin runs of cells, one below
  /// the other (the edge of the top, the frame), begin at a plane, or at a top seen too flat to be
  /// measured, and end over what is clearly farther away. Boundary: none is where the camera is
  /// rolled by more than 30 degrees.
  [[nodiscard]] bool is_rim(std::uint32_t id) const;

  /// Per surface whether it is of a support that the object passes and does not stand on: the rim,
  /// or what lies on it. Much of its border touches a plane below which much of the object's best
  /// surface lies. Requires: `best` has cells in the box. Cost: O(surfaces), and O(cells of the
  /// best one) for each level plane.
  [[nodiscard]] std::vector<bool> of_passed_supports(std::uint32_t best) const;

 private:
  [[nodiscard]] bool is_level(const Plane& plane) const;
  [[nodiscard]] bool touches_plane(std::size_t cell, std::size_t other) const;
  void count_borders();
  void count_rims_of_column(int x, float most_across_ray_m);
  void count_rim(std::uint32_t id, int x);
  /// The row of the next measured cell below; none within reach.
  [[nodiscard]] std::optional<int> next_below(int x, int y) const;
  /// The row after the cells of one surface that a cell begins.
  [[nodiscard]] int end_of_run(int x, int y) const;
  [[nodiscard]] bool is_of_no_plane(int x, int y) const;
  /// Whether nothing is measured above a cell, in range or beyond it, as on a top that is seen
  /// flat.
  [[nodiscard]] bool is_below_unmeasured(int x, int y) const;
  /// The row after the last of the rims that begin with a cell, one below the other: what is
  /// measured next below is clearly farther away. `y` where there are none. `most_across_ray_m`:
  /// how far apart their ends are at most, across the line of sight.
  [[nodiscard]] int end_of_rims(int x, int y, float most_across_ray_m) const;
  [[nodiscard]] bool is_passed_by(std::uint32_t best, const Plane& plane) const;
  [[nodiscard]] std::uint32_t& num_contacts(std::uint32_t id, std::size_t plane) {
    return num_contacts_[id * planes_.size() + plane];
  }

  const DepthImage& depth_m_;
  const DepthWindow& window_;
  const DepthComponents& labelled_;
  const std::vector<Plane>& planes_;
  Eigen::Vector3f up_in_camera_;
  std::vector<bool> is_support_;  // per surface, that it is of a level plane beside the object
  std::vector<std::uint32_t> num_borders_;      // per surface: neighbours of no or another surface
  std::vector<std::uint32_t> num_contacts_;     // of these per surface and plane
  std::vector<std::uint32_t> num_rim_columns_;  // per surface
  std::vector<int> last_rim_column_;            // of these per surface
};

}  // namespace hypermap
