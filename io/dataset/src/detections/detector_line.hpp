// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The line of JSON lines that says whose words they are, before those of the images:
/// `{"detector": {"name": "yolo", "type": "detection", "architecture": "YOLOX", "classes":
/// [...]}}`.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/detector_registry.hpp"
#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/dataset/detections_parsing.hpp"

#include <string>
#include <string_view>

namespace hypermap {

/// Whether an object is such a line and not what was detected in an image, which may have a key of
/// that name as well.
[[nodiscard]] bool is_detector_line(const JsonNode& object);
/// The same of a line's text; false for what is no JSON.
[[nodiscard]] bool is_detector_line(std::string_view line);

/// Errors: kMalformedFile for a second one, for one behind an image, for a key that is unknown or
/// missing, and for what `validate(DetectorDescription)` refuses.
[[nodiscard]] Result<void> parse_detector_line(const JsonNode& line, DetectionSetBuilder& builder);

/// The same of the key `detector` of an object that has others beside it; one without says nothing.
/// Errors: kMalformedFile as parse_detector_line.
[[nodiscard]] Result<void> parse_detector_key(const JsonNode& object, DetectionSetBuilder& builder);

/// Such a line, its end included; nothing for a detector without a name.
[[nodiscard]] std::string detector_line(const DetectorDescription& detector);

}  // namespace hypermap
