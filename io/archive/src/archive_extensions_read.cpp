// SPDX-License-Identifier: BSD-3-Clause
#include "archive_extensions.hpp"
#include "extension_entries.hpp"
#include "hypermap/io/archive/detectors_file.hpp"
#include "hypermap/io/archive/object_embeddings.hpp"
#include "hypermap/io/archive/object_json.hpp"
#include "hypermap/io/archive/octomap_file.hpp"
#include "hypermap/io/archive/topological_map_json.hpp"
#include "hypermap/io/archive/true_surfaces_json.hpp"
#include "hypermap/io/archive/vocabulary_file.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/codec/value_keys.hpp"
#include "layers/layer_files.hpp"
#include "octree/floor_keys.hpp"
#include "octree/octree_options_keys.hpp"

#include <array>
#include <utility>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 1> kGridKeys{"class"};

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
    if (entry_.format == kEmbeddingsFormat) return read_embeddings();
    if (entry_.format == kViewsFormat) return read_views();
    if (entry_.format == kTopologicalMapFormat) return read_topological_map();
    if (entry_.format == kClassesFormat) return read_classes();
    if (entry_.format == kDetectorsFormat) return read_detectors();
    if (entry_.format == kVocabularyFormat) return read_vocabulary();
    if (entry_.format == kProvenanceFormat) return read_provenance();
    if (entry_.format == kTrueSurfacesFormat) return read_true_surfaces();
    return read_checkpoint();
  }

 private:
  [[nodiscard]] SourceName source() const { return members_.source_of(entry_.file); }

  /// Whether the part that this extension holds has come already.
  [[nodiscard]] bool already_read() const {
    if (entry_.format == kObjectsFormat)
      return !archive_.objects.empty() || archive_.objects.next_id() != ObjectMap().next_id();
    if (entry_.format == kEmbeddingsFormat) return !embeddings_of(archive_.objects).empty();
    if (entry_.format == kViewsFormat) return !archive_.views.empty();
    if (entry_.format == kTopologicalMapFormat) return archive_.topological_map.has_value();
    if (entry_.format == kClassesFormat) return archive_.classes.size() > 0;
    if (entry_.format == kDetectorsFormat) return archive_.detectors.size() > 0;
    if (entry_.format == kVocabularyFormat) return !archive_.vocabulary.empty();
    if (entry_.format == kProvenanceFormat) return !archive_.provenance.empty();
    if (entry_.format == kTrueSurfacesFormat) return archive_.true_surfaces.has_value();
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
    read_floor(tree.findings);
    auto octree = to_semantic_octree(
        tree.value, options, {.max_voxels = limits_.max_octree_voxels}, members_.budget());
    if (!octree) return tl::make_unexpected(with_source(std::move(octree).error(), source()));
    for (Finding& finding : octree->findings) {
      finding.error = with_source(std::move(finding.error), source());
      tree.findings.push_back(std::move(finding));
    }
    archive_.octree = std::move(octree->value);
    ExtensionEntry kept = entry_;
    kept.extra = without_floor_keys(without_octree_options(kept.extra));
    keep_entry(archive_, std::move(kept));
    return std::move(tree.findings);
  }

  /// Of the entry of the octree, or of the objects of a map without one. What is wrong with it
  /// costs neither: it is told.
  void read_floor(std::vector<Finding>& findings) {
    auto floor = floor_of_keys(entry_.extra);
    if (floor && *floor != MapFloor{}) archive_.floor = *floor;
    if (floor) return;
    Error error = std::move(floor).error();
    error.what += "; the floor is looked for anew";
    findings.push_back(
        {.error = with_source(std::move(error), members_.source_of(std::string(kConfigName)))});
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
    std::vector<Finding> findings;
    read_floor(findings);
    ExtensionEntry kept = entry_;
    kept.extra = without_floor_keys(kept.extra);
    keep_entry(archive_, std::move(kept));
    return findings;
  }

  /// Requires: the objects have been read.
  Result<std::vector<Finding>> read_embeddings() {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes,
                              members_.take(entry_.file, owner_, limits_.max_embeddings_bytes));
    HYPERMAP_ASSIGN_OR_RETURN(auto embeddings, parse_object_embeddings(bytes, source()));
    const std::size_t num_absent = set_object_embeddings(archive_.objects, embeddings);
    keep_entry(archive_, entry_);
    return findings_of_absent(num_absent);
  }

  /// Requires: the objects have been read.
  Result<std::vector<Finding>> read_views() {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes,
                              members_.take(entry_.file, owner_, limits_.max_views_bytes));
    HYPERMAP_ASSIGN_OR_RETURN(archive_.views, parse_object_views(bytes, source()));
    const std::size_t num_absent = std::erase_if(
        archive_.views, [this](const auto& one) { return !archive_.objects.contains(one.first); });
    keep_entry(archive_, entry_);
    return findings_of_absent(num_absent);
  }

  [[nodiscard]] std::vector<Finding> findings_of_absent(std::size_t num_objects) const {
    if (num_objects == 0) return {};
    return {{Severity::kWarning,
             with_source({.code = ErrorCode::kMalformedFile,
                          .what = "is of " + std::to_string(num_objects) +
                                  " objects that the map does not have; theirs are left out"},
                         source())}};
  }

  Result<std::vector<Finding>> read_topological_map() {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes,
                              members_.take(entry_.file, owner_, limits_.max_objects_bytes));
    HYPERMAP_ASSIGN_OR_RETURN(archive_.topological_map,
                              parse_topological_map(bytes, source(), {}, members_.budget()));
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

  Result<std::vector<Finding>> read_detectors() {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes,
                              members_.take(entry_.file, owner_, limits_.max_text_bytes));
    HYPERMAP_ASSIGN_OR_RETURN(auto detectors, parse_detectors(bytes, source()));
    archive_.detectors = std::move(detectors.value);
    keep_entry(archive_, entry_);
    return std::move(detectors.findings);
  }

  Result<std::vector<Finding>> read_vocabulary() {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes,
                              members_.take(entry_.file, owner_, limits_.max_text_bytes));
    HYPERMAP_ASSIGN_OR_RETURN(archive_.vocabulary, parse_vocabulary(bytes, source()));
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

  Result<std::vector<Finding>> read_true_surfaces() {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes,
                              members_.take(entry_.file, owner_, limits_.max_objects_bytes));
    HYPERMAP_ASSIGN_OR_RETURN(archive_.true_surfaces,
                              parse_true_surfaces(bytes, source(), {}, members_.budget()));
    keep_entry(archive_, entry_);
    return std::vector<Finding>{};
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

}  // namespace

Result<std::vector<Finding>> read_extension(MapArchive& archive,
                                            ArchiveMembers& members,
                                            const ExtensionEntry& entry,
                                            const std::string& owner,
                                            const ArchiveLimits& limits) {
  return ExtensionReader(archive, members, entry, owner, limits).read();
}

}  // namespace hypermap
