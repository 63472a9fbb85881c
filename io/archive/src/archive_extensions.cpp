// SPDX-License-Identifier: BSD-3-Clause
#include "archive_extensions.hpp"

#include "hypermap/io/archive/object_json.hpp"
#include "hypermap/io/archive/octomap_file.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/codec/value_keys.hpp"
#include "layers/layer_files.hpp"
#include "octree/octree_options_keys.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 1> kGridKeys{"class"};

/// Name and file of a new archive's extension.
ExtensionEntry new_entry(std::string_view format) {
  ExtensionEntry entry{.format = std::string(format)};
  if (format == kOctomapFormat) {
    entry.name = "octree";
    entry.file = "octree.ot";
  } else if (format == kOctreeTwinFormat) {
    entry.name = "octree_twin";
    entry.file = "octree.bt";
  } else if (format == kObjectsFormat) {
    entry.name = "objects";
    entry.file = "objects.jsonl";
  } else if (format == kClassesFormat) {
    entry.name = "classes";
    entry.file = "classes.yaml";
  } else if (format == kProvenanceFormat) {
    entry.name = "provenance";
    entry.file = "provenance.yaml";
  } else {
    entry.name = "checkpoint";
    entry.file = "checkpoint.yaml";
  }
  return entry;
}

/// Name and stem of the i-th class grid of a new archive.
std::string plain_grid_name(std::size_t i) {
  return "class_grid_" + std::to_string(i);
}

ExtensionEntry entry_of(const MapArchive& archive, std::string_view format) {
  const auto kept = archive.extension_entries.find(format);
  return kept == archive.extension_entries.end() ? new_entry(format) : kept->second;
}

void keep_entry(MapArchive& archive, ExtensionEntry entry) {
  if (entry == new_entry(entry.format)) return;
  std::string format = entry.format;
  archive.extension_entries.insert_or_assign(std::move(format), std::move(entry));
}

/// Reads one extension; members named after formats.
class ExtensionReader {
 public:
  ExtensionReader(MapArchive& archive,
                  ArchiveMembers& members,
                  const ExtensionEntry& entry,
                  const std::string& owner,
                  const ArchiveLimits& limits)
      : archive_(archive), members_(members), entry_(entry), owner_(owner), limits_(limits) {}

  Result<std::vector<Finding>> read() {
    if (entry_.format == kOctomapFormat) return read_octree();
    if (entry_.format == kOctreeTwinFormat) return leave_octree_twin();
    if (entry_.format == kClassGridFormat) return read_class_grid();
    if (archive_.extension_entries.contains(entry_.format) || already_read()) {
      return fail(ErrorCode::kMalformedFile, "a second '" + entry_.format + "'", owner_);
    }
    if (entry_.format == kObjectsFormat) return read_objects();
    if (entry_.format == kClassesFormat) return read_classes();
    if (entry_.format == kProvenanceFormat) return read_provenance();
    return read_checkpoint();
  }

 private:
  [[nodiscard]] SourceName source() const { return members_.source_of(entry_.file); }

  /// Whether the part that this extension holds has come already.
  [[nodiscard]] bool already_read() const {
    if (entry_.format == kObjectsFormat)
      return !archive_.objects.empty() || archive_.objects.next_id() != ObjectMap().next_id();
    if (entry_.format == kClassesFormat) return archive_.classes.size() > 0;
    if (entry_.format == kProvenanceFormat) return !archive_.provenance.empty();
    return archive_.checkpoint.kind != ValueKind::kNull;
  }

  Result<std::vector<Finding>> read_octree() {
    HYPERMAP_ASSIGN_OR_RETURN(std::string bytes,
                              members_.take(entry_.file, owner_, limits_.max_octree_bytes));
    HYPERMAP_ASSIGN_OR_RETURN(auto tree, parse_octomap(bytes, source(), {}, members_.budget()));
    if (tree.value.kind != OctomapKind::kSemantic || archive_.octree) {
      archive_.octomaps.push_back(
          {.entry = entry_, .bytes = std::move(bytes), .tree = std::move(tree.value)});
      return std::move(tree.findings);
    }
    HYPERMAP_ASSIGN_OR_RETURN(const OctreeOptions options, octree_options(entry_.extra));
    auto octree = to_semantic_octree(
        tree.value, options, {.max_voxels = limits_.max_octree_voxels}, members_.budget());
    if (!octree) return tl::make_unexpected(with_source(std::move(octree).error(), source()));
    for (Finding& finding : octree->findings) {
      finding.error = with_source(std::move(finding.error), source());
      tree.findings.push_back(std::move(finding));
    }
    archive_.octree = std::move(octree->value);
    ExtensionEntry kept = entry_;
    kept.extra = without_octree_options(kept.extra);
    keep_entry(archive_, std::move(kept));
    return std::move(tree.findings);
  }

  /// It holds nothing that the octree does not, and is made anew with each archive. Its bytes are
  /// looked at for their CRC.
  Result<std::vector<Finding>> leave_octree_twin() {
    HYPERMAP_TRY(members_.take(entry_.file, owner_, limits_.max_octree_bytes));
    if (archive_.octree) return std::vector<Finding>{};
    return std::vector<Finding>{
        {Severity::kWarning,
         with_source({.code = ErrorCode::kMalformedFile,
                      .what = "the octree that it stands for is not there, so it is left out"},
                     source())}};
  }

  Result<std::vector<Finding>> read_class_grid() {
    const SourceName unnamed;
    HYPERMAP_ASSIGN_OR_RETURN(const YamlNode class_node,
                              YamlNode(entry_.extra, "", unnamed).at("class"));
    HYPERMAP_ASSIGN_OR_RETURN(const std::string class_name, class_node.as_string());
    HYPERMAP_ASSIGN_OR_RETURN(auto layer, read_occupancy(members_, entry_.file, owner_, limits_));
    const std::string plain = plain_grid_name(archive_.class_grids.size());
    archive_.class_grids.push_back({.class_name = class_name,
                                    .frame_id = entry_.frame_id,
                                    .grid = std::move(layer.value.grid),
                                    .name = entry_.name == plain ? "" : entry_.name,
                                    .file = entry_.file == plain ? "" : entry_.file,
                                    .extra = other_keys(entry_.extra, kGridKeys)});
    return std::move(layer.findings);
  }

  Result<std::vector<Finding>> read_objects() {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes,
                              members_.take(entry_.file, owner_, limits_.max_objects_bytes));
    HYPERMAP_ASSIGN_OR_RETURN(archive_.objects,
                              parse_objects(bytes, source(), {}, members_.budget()));
    keep_entry(archive_, entry_);
    return std::vector<Finding>{};
  }

  Result<std::vector<Finding>> read_classes() {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes,
                              members_.take(entry_.file, owner_, limits_.max_text_bytes));
    HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, parse_yaml(bytes, source()));
    HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> names, document.root().as_list());
    for (const YamlNode& node : names) {
      HYPERMAP_ASSIGN_OR_RETURN(const std::string name, node.as_string());
      const std::size_t before = archive_.classes.size();
      const auto added = archive_.classes.add(name);
      if (!added) return tl::make_unexpected(node.error(added.error().what));
      if (archive_.classes.size() == before)
        return tl::make_unexpected(node.error("'" + printable(name) + "' is there twice"));
    }
    keep_entry(archive_, entry_);
    return std::vector<Finding>{};
  }

  Result<std::vector<Finding>> read_provenance() {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes,
                              members_.take(entry_.file, owner_, limits_.max_text_bytes));
    HYPERMAP_ASSIGN_OR_RETURN(auto provenance, parse_provenance(bytes, source()));
    archive_.provenance = std::move(provenance.value);
    keep_entry(archive_, entry_);
    return std::move(provenance.findings);
  }

  Result<std::vector<Finding>> read_checkpoint() {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes,
                              members_.take(entry_.file, owner_, limits_.max_text_bytes));
    HYPERMAP_ASSIGN_OR_RETURN(YamlDocument document, parse_yaml(bytes, source()));
    HYPERMAP_TRY(document.root().as_map());
    archive_.checkpoint = std::move(document.value);
    keep_entry(archive_, entry_);
    return std::vector<Finding>{};
  }

  MapArchive& archive_;
  ArchiveMembers& members_;
  const ExtensionEntry& entry_;
  const std::string& owner_;
  const ArchiveLimits& limits_;
};

void put(WrittenExtensions& written, ExtensionEntry entry, std::string bytes) {
  written.files.push_back({.name = entry.file, .bytes = std::move(bytes)});
  written.entries.push_back(std::move(entry));
}

Result<void> put_octree(WrittenExtensions& written, const MapArchive& archive) {
  if (!archive.octree) return {};
  const OctomapTree tree = to_octomap_tree(*archive.octree);
  HYPERMAP_ASSIGN_OR_RETURN(std::string bytes, write_octomap(tree));
  HYPERMAP_ASSIGN_OR_RETURN(std::string twin, write_octomap_binary(tree));
  ExtensionEntry entry = entry_of(archive, kOctomapFormat);
  std::vector<ValueTree::Entry> keys = octree_option_keys(archive.octree->options());
  append_keys(keys, entry.extra);
  entry.extra = make_map(std::move(keys));
  ExtensionEntry twin_entry = new_entry(kOctreeTwinFormat);
  twin_entry.frame_id = entry.frame_id;
  written.octree_twin = {.entry = std::move(twin_entry), .bytes = std::move(twin)};
  put(written, std::move(entry), std::move(bytes));
  return {};
}

Result<void> put_objects(WrittenExtensions& written, const MapArchive& archive) {
  if (archive.objects == ObjectMap()) return {};
  HYPERMAP_ASSIGN_OR_RETURN(std::string bytes, write_objects(archive.objects));
  put(written, entry_of(archive, kObjectsFormat), std::move(bytes));
  return {};
}

void put_classes(WrittenExtensions& written, const MapArchive& archive) {
  if (archive.classes.size() == 0) return;
  std::vector<ValueTree> names;
  for (const std::string& name : archive.classes.names()) names.push_back(make_text(name));
  put(written,
      entry_of(archive, kClassesFormat),
      write_yaml(make_list(std::move(names)), YamlStyle::kBlock));
}

Result<void> put_class_grids(WrittenExtensions& written, const MapArchive& archive) {
  for (std::size_t i = 0; i < archive.class_grids.size(); ++i) {
    const ClassGrid& grid = archive.class_grids[i];
    const std::string plain = plain_grid_name(i);
    ExtensionEntry entry{.format = std::string(kClassGridFormat),
                         .name = grid.name.empty() ? plain : grid.name,
                         .frame_id = grid.frame_id,
                         .file = grid.file.empty() ? plain : grid.file};
    std::vector<ValueTree::Entry> keys{{"class", make_text(grid.class_name)}};
    append_keys(keys, grid.extra);
    entry.extra = make_map(std::move(keys));
    HYPERMAP_ASSIGN_OR_RETURN(auto files, write_occupancy(OccupancyLayer(grid.grid), entry.file));
    std::move(files.begin(), files.end(), std::back_inserter(written.files));
    written.entries.push_back(std::move(entry));
  }
  return {};
}

Result<void> put_provenance(WrittenExtensions& written, const MapArchive& archive) {
  if (archive.provenance.empty()) return {};
  HYPERMAP_ASSIGN_OR_RETURN(std::string bytes, write_provenance(archive.provenance));
  put(written, entry_of(archive, kProvenanceFormat), std::move(bytes));
  return {};
}

void put_checkpoint(WrittenExtensions& written, const MapArchive& archive) {
  if (archive.checkpoint.kind == ValueKind::kNull) return;
  put(written, entry_of(archive, kCheckpointFormat), write_yaml(archive.checkpoint));
}

Result<void> put_layers(WrittenExtensions& written, const MapArchive& archive) {
  for (const Layer& layer : archive.hypermap.layers()) {
    if (is_strict_form(layer)) continue;
    HYPERMAP_ASSIGN_OR_RETURN(auto files, write_layer(layer));
    std::move(files.begin(), files.end(), std::back_inserter(written.files));
    written.entries.push_back(extension_of(layer));
  }
  return {};
}

}  // namespace

Result<std::vector<Finding>> read_extension(MapArchive& archive,
                                            ArchiveMembers& members,
                                            const ExtensionEntry& entry,
                                            const std::string& owner,
                                            const ArchiveLimits& limits) {
  return ExtensionReader(archive, members, entry, owner, limits).read();
}

Result<WrittenExtensions> write_extensions(const MapArchive& archive) {
  WrittenExtensions written;
  HYPERMAP_TRY(put_octree(written, archive));
  for (const auto& octomap : archive.octomaps) put(written, octomap.entry, octomap.bytes);
  HYPERMAP_TRY(put_objects(written, archive));
  put_classes(written, archive);
  HYPERMAP_TRY(put_class_grids(written, archive));
  HYPERMAP_TRY(put_provenance(written, archive));
  put_checkpoint(written, archive);
  HYPERMAP_TRY(put_layers(written, archive));
  return written;
}

}  // namespace hypermap
