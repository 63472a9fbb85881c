// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/semantic_update_file.hpp"

#include "hypermap/io/codec/byte_source.hpp"
#include "semantic_entry.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 3> kUpdateKeys = {"add", "modify", "delete"};

/// The items of a list that may be missing. Errors: kLimit for more than a layer holds.
Result<std::vector<YamlNode>> items_at(const YamlNode& root, std::string_view key) {
  const auto list = root.find(key);
  if (!list || list->is_null()) return std::vector<YamlNode>();
  HYPERMAP_ASSIGN_OR_RETURN(std::vector<YamlNode> items, list->as_list());
  if (items.size() > SemanticLayer::kMaxObjects)
    return tl::make_unexpected(list->error("has more than 10^6 objects", ErrorCode::kLimit));
  return items;
}

/// An update, read list by list.
class UpdateReader {
 public:
  UpdateReader(const SemanticReadOptions& options, const LoadBudget& budget)
      : options_(options), budget_(budget) {}

  Result<Loaded<SemanticUpdate>> read(const YamlNode& root, const SourceName& source) {
    HYPERMAP_TRY(root.refuse_other_keys(kUpdateKeys, ErrorCode::kMalformedFile));
    if (root.value().entries.empty())
      return tl::make_unexpected(root.error("has none of the keys add, modify and delete"));
    HYPERMAP_TRY(read_added(root));
    HYPERMAP_TRY(read_modified(root));
    HYPERMAP_TRY(read_deleted(root));
    const std::vector<Finding> mended = repair_findings(repairs_, source);
    loaded_.findings.insert(loaded_.findings.end(), mended.begin(), mended.end());
    return std::move(loaded_);
  }

 private:
  Result<void> read_added(const YamlNode& root) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> items, items_at(root, "add"));
    for (const YamlNode& node : items) {
      HYPERMAP_TRY(budget_.check_stop());
      auto entry = parse_semantic_entry(node, options_.wkt, budget_);
      if (!entry) return tl::make_unexpected(with_object_name(entry.error(), node));
      remark(node, entry->repairs);
      if (entry->repairs != ShapeRepairs{}) entry->object.shape_text.clear();  // said once
      auto& added = entry->has_id ? loaded_.value.to_add : loaded_.value.to_number;
      added.push_back(std::move(entry->object));
    }
    return {};
  }

  Result<void> read_modified(const YamlNode& root) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> items, items_at(root, "modify"));
    for (const YamlNode& node : items) {
      HYPERMAP_TRY(budget_.check_stop());
      auto entry = parse_modification_entry(node, options_.wkt, budget_);
      if (!entry) return tl::make_unexpected(with_object_name(entry.error(), node));
      remark(node, entry->repairs);
      if (entry->repairs != ShapeRepairs{}) entry->modification.shape_text.clear();
      loaded_.value.to_modify.push_back(std::move(entry->modification));
    }
    return {};
  }

  Result<void> read_deleted(const YamlNode& root) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> items, items_at(root, "delete"));
    for (const YamlNode& node : items) {
      HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t id,
                                node.as_int(0, std::numeric_limits<std::int64_t>::max()));
      loaded_.value.to_delete.push_back(static_cast<std::uint64_t>(id));
    }
    return {};
  }

  void remark(const YamlNode& node, const ShapeRepairs& repairs) {
    repairs_ += repairs;
    const std::vector<Finding> unknown = unknown_object_keys(node);
    loaded_.findings.insert(loaded_.findings.end(), unknown.begin(), unknown.end());
  }

  const SemanticReadOptions& options_;
  const LoadBudget& budget_;
  ShapeRepairs repairs_;
  Loaded<SemanticUpdate> loaded_;
};

}  // namespace

Result<Loaded<SemanticUpdate>> parse_semantic_update(std::string_view yaml,
                                                     const SourceName& source,
                                                     const SemanticReadOptions& options,
                                                     const LoadBudget& budget) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, parse_yaml(yaml, source, options.yaml));
  return UpdateReader(options, budget).read(document.root(), source);
}

Result<Loaded<SemanticUpdate>> read_semantic_update(const std::filesystem::path& path,
                                                    const SemanticReadOptions& options,
                                                    const LoadBudget& budget) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, read_file(path, options.yaml.max_bytes));
  return parse_semantic_update(bytes, {.file = path.string()}, options, budget);
}

}  // namespace hypermap
