// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How large things of a class are, and what an object's size says against a class.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <Eigen/Core>

#include <functional>
#include <map>
#include <optional>
#include <string>

namespace hypermap {

/// Between which lengths nearly all things lie. Unit: metre. 0 < least_m <= most_m <= 100.
struct LengthRange {
  double least_m = 0.0;
  double most_m = 0.0;
  friend bool operator==(const LengthRange&, const LengthRange&) = default;
};

/// Of a class; a length that is none says nothing.
struct ClassSize {
  /// Sides of the least rectangle around what is seen from above.
  std::optional<LengthRange> longer = std::nullopt;
  std::optional<LengthRange> shorter = std::nullopt;
  std::optional<LengthRange> height = std::nullopt;
  friend bool operator==(const ClassSize&, const ClassSize&) = default;
};

/// By the canonical name of a class.
using ClassSizes = std::map<std::string, ClassSize, std::less<>>;

/// Errors: kInvalidArgument naming `sizes.<class>.<length>` and the rule: a range that is not
/// within (0, 100], ascending; `sizes.<class>` whose name is not canonical or that has no range.
[[nodiscard]] Result<void> validate(const ClassSizes& sizes);

/// The logarithm of how many times less probable an object of this size is than one of the class'
/// usual sizes; 0 or less. Each length that leaves its range by a ratio r, after 3 cm for noise,
/// gives -(ln r / ln 1.25)^2 / 2: the tail of a log-normal distribution.
///
/// `extent_m`: longer and shorter horizontal side, height. Of an object that was not seen whole
/// only what is too large counts: what it lacks may be hidden. Source: [smap] Eq. (3.17), p(x).
[[nodiscard]] double size_log_factor(const ClassSize& size,
                                     const Eigen::Vector3d& extent_m,
                                     bool is_seen_whole);

}  // namespace hypermap
