// SPDX-License-Identifier: BSD-3-Clause
#include "semantic_entry.hpp"

#include "hypermap/io/codec/value_keys.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 5> kObjectKeys = {
    "name", "shape", "tags", "confidence", "id"};
/// Also what a simulation's truth says of an object (simulation_truth.hpp, true_changes.hpp), kept
/// like an unknown key.
constexpr std::array<std::string_view, 14> kExpectedKeys = {"name",
                                                            "shape",
                                                            "tags",
                                                            "confidence",
                                                            "id",
                                                            "thing",
                                                            "box",
                                                            "excluded",
                                                            "frames_named",
                                                            "seen_footprint",
                                                            "stands_on",
                                                            "nameable",
                                                            "change",
                                                            "at_end"};
constexpr std::size_t kMaxTags = 256;

Result<std::string> object_name_at(const YamlNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode field, node.at("name"));
  HYPERMAP_ASSIGN_OR_RETURN(std::string name, field.as_string());
  if (name.empty()) return tl::make_unexpected(field.error("is empty, expected a name"));
  if (name.size() > SemanticLayer::kMaxNameBytes) {
    return tl::make_unexpected(
        field.error("has " + std::to_string(name.size()) + " bytes, the limit for a name is 256",
                    ErrorCode::kLimit));
  }
  return name;
}

/// A shape and how the file wrote it: empty when that is how it is written here.
struct TextShape {
  std::vector<Polygon> parts;
  std::string text;
  ShapeRepairs repairs;
};

Result<TextShape> shape_at(const YamlNode& node,
                           const WktLimits& limits,
                           const LoadBudget& budget) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode field, node.at("shape"));
  HYPERMAP_ASSIGN_OR_RETURN(std::string text, field.as_string());
  auto shape = read_wkt(text, limits, budget);
  if (!shape) return tl::make_unexpected(field.error(shape.error().what, shape.error().code));
  if (text == write_wkt(shape->parts)) text.clear();
  return TextShape{std::move(shape->parts),
                   std::move(text),
                   {.unclosed_rings = shape->unclosed_rings,
                    .wound_rings = shape->wound_rings,
                    .spiked_rings = shape->spiked_rings,
                    .missing_commas = shape->missing_commas}};
}

Result<std::vector<std::string>> tags_at(const YamlNode& node) {
  std::vector<std::string> tags;
  const auto field = node.find("tags");
  if (!field || field->is_null()) return tags;
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> items, field->as_list());
  if (items.size() > kMaxTags) {
    return tl::make_unexpected(field->error("has more than 256 tags", ErrorCode::kLimit));
  }
  for (const YamlNode& item : items) {
    HYPERMAP_ASSIGN_OR_RETURN(std::string tag, item.as_string());
    tags.push_back(std::move(tag));
  }
  return tags;
}

/// `num_tags` is none where the tags stand elsewhere.
Result<std::vector<double>> confidence_at(const YamlNode& node,
                                          std::optional<std::size_t> num_tags) {
  const auto field = node.find("confidence");
  if (!field || field->is_null()) return std::vector<double>();
  if (field->is_scalar()) {
    HYPERMAP_ASSIGN_OR_RETURN(const double confidence, field->as_double(0, 1));
    return std::vector<double>{confidence};
  }
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> items, field->as_list());
  if (items.size() != num_tags.value_or(std::min(items.size(), kMaxTags))) {
    return tl::make_unexpected(field->error("has " + std::to_string(items.size()) + " values for " +
                                            std::to_string(num_tags.value_or(kMaxTags)) +
                                            " tags, expected one for each"));
  }
  std::vector<double> confidences;
  for (const YamlNode& item : items) {
    HYPERMAP_ASSIGN_OR_RETURN(const double confidence, item.as_double(0, 1));
    confidences.push_back(confidence);
  }
  return confidences;
}

Result<std::uint64_t> object_id_at(const YamlNode& field) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t value,
                            field.as_int(0, std::numeric_limits<std::int64_t>::max()));
  return static_cast<std::uint64_t>(value);
}

}  // namespace

ShapeRepairs& ShapeRepairs::operator+=(const ShapeRepairs& more) {
  unclosed_rings += more.unclosed_rings;
  wound_rings += more.wound_rings;
  spiked_rings += more.spiked_rings;
  missing_commas += more.missing_commas;
  return *this;
}

Result<SemanticEntry> parse_semantic_entry(const YamlNode& node,
                                           const WktLimits& limits,
                                           const LoadBudget& budget) {
  SemanticEntry entry;
  SemanticObject& object = entry.object;
  HYPERMAP_ASSIGN_OR_RETURN(object.name, object_name_at(node));
  HYPERMAP_ASSIGN_OR_RETURN(TextShape shape, shape_at(node, limits, budget));
  HYPERMAP_ASSIGN_OR_RETURN(object.tags, tags_at(node));
  HYPERMAP_ASSIGN_OR_RETURN(object.confidence, confidence_at(node, object.tags.size()));
  if (const auto id = node.find("id")) {
    HYPERMAP_ASSIGN_OR_RETURN(object.id, object_id_at(*id));
    entry.has_id = true;
  }
  object.parts = std::move(shape.parts);
  object.shape_text = std::move(shape.text);
  object.extra = other_keys(node.value(), kObjectKeys);
  entry.repairs = shape.repairs;
  return entry;
}

Result<ModificationEntry> parse_modification_entry(const YamlNode& node,
                                                   const WktLimits& limits,
                                                   const LoadBudget& budget) {
  ModificationEntry entry;
  SemanticModification& change = entry.modification;
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode id, node.at("id"));
  HYPERMAP_ASSIGN_OR_RETURN(change.id, object_id_at(id));
  if (node.value().entries.size() == 1) {
    return tl::make_unexpected(node.error("has no key beside id, so nothing would change"));
  }
  if (node.find("name")) {
    HYPERMAP_ASSIGN_OR_RETURN(change.name, object_name_at(node));
  }
  if (node.find("shape")) {
    HYPERMAP_ASSIGN_OR_RETURN(TextShape shape, shape_at(node, limits, budget));
    change.parts = std::move(shape.parts);
    change.shape_text = std::move(shape.text);
    entry.repairs = shape.repairs;
  }
  std::optional<std::size_t> num_tags;
  if (node.find("tags")) {
    HYPERMAP_ASSIGN_OR_RETURN(change.tags, tags_at(node));
    num_tags = change.tags->size();
  }
  if (node.find("confidence")) {
    HYPERMAP_ASSIGN_OR_RETURN(change.confidence, confidence_at(node, num_tags));
  }
  change.extra = other_keys(node.value(), kObjectKeys);
  return entry;
}

Error with_object_name(Error error, const YamlNode& node) {
  const auto name = node.find("name");
  if (!name || !name->is_scalar()) return error;
  const std::size_t end = node.path().size();
  error.field.insert(end, " (" + printable(name->value().text, 40) + ")");
  return error;
}

std::vector<Finding> unknown_object_keys(const YamlNode& node) {
  return node.unknown_keys(kExpectedKeys);
}

std::vector<Finding> repair_findings(const ShapeRepairs& repairs, const SourceName& source) {
  std::vector<Finding> findings;
  const auto add = [&](std::size_t count, const std::string& what) {
    if (count == 0) return;
    Error error{
        .code = ErrorCode::kMalformedFile, .what = std::to_string(count) + what, .field = "shape"};
    findings.push_back({Severity::kWarning, with_source(std::move(error), source)});
  };
  add(repairs.unclosed_rings, " rings did not repeat their first point, read as closed");
  add(repairs.missing_commas, " commas between two points were missing, read as there");
  add(repairs.wound_rings,
      " rings are wound more than once, read as the area of their non-zero winding");
  add(repairs.spiked_rings, " rings have spikes, which enclose nothing, read without them");
  return findings;
}

}  // namespace hypermap
