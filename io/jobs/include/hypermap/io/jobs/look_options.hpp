// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// At which frames of a sequence a network looks.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <array>
#include <cstddef>
#include <string_view>

namespace hypermap {

struct OptionTable;

enum class LookRule {
  kEvery,      ///< Every N-th frame of the input.
  kKeyframes,  ///< Frames that add a view, and one after a while without any.
};

inline constexpr std::array<std::string_view, 2> kLookRuleNames{"every", "keyframes"};

struct LookOptions {
  LookRule rule = LookRule::kEvery;
  std::size_t every = 1;  ///< With rule every: 1 is each frame. 1 .. 1,000,000
  /// A view is another one that is farther from each earlier one of this run than this,
  double min_distance_m = 0.15;  ///< 0 .. 100
  double min_angle_rad = 0.2;    ///< or turned against it by more than this. 0 .. 3.1416
  /// With keyframes: the network looks too when it did not for so many frames, so that what has
  /// gone is missed. 1 .. 1,000,000
  std::size_t max_gap_frames = 15;
};

/// Errors: kInvalidArgument naming the field; `every` together with keyframes.
[[nodiscard]] Result<void> validate(const LookOptions& options);
[[nodiscard]] const OptionTable& option_table(const LookOptions& options);

}  // namespace hypermap
