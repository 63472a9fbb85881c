// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The line that stands before the images in JSON lines of ours, so that a file that was cut or
/// changed does not pass for a sequence in which less was detected.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/bounded_json.hpp"

#include <string_view>

namespace hypermap {

/// The newest version that is read, and the one that is written.
inline constexpr int kDetectionsVersion = 1;

/// Whether an object is a head and not what was detected in an image.
[[nodiscard]] bool is_detections_head(const JsonNode& object);

/// Whether the `lines` after a head are those of which it was written.
/// Errors: kMalformedFile when their number or checksum is another, or a key is missing or unknown;
/// kUnsupported "written by a newer version N".
[[nodiscard]] Result<void> check_detections_head(const JsonNode& head, std::string_view lines);

}  // namespace hypermap
