// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/combiner/combiner_file.hpp"

#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/json_fields.hpp"
#include "hypermap/io/codec/json_text.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::string_view kCombinerFormat = "hypermap-combiner";
constexpr std::int32_t kCombinerVersion = 1;
constexpr std::size_t kMaxCombinerBytes = std::size_t{16} << 20U;

Result<void> check_head(const JsonNode& root) {
  const auto format = root.find("format");
  const bool is_combiner = format && format->string() == kCombinerFormat;
  if (!is_combiner) {
    return (format ? *format : root)
        .error(ErrorCode::kMalformedFile,
               "is no combiner of detectors, whose \"format\" is \"" +
                   std::string(kCombinerFormat) + "\"");
  }
  HYPERMAP_ASSIGN_OR_RETURN(const auto version, integer_at<std::int32_t>(root, "version"));
  if (version > kCombinerVersion) {
    return root.error(ErrorCode::kUnsupported,
                      "written by a newer version " + std::to_string(version) +
                          ", the newest that is read here is 1");
  }
  if (version == kCombinerVersion) return {};
  return root.error(ErrorCode::kMalformedFile, "expected version 1");
}

Result<std::string> owned_text(const JsonNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view text, node.string());
  return std::string(text);
}

Result<CombinedDetector> parse_combined_detector(const JsonNode& node) {
  HYPERMAP_TRY(expect_keys(node, {"name", "classes"}));
  CombinedDetector detector;
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode name, node.require("name"));
  HYPERMAP_ASSIGN_OR_RETURN(detector.name, owned_text(name));
  HYPERMAP_ASSIGN_OR_RETURN(detector.classes, list_at(node, "classes", owned_text));
  return detector;
}

Result<OneAgainstAll> parse_rule(const JsonNode& node) {
  HYPERMAP_TRY(expect_keys(node, {"name", "offset", "weights"}, {"share"}));
  OneAgainstAll rule;
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode name, node.require("name"));
  HYPERMAP_ASSIGN_OR_RETURN(rule.class_name, owned_text(name));
  HYPERMAP_ASSIGN_OR_RETURN(rule.offset, number_at(node, "offset"));
  HYPERMAP_ASSIGN_OR_RETURN(
      rule.weights, list_at(node, "weights", [](const JsonNode& one) { return one.number(); }));
  if (const auto share = node.find("share")) {
    HYPERMAP_ASSIGN_OR_RETURN(rule.share, share->number());
  }
  return rule;
}

}  // namespace

Result<CombinerModel> parse_combiner(std::string_view text, const std::string& name) {
  HYPERMAP_ASSIGN_OR_RETURN(const JsonDocument document,
                            JsonDocument::parse(text, name, {.max_bytes = kMaxCombinerBytes}));
  const JsonNode root = document.root();
  HYPERMAP_TRY(check_head(root));
  HYPERMAP_TRY(expect_keys(root, {"format", "version", "detectors", "classes"}));
  CombinerModel model;
  HYPERMAP_ASSIGN_OR_RETURN(model.detectors, list_at(root, "detectors", parse_combined_detector));
  HYPERMAP_ASSIGN_OR_RETURN(model.classes, list_at(root, "classes", parse_rule));
  if (const auto valid = validate(model); !valid) {
    const Error& error = valid.error();
    return root.error(
        error.code == ErrorCode::kLimit ? ErrorCode::kLimit : ErrorCode::kMalformedFile,
        error.field + " " + error.what);
  }
  return model;
}

Result<CombinerModel> read_combiner(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, read_file(path, kMaxCombinerBytes));
  return parse_combiner(text, path.string());
}

std::string write_combiner(const CombinerModel& model) {
  const auto quoted = [](const std::string& name) { return json_quoted(name); };
  const auto number = [](double value) { return json_number(value); };
  return json_object(
             {{"format", json_quoted(kCombinerFormat)},
              {"version", std::to_string(kCombinerVersion)},
              {"detectors",
               json_array(model.detectors,
                          [&](const CombinedDetector& detector) {
                            return json_object({{"name", json_quoted(detector.name)},
                                                {"classes", json_array(detector.classes, quoted)}});
                          })},
              {"classes",
               json_array(model.classes,
                          [&](const OneAgainstAll& rule) {
                            return json_object({{"name", json_quoted(rule.class_name)},
                                                {"offset", json_number(rule.offset)},
                                                {"weights", json_array(rule.weights, number)},
                                                {"share", json_number(rule.share)}});
                          })}}) +
         "\n";
}

}  // namespace hypermap
