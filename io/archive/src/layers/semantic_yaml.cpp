// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/semantic_yaml.hpp"

#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/value_keys.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <set>

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

/// An object whose id is not settled yet.
struct Entry {
  SemanticObject object;
  bool has_id = false;
};

/// What is counted over all entries.
struct Repairs {
  std::size_t unclosed_rings = 0;
  std::size_t wound_rings = 0;
  std::size_t spiked_rings = 0;
  std::size_t missing_commas = 0;
};

Result<std::string> name_at(const YamlNode& node) {
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

Result<WktShape> shape_at(const YamlNode& node,
                          std::string& text,
                          const WktLimits& limits,
                          const LoadBudget& budget) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode field, node.at("shape"));
  HYPERMAP_ASSIGN_OR_RETURN(text, field.as_string());
  auto shape = read_wkt(text, limits, budget);
  if (!shape) return tl::make_unexpected(field.error(shape.error().what, shape.error().code));
  return shape;
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

Result<std::vector<double>> confidence_at(const YamlNode& node, std::size_t num_tags) {
  const auto field = node.find("confidence");
  if (!field || field->is_null()) return std::vector<double>();
  if (field->is_scalar()) {
    HYPERMAP_ASSIGN_OR_RETURN(const double confidence, field->as_double(0, 1));
    return std::vector<double>{confidence};
  }
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> items, field->as_list());
  if (items.size() != num_tags) {
    return tl::make_unexpected(field->error("has " + std::to_string(items.size()) + " values for " +
                                            std::to_string(num_tags) +
                                            " tags, expected one for each"));
  }
  std::vector<double> confidences;
  for (const YamlNode& item : items) {
    HYPERMAP_ASSIGN_OR_RETURN(const double confidence, item.as_double(0, 1));
    confidences.push_back(confidence);
  }
  return confidences;
}

Result<Entry> parse_object_entry(const YamlNode& node,
                                 const WktLimits& limits,
                                 const LoadBudget& budget,
                                 Repairs& repairs) {
  Entry entry;
  SemanticObject& object = entry.object;
  HYPERMAP_ASSIGN_OR_RETURN(object.name, name_at(node));
  HYPERMAP_ASSIGN_OR_RETURN(WktShape shape, shape_at(node, object.shape_text, limits, budget));
  HYPERMAP_ASSIGN_OR_RETURN(object.tags, tags_at(node));
  HYPERMAP_ASSIGN_OR_RETURN(object.confidence, confidence_at(node, object.tags.size()));
  if (const auto id = node.find("id")) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t value,
                              id->as_int(0, std::numeric_limits<std::int64_t>::max()));
    object.id = static_cast<std::uint64_t>(value);
    entry.has_id = true;
  }
  repairs.unclosed_rings += shape.unclosed_rings;
  repairs.wound_rings += shape.wound_rings;
  repairs.spiked_rings += shape.spiked_rings;
  repairs.missing_commas += shape.missing_commas;
  object.parts = std::move(shape.parts);
  if (object.shape_text == write_wkt(object.parts)) object.shape_text.clear();
  object.extra = other_keys(node.value(), kObjectKeys);
  return entry;
}

/// "[3].shape" becomes "[3] (chair).shape", so that a person finds the entry.
Error with_name(Error error, const YamlNode& node) {
  const auto name = node.find("name");
  if (!name || !name->is_scalar()) return error;
  const std::size_t end = node.path().size();
  error.field.insert(end, " (" + printable(name->value().text, 40) + ")");
  return error;
}

Result<void> assign_ids(std::vector<Entry>& entries, const std::vector<YamlNode>& nodes) {
  std::set<std::uint64_t> taken;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const bool is_new = !entries[i].has_id || taken.insert(entries[i].object.id).second;
    if (is_new) continue;
    return tl::make_unexpected(
        with_name(nodes[i].at("id")->error("is " + std::to_string(entries[i].object.id) +
                                           ", which another entry bears"),
                  nodes[i]));
  }
  std::uint64_t next = 0;
  for (Entry& entry : entries) {
    if (entry.has_id) continue;
    while (taken.contains(next)) ++next;
    entry.object.id = next++;
  }
  return {};
}

std::vector<Finding> findings_of(const Repairs& repairs, const SourceName& source) {
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

/// Entries that were read, with their places in the document.
struct Collected {
  std::vector<Entry> entries;
  std::vector<YamlNode> nodes;
  std::vector<Finding> findings;
};

Result<Collected> collect(const std::vector<YamlNode>& items,
                          const SemanticReadOptions& options,
                          const LoadBudget& budget,
                          const SourceName& source) {
  Collected out;
  Repairs repairs;
  for (const YamlNode& node : items) {
    HYPERMAP_TRY(budget.check_stop());
    auto entry = parse_object_entry(node, options.wkt, budget, repairs);
    if (!entry) {
      Error error = with_name(std::move(entry).error(), node);
      const bool may_skip = options.skip_bad && error.code != ErrorCode::kInterrupted;
      if (!may_skip) return tl::make_unexpected(std::move(error));
      out.findings.push_back({Severity::kError, std::move(error)});
      continue;
    }
    const std::vector<Finding> unknown = node.unknown_keys(kExpectedKeys);
    out.findings.insert(out.findings.end(), unknown.begin(), unknown.end());
    out.entries.push_back(*std::move(entry));
    out.nodes.push_back(node);
  }
  const std::vector<Finding> mended = findings_of(repairs, source);
  out.findings.insert(out.findings.end(), mended.begin(), mended.end());
  return out;
}

Result<Loaded<SemanticLayer>> read_entries(const YamlNode& root,
                                           const SemanticReadOptions& options,
                                           const LoadBudget& budget,
                                           const SourceName& source) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> items, root.as_list());
  if (items.size() > SemanticLayer::kMaxObjects) {
    return tl::make_unexpected(root.error("has more than 10^6 objects", ErrorCode::kLimit));
  }
  HYPERMAP_ASSIGN_OR_RETURN(Collected collected, collect(items, options, budget, source));
  HYPERMAP_TRY(assign_ids(collected.entries, collected.nodes));
  std::vector<SemanticObject> objects;
  for (Entry& entry : collected.entries) objects.push_back(std::move(entry.object));
  auto layer = SemanticLayer::create(std::move(objects));
  if (!layer) return tl::make_unexpected(with_source(layer.error(), source));
  return Loaded<SemanticLayer>{*std::move(layer), std::move(collected.findings)};
}

ValueTree list_or_nothing(std::vector<ValueTree> items) {
  return items.empty() ? ValueTree{} : make_list(std::move(items));
}

ValueTree tags_of(const SemanticObject& object) {
  std::vector<ValueTree> items;
  for (const std::string& tag : object.tags) items.push_back(make_text(tag));
  return list_or_nothing(std::move(items));
}

ValueTree confidence_tree(const SemanticObject& object) {
  const bool is_for_object = object.confidence.size() == 1 && object.tags.size() != 1;
  if (is_for_object) return make_number(object.confidence.front());
  std::vector<ValueTree> items;
  for (const double confidence : object.confidence) items.push_back(make_number(confidence));
  return list_or_nothing(std::move(items));
}

/// As the file wrote it, while that still stands for the shape.
std::string shape_text_of(const SemanticObject& object) {
  if (!object.shape_text.empty()) {
    const auto shape = read_wkt(object.shape_text);
    if (shape && shape->parts == object.parts) return object.shape_text;
  }
  return write_wkt(object.parts);
}

bool needs_ids(const SemanticLayer& layer) {
  std::uint64_t expected = 0;
  return std::any_of(layer.objects().begin(),
                     layer.objects().end(),
                     [&](const SemanticObject& object) { return object.id != expected++; });
}

}  // namespace

Result<Loaded<SemanticLayer>> parse_semantic_layer(std::string_view yaml,
                                                   const SourceName& source,
                                                   const SemanticReadOptions& options,
                                                   const LoadBudget& budget) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, parse_yaml(yaml, source, options.yaml));
  return read_entries(document.root(), options, budget, source);
}

Result<Loaded<SemanticLayer>> read_semantic_layer(const std::filesystem::path& path,
                                                  const SemanticReadOptions& options,
                                                  const LoadBudget& budget) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, read_file(path, options.yaml.max_bytes));
  return parse_semantic_layer(bytes, {.file = path.string()}, options, budget);
}

std::string write_semantic_layer(const SemanticLayer& layer) {
  const bool with_ids = needs_ids(layer);
  std::vector<ValueTree> items;
  for (const SemanticObject& object : layer.objects()) {
    std::vector<ValueTree::Entry> entries = {{"name", make_text(object.name)},
                                             {"shape", make_text(shape_text_of(object))},
                                             {"tags", tags_of(object)},
                                             {"confidence", confidence_tree(object)}};
    if (with_ids) {
      entries.emplace_back(
          "id", ValueTree{.kind = ValueKind::kScalar, .text = std::to_string(object.id)});
    }
    entries.insert(entries.end(), object.extra.entries.begin(), object.extra.entries.end());
    items.push_back(make_map(std::move(entries)));
  }
  return write_yaml(make_list(std::move(items)));
}

}  // namespace hypermap
