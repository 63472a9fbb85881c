// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/class_sizes.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/number_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace hypermap {
namespace {

constexpr double kMostLengthM = 100.0;
constexpr double kNoiseM = 0.03;
/// Of the logarithm of a length beyond its range: ln 1.25.
constexpr double kTailSpread = 0.22314355131420976;

using NamedRange = std::pair<const char*, std::optional<LengthRange> ClassSize::*>;
constexpr std::array<NamedRange, 3> kLengths{{{"longer", &ClassSize::longer},
                                              {"shorter", &ClassSize::shorter},
                                              {"height", &ClassSize::height}}};

Result<void> check_range(const std::string& field, const LengthRange& range) {
  const bool is_valid =
      range.least_m > 0.0 && range.least_m <= range.most_m && range.most_m <= kMostLengthM;
  if (is_valid) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be two ascending lengths above 0 and at most " + number_text(kMostLengthM) +
                  " m, is [" + number_text(range.least_m) + ", " + number_text(range.most_m) + "]",
              field);
}

/// By how much a length leaves the range, as a ratio; 1 or less within it.
double excess(const LengthRange& range, double length_m, bool is_seen_whole) {
  const double too_large = (length_m - kNoiseM) / range.most_m;
  if (!is_seen_whole) return too_large;
  return std::max(too_large, range.least_m / (length_m + kNoiseM));
}

}  // namespace

Result<void> validate(const ClassSizes& sizes) {
  for (const auto& [name, size] : sizes) {
    const std::string field = "sizes." + printable(name);
    if (canonical_class_name(name) != name) {
      return fail(ErrorCode::kInvalidArgument,
                  "must be the canonical name \"" + canonical_class_name(name) + "\"",
                  field);
    }
    if (size == ClassSize{}) {
      return fail(ErrorCode::kInvalidArgument, "must have longer, shorter or height", field);
    }
    for (const auto& [length, range] : kLengths) {
      if (!(size.*range)) continue;
      std::string of_length = field;
      of_length.append(".").append(length);
      HYPERMAP_TRY(check_range(of_length, *(size.*range)));
    }
  }
  return {};
}

double size_log_factor(const ClassSize& size, const Eigen::Vector3d& extent_m, bool is_seen_whole) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kLengths.size(); ++i) {
    const std::optional<LengthRange>& range = size.*kLengths[i].second;
    if (!range) continue;
    const double ratio = excess(*range, extent_m[static_cast<Eigen::Index>(i)], is_seen_whole);
    if (!(ratio > 1.0)) continue;
    const double spreads = std::log(ratio) / kTailSpread;
    sum -= 0.5 * spreads * spreads;
  }
  return sum;
}

}  // namespace hypermap
