// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/semantic_yaml.hpp"

#include "hypermap/io/codec/byte_source.hpp"
#include "semantic_entry.hpp"

#include <algorithm>
#include <set>

namespace hypermap {
namespace {

Result<void> assign_ids(std::vector<SemanticEntry>& entries, const std::vector<YamlNode>& nodes) {
  std::set<std::uint64_t> taken;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const bool is_new = !entries[i].has_id || taken.insert(entries[i].object.id).second;
    if (is_new) continue;
    return tl::make_unexpected(
        with_object_name(nodes[i].at("id")->error("is " + std::to_string(entries[i].object.id) +
                                                  ", which another entry bears"),
                         nodes[i]));
  }
  std::uint64_t next = 0;
  for (SemanticEntry& entry : entries) {
    if (entry.has_id) continue;
    while (taken.contains(next)) ++next;
    entry.object.id = next++;
  }
  return {};
}

/// Entries that were read, with their places in the document.
struct Collected {
  std::vector<SemanticEntry> entries;
  std::vector<YamlNode> nodes;
  std::vector<Finding> findings;
};

Result<Collected> collect(const std::vector<YamlNode>& items,
                          const SemanticReadOptions& options,
                          const LoadBudget& budget,
                          const SourceName& source) {
  Collected out;
  ShapeRepairs repairs;
  for (const YamlNode& node : items) {
    HYPERMAP_TRY(budget.check_stop());
    auto entry = parse_semantic_entry(node, options.wkt, budget);
    if (!entry) {
      Error error = with_object_name(std::move(entry).error(), node);
      const bool may_skip = options.skip_bad && error.code != ErrorCode::kInterrupted;
      if (!may_skip) return tl::make_unexpected(std::move(error));
      out.findings.push_back({Severity::kError, std::move(error)});
      continue;
    }
    repairs += entry->repairs;
    const std::vector<Finding> unknown = unknown_object_keys(node);
    out.findings.insert(out.findings.end(), unknown.begin(), unknown.end());
    out.entries.push_back(*std::move(entry));
    out.nodes.push_back(node);
  }
  const std::vector<Finding> mended = repair_findings(repairs, source);
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
  for (SemanticEntry& entry : collected.entries) objects.push_back(std::move(entry.object));
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
