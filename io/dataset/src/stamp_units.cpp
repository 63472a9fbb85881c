// SPDX-License-Identifier: BSD-3-Clause
#include "stamp_units.hpp"

#include "hypermap/io/codec/text_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace hypermap {
namespace {

struct UnitOfStamps {
  double seconds = 1.0;
  std::string_view name;
};
constexpr std::array<UnitOfStamps, 3> kUnits{
    {{1e-9, "nanoseconds"}, {1e-6, "microseconds"}, {1e-3, "milliseconds"}}};
constexpr double kMaxStampNs = 9e18;

/// The poses' stamps times `factor`; those that no stamp can hold are left out.
std::vector<Stamp> scaled(std::span<const StampedPose> poses, double factor) {
  std::vector<Stamp> stamps;
  stamps.reserve(poses.size());
  for (const StampedPose& pose : poses) {
    const double ns = static_cast<double>(pose.stamp.ns) * factor;
    if (std::abs(ns) < kMaxStampNs) stamps.push_back({std::llround(ns)});
  }
  return stamps;
}

/// Whether at least half of the images, or of the stamps where there are fewer of these, find each
/// other.
bool fit(std::span<const SequenceEntry> entries,
         const std::vector<Stamp>& stamps,
         std::int64_t tolerance_ns) {
  const auto paired = std::count_if(entries.begin(), entries.end(), [&](const auto& entry) {
    return nearest_stamp(stamps, entry.stamp, tolerance_ns, [](Stamp s) { return s; }).has_value();
  });
  return paired >= 2 &&
         2 * static_cast<std::size_t>(paired) >= std::min(entries.size(), stamps.size());
}

}  // namespace

std::int64_t nanoseconds(double seconds) {
  return std::llround(seconds * 1e9);
}

std::string seconds_text(double seconds) {
  return stamp_text({nanoseconds(seconds)}) + " s";
}

std::optional<std::string> stamps_of_two_units(std::span<const SequenceEntry> entries,
                                               std::span<const StampedPose> poses,
                                               std::int64_t tolerance_ns) {
  if (fit(entries, scaled(poses, 1.0), tolerance_ns)) return std::nullopt;
  for (const UnitOfStamps& unit : kUnits) {
    const std::string name(unit.name);
    if (fit(entries, scaled(poses, unit.seconds), tolerance_ns)) {
      return "fits the images when its stamps are taken as " + name +
             ", theirs as seconds: both must be in one unit";
    }
    if (fit(entries, scaled(poses, 1.0 / unit.seconds), tolerance_ns)) {
      return "fits the images when theirs are taken as " + name +
             ", its stamps as seconds: both must be in one unit";
    }
  }
  return std::nullopt;
}

}  // namespace hypermap
