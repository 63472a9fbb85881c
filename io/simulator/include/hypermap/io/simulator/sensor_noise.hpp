// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a structured-light depth camera makes of a perfect depth image.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/result.hpp"

#include <cstdint>

namespace hypermap {

struct OptionTable;

/// Source: docs/EVALUATION.md, "Noise". The axial noise is the model of C. Nguyen, S. Izadi, D.
/// Lovell, "Modeling Kinect sensor noise for improved 3D reconstruction and tracking", 2012.
struct SensorNoiseOptions {
  double min_range_m = 0.4;      ///< Nearer gives no depth.                Range: >= 0
  double max_range_m = 6.0;      ///< Farther gives no depth.               Range: > min
  double noise_base_m = 0.0012;  ///< Standard deviation at 0.4 m.          Range: >= 0
  double noise_per_m2 = 0.0019;  ///< Its growth with (z - 0.4 m)^2, 1/m.   Range: >= 0
  double step_m = 0.001;         ///< Depth comes in these steps.           Range: > 0
  double edge_ratio =
      0.02;  ///< Steps of depth to a neighbour above this share of it: hole. Range: > 0
  double max_incidence_rad = 1.30899694;  ///< Flatter views give holes: 75 deg.  Range: 0 .. pi/2
  double dropout = 0.01;                  ///< Share of pixels lost at random.       Range: 0 .. 1
};

/// Errors: kInvalidArgument naming the field as one of SimulationOptions: "sensor.step_m".
[[nodiscard]] Result<void> validate(const SensorNoiseOptions& options);
[[nodiscard]] const OptionTable& option_table(const SensorNoiseOptions& options);

/// sigma(z) = noise_base_m + noise_per_m2 (z - 0.4 m)^2.
[[nodiscard]] double axial_noise_m(double depth_m, const SensorNoiseOptions& options);

/// The measured image: 0 where there is no measurement, else depth with noise in whole steps.
///
/// `incidence_cos` is |cos| of the angle between ray and surface normal. `seed` and `frame` name
/// the random stream; each pixel has its own numbers, so any order of work gives the same image.
/// Requires: both images have one size.
[[nodiscard]] DepthImage measured_depth(const DepthImage& true_depth_m,
                                        const Image<float>& incidence_cos,
                                        const SensorNoiseOptions& options,
                                        std::uint64_t seed,
                                        std::uint64_t frame);

}  // namespace hypermap
