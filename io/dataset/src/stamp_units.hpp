// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Units of stamps: nanoseconds of seconds, and whether images and poses have stamps of two units.
#pragma once

#include "hypermap/io/dataset/trajectory_file.hpp"
#include "sequence_index.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hypermap {

[[nodiscard]] std::int64_t nanoseconds(double seconds);
/// "0.02 s"
[[nodiscard]] std::string seconds_text(double seconds);

/// What is said when fewer than half of the images, or of the poses where there are fewer of these,
/// find each other, and at least half would if one side were in milli-, micro- or nanoseconds where
/// the other is in seconds; else none.
[[nodiscard]] std::optional<std::string> stamps_of_two_units(std::span<const SequenceEntry> entries,
                                                             std::span<const StampedPose> poses,
                                                             std::int64_t tolerance_ns);

}  // namespace hypermap
