// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How much one observation changes the occupancy of a voxel.
///
/// Source: A. Hornung et al., "OctoMap", Autonomous Robots 34 (2013), Eq. (2), (4) and section 5.1.
/// Deviation: log-odds are whole steps of 0.001 in 16 bits, where OctoMap has 32-bit floats; a
/// voxel whose hits and misses cancel almost exactly (23 misses against 11 hits: -0.005 there,
/// +0.002 here) may be classified differently.
#pragma once

#include "hypermap/core/base/log_odds.hpp"
#include "hypermap/core/base/result.hpp"

#include <cmath>
#include <cstdint>

namespace hypermap {

struct OptionTable;

/// Log-odds in steps of 0.001.
using MilliLogOdds = std::int16_t;

/// Nearest step. Requires: |l| < 32.767.
[[nodiscard]] inline MilliLogOdds to_milli(LogOdds l) noexcept {
  return static_cast<MilliLogOdds>(std::lround(l.value() * 1000.0));
}
[[nodiscard]] constexpr LogOdds from_milli(MilliLogOdds milli) noexcept {
  return LogOdds(milli * 0.001);
}

/// OctoMap's sensor model and its defaults.
struct SensorModelOptions {
  Probability hit{0.7};            ///< Occupied, given that a ray ended in the voxel.
  Probability miss{0.4};           ///< Occupied, given that rays only went through.
  Probability clamp_min{0.1192};   ///< A voxel never becomes freer than this; a change is noticed.
  Probability clamp_max{0.971};    ///< Nor more occupied than this.
  Probability occupied_from{0.5};  ///< Occupied when at least this probable.
  friend bool operator==(const SensorModelOptions&, const SensorModelOptions&) = default;
};

/// Errors: kInvalidArgument naming the field: hits and the upper clamp are above 0.5, misses
/// and the lower clamp below it, and occupied_from lies between the clamps.
[[nodiscard]] Result<void> validate(const SensorModelOptions& options);
[[nodiscard]] const OptionTable& option_table(const SensorModelOptions& options);

/// The same in the units of the voxels.
struct SensorModel {
  MilliLogOdds hit = 847;
  MilliLogOdds miss = -405;
  MilliLogOdds clamp_min = -2000;
  MilliLogOdds clamp_max = 3511;
  MilliLogOdds occupied_from = 0;

  /// Errors: those of `validate`.
  [[nodiscard]] static Result<SensorModel> create(const SensorModelOptions& options);
  friend bool operator==(const SensorModel&, const SensorModel&) = default;
};

}  // namespace hypermap
