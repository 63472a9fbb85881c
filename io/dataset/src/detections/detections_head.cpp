// SPDX-License-Identifier: BSD-3-Clause
#include "detections_head.hpp"

#include "detector_line.hpp"
#include "hypermap/io/codec/checksum.hpp"
#include "hypermap/io/codec/json_fields.hpp"
#include "hypermap/io/codec/json_text.hpp"
#include "hypermap/io/codec/text_file.hpp"
#include "hypermap/io/dataset/detections_file.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace hypermap {
namespace {

constexpr std::string_view kDetectionsFormat = "hypermap-detections";

std::uint64_t num_images(std::string_view lines) {
  std::uint64_t count = 0;
  bool has_detector = false;
  for (const TextLine& line : split_lines(lines)) {
    if (trimmed(line.text).empty()) continue;
    if (count++ == 0) has_detector = is_detector_line(line.text);
  }
  return has_detector ? count - 1 : count;
}

Result<void> check_version(const JsonNode& head) {
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode format, head.require("format"));
  HYPERMAP_ASSIGN_OR_RETURN(const auto version, integer_at<std::int32_t>(head, "version"));
  if (version > kDetectionsVersion)
    return head.error(ErrorCode::kUnsupported,
                      "written by a newer version " + std::to_string(version) +
                          ", the newest that is read here is " +
                          std::to_string(kDetectionsVersion));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view name, format.string());
  if (name == kDetectionsFormat && version == kDetectionsVersion) return {};
  return format.error(ErrorCode::kMalformedFile, "expected hypermap-detections of version 1");
}

}  // namespace

bool is_detections_head(const JsonNode& object) {
  return object.is(JsonKind::kObject) && object.find("format");
}

Result<void> check_detections_head(const JsonNode& head, std::string_view lines) {
  HYPERMAP_TRY(check_version(head));
  HYPERMAP_TRY(expect_keys(head, {"format", "version", "num_images", "crc32"}));
  HYPERMAP_ASSIGN_OR_RETURN(const auto said, integer_at<std::uint32_t>(head, "num_images"));
  if (const std::uint64_t there = num_images(lines); there != said)
    return head.error(
        ErrorCode::kMalformedFile,
        "says " + std::to_string(said) + " images, there are " + std::to_string(there));
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode checksum, head.require("crc32"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view text, checksum.string());
  const std::string real = checksum_text(crc32_of(lines));
  if (text == real) return {};
  return checksum.error(ErrorCode::kMalformedFile,
                        "is '" + printable(text, 40) + "', that of the other lines is " + real +
                            ": the file was damaged, or changed without taking the first line out");
}

std::string to_json_lines(std::string_view lines, const DetectorDescription& detector) {
  const std::string rest = detector_line(detector).append(lines);
  std::string text =
      json_object({{"format", json_quoted(kDetectionsFormat)},
                   {"version", std::to_string(kDetectionsVersion)},
                   {"num_images", std::to_string(std::count(lines.begin(), lines.end(), '\n'))},
                   {"crc32", json_quoted(checksum_text(crc32_of(rest)))}});
  return text.append("\n").append(rest);
}

}  // namespace hypermap
