// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// An image's depth in coarse panels: what lies where, for occlusion tests.
///
/// Source: [smap] 3.4, table D.2.
#pragma once

#include "hypermap/core/base/max_range.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

struct OptionTable;

struct BinnedDepthMapOptions {
  /// Panels across.
  int columns = 24;
  /// Panels down.
  int rows = 16;
  /// Nearer depth is dropped. Unit: metre.
  double min_range_m = 0.2;
  /// Farther depth is dropped; a panel without a nearer point is empty. None: as the map's range in
  /// a mapper, kDefaultMaxRangeM alone. Unit: metre.
  std::optional<double> max_range_m = std::nullopt;

  friend bool operator==(const BinnedDepthMapOptions&, const BinnedDepthMapOptions&) = default;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const BinnedDepthMapOptions& options);
[[nodiscard]] const OptionTable& option_table(const BinnedDepthMapOptions& options);

/// One panel: the box of its points, which may overlap its neighbours' ([smap] figure 3.17).
struct DepthPanel {
  Box box;                       ///< Frame: Map.
  double nearest_m = 0.0;        ///< Smallest distance from the camera.
  double farthest_m = 0.0;       ///< Largest distance from the camera.
  std::uint32_t num_points = 0;  ///< 0: nothing was measured, box and distances are 0.
};

/// A grid of panels over one image, row-major, row 0 on top.
class BinnedDepthMap {
 public:
  /// Requires: validate(frame), validate(options). Boundary: an image with fewer pixels than
  /// panels leaves panels empty. Cost: O(pixels). The same result with any number of threads.
  [[nodiscard]] static BinnedDepthMap create(const RgbdFrame& frame,
                                             const BinnedDepthMapOptions& options = {},
                                             int threads = 1);

  [[nodiscard]] int columns() const noexcept { return columns_; }
  [[nodiscard]] int rows() const noexcept { return rows_; }
  [[nodiscard]] std::span<const DepthPanel> panels() const noexcept { return panels_; }
  /// Requires: 0 <= column < columns(), 0 <= row < rows().
  [[nodiscard]] const DepthPanel& at(int column, int row) const;
  [[nodiscard]] const PointInMap& camera_centre() const noexcept { return camera_centre_; }
  /// Unit vector along the optical axis.
  [[nodiscard]] const Eigen::Vector3d& camera_axis_in_map() const noexcept {
    return camera_axis_in_map_;
  }

 private:
  BinnedDepthMap(const RgbdFrame& frame, const BinnedDepthMapOptions& options);

  int columns_ = 0;
  int rows_ = 0;
  PointInMap camera_centre_;
  Eigen::Vector3d camera_axis_in_map_;
  std::vector<DepthPanel> panels_;
};

}  // namespace hypermap
