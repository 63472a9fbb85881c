// SPDX-License-Identifier: BSD-3-Clause
#include "detector_line.hpp"

#include "hypermap/io/codec/json_fields.hpp"
#include "hypermap/io/codec/json_text.hpp"

#include <vector>

namespace hypermap {
namespace {

constexpr std::string_view kDetectorKey = "detector";

Result<std::string> text_of_node(const JsonNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view text, node.string());
  return std::string(text);
}

Result<std::string> text_at(const JsonNode& object, std::string_view key) {
  const auto node = object.find(key);
  return node ? text_of_node(*node) : Result<std::string>(std::string());
}

Result<DetectorDescription> parse_detector(const JsonNode& node) {
  HYPERMAP_TRY(expect_keys(node, {"name"}, {"type", "architecture", "classes"}));
  DetectorDescription detector;
  HYPERMAP_ASSIGN_OR_RETURN(detector.name, text_at(node, "name"));
  HYPERMAP_ASSIGN_OR_RETURN(detector.type, text_at(node, "type"));
  HYPERMAP_ASSIGN_OR_RETURN(detector.architecture, text_at(node, "architecture"));
  if (const auto classes = node.find("classes")) {
    HYPERMAP_ASSIGN_OR_RETURN(detector.classes, list_of(*classes, text_of_node));
  }
  const auto valid = validate(detector);
  if (valid) return detector;
  return node.error(
      valid.error().code == ErrorCode::kLimit ? ErrorCode::kLimit : ErrorCode::kMalformedFile,
      valid.error().field + " " + valid.error().what);
}

}  // namespace

bool is_detector_line(const JsonNode& object) {
  return object.is(JsonKind::kObject) && object.find(kDetectorKey) && !object.find("detections");
}

bool is_detector_line(std::string_view line) {
  const auto document = JsonDocument::parse(line, "");
  return document && is_detector_line(document->root());
}

Result<void> parse_detector_line(const JsonNode& line, DetectionSetBuilder& builder) {
  if (builder.has_begun()) {
    return line.error(ErrorCode::kMalformedFile,
                      "the detector must be named once, before the first image");
  }
  HYPERMAP_TRY(expect_keys(line, {kDetectorKey}));
  return parse_detector_key(line, builder);
}

Result<void> parse_detector_key(const JsonNode& object, DetectionSetBuilder& builder) {
  const auto node = object.find(kDetectorKey);
  if (!node) return {};
  HYPERMAP_ASSIGN_OR_RETURN(DetectorDescription detector, parse_detector(*node));
  builder.set_detector(std::move(detector));
  return {};
}

std::string detector_line(const DetectorDescription& detector) {
  if (detector.name.empty()) return {};
  std::string text = "{\"name\":" + json_quoted(detector.name);
  if (!detector.type.empty()) text += ",\"type\":" + json_quoted(detector.type);
  if (!detector.architecture.empty()) {
    text += ",\"architecture\":" + json_quoted(detector.architecture);
  }
  if (!detector.classes.empty()) {
    text += ",\"classes\":" +
            json_array(detector.classes, [](const std::string& name) { return json_quoted(name); });
  }
  return json_object({{kDetectorKey, text + "}"}}) + "\n";
}

}  // namespace hypermap
