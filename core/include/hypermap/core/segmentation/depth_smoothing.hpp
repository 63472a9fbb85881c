// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Depth with less of the sensor's noise.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/result.hpp"

#include <cstdint>
#include <vector>

namespace hypermap {

struct OptionTable;

enum class DepthSmoothingRule : std::uint8_t {
  kNone,   ///< Depth is used as it was measured.
  kPairs,  ///< The mean of inverse depth over pairs of opposite neighbours that both are near.
};

struct DepthSmoothingOptions {
  DepthSmoothingRule rule = DepthSmoothingRule::kPairs;
  /// Neighbours are those of the square with sides of 2 radius_px + 1 pixels, 1 .. 8.
  int radius_px = 2;
  /// A neighbour is near when it differs by at most so many standard deviations of the sensor's
  /// axial noise (axial_noise_m), at the pixel's depth.
  double gate_sigmas = 3.0;
  /// Nearer pixels stay as measured: their noise is small beside a voxel. Unit: metre.
  double min_depth_m = 1.5;
  friend bool operator==(const DepthSmoothingOptions&, const DepthSmoothingOptions&) = default;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const DepthSmoothingOptions& options);
[[nodiscard]] const OptionTable& option_table(const DepthSmoothingOptions& options);

/// Takes noise out of depth images, with buffers that serve the next image of the same size.
///
/// Inverse depth is linear in the pixel across a plane, and pairs of opposite neighbours are
/// symmetric about it: the mean of a plane's pixels stays on the plane, at any slant and beside an
/// edge. A pair counts when both are near, so that no two surfaces are mixed that lie farther apart
/// than the gate. Source: ours; the gate is that of J.-S. Lee's sigma filter, CVGIP 24, 1983.
class DepthSmoother {
 public:
  /// Requires: valid options.
  explicit DepthSmoother(const DepthSmoothingOptions& options) : options_(options) {}

  /// The depth with less noise: same size, measured where `depth_m` is, unchanged where no pair is
  /// near. With rule kNone a copy. Unit: metre. Boundary: pixels whose square reaches beyond the
  /// image have the pairs inside it. Cost: 2 radius (radius + 1) pairs a pixel from min_depth_m on;
  /// the rows are shared out among `num_threads`, of which the result does not depend. Throws
  /// std::bad_alloc.
  [[nodiscard]] DepthImage smoothed(const DepthImage& depth_m, int num_threads);

 private:
  void measure_row(const DepthImage& depth_m, int v);
  void smooth_row(const DepthImage& depth_m, int v, float* smoothed_m) const;

  DepthSmoothingOptions options_;
  std::vector<float> inverse_;  ///< 1 / depth, 0 where not measured; shape as the image.
  /// The largest difference of inverse depth that is near; negative where a pixel stays as it is.
  std::vector<float> gate_;
};

}  // namespace hypermap
