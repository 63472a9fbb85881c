// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A whole map in one file, `.hmap`: layers in the form of the first implementation, and beside
/// them the octree, the objects, the classes and where it all came from.
///
/// Source: [hypermap] 3.3.5 (archive of layers).
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/evaluation/true_surfaces.hpp"
#include "hypermap/core/geometry/map_floor.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/core/places/topological_map.hpp"
#include "hypermap/core/segmentation/detector_registry.hpp"
#include "hypermap/core/vocabulary/class_vocabulary.hpp"
#include "hypermap/io/archive/hypermap_config.hpp"
#include "hypermap/io/archive/layer_types.hpp"
#include "hypermap/io/archive/object_views.hpp"
#include "hypermap/io/archive/octomap_tree.hpp"
#include "hypermap/io/archive/provenance.hpp"
#include "hypermap/io/codec/file_reach.hpp"
#include "hypermap/io/codec/source_name.hpp"
#include "hypermap/io/codec/zip_reader.hpp"
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"
#include "hypermap/projection/layers/hypermap.hpp"
#include "hypermap/projection/layers/layer_registry.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// An octree that another program wrote (or a second one of ours): its bytes are saved again as
/// they are; `tree` is what they say. `to_semantic_octree` makes a map of it, `leaf_source` a view.
struct OctomapExtension {
  ExtensionEntry entry;
  std::string bytes;
  OctomapTree tree;
  friend bool operator==(const OctomapExtension&, const OctomapExtension&) = default;
};

/// Where objects of one class are: 100 where one is, 0 where the space is free or holds other
/// objects, -1 where nothing is known.
struct ClassGrid {
  std::string class_name;
  std::string frame_id = "map";
  OccupancyGrid grid = {};
  std::string name = {};  ///< Of its extension; empty: chosen when saved.
  std::string file = {};  ///< Stem of its two members; empty: chosen when saved.
  ValueTree extra = {};   ///< Unknown keys of its extension, as a map; null when there are none.
  friend bool operator==(const ClassGrid&, const ClassGrid&) = default;
};

/// Everything that an archive holds. A value: copy it, compare it.
struct MapArchive {
  Hypermap hypermap;
  ClassRegistry classes = {};
  /// Whose words the observation logs hold, by the ids there. Maps of before they were kept have
  /// none.
  DetectorRegistry detectors = {};
  /// What the names of classes mean when something is asked; all else keeps the names as they are.
  ClassVocabulary vocabulary = {};
  ObjectMap objects = {};
  ObjectViews views = {};  ///< Of objects, where they were kept.
  /// Where the sensor came to; none in maps that were made without.
  std::optional<TopologicalMap> topological_map = {};
  std::optional<SemanticOctree> octree = {};
  MapFloor floor = {};  ///< Stored with the octree, without one with the objects.
  std::vector<ClassGrid> class_grids = {};
  /// Of each run that put frames into the map, oldest first; at most `kMaxRuns`.
  std::vector<Provenance> provenance = {};
  /// Of a map that was saved while its newest run went on: what that run needs to go on from here,
  /// as a map whose keys are the run's own (mapping_job.hpp). Null: the run is done.
  ValueTree checkpoint = {};
  /// Of an archive that is a truth: the meshes of its objects, by which voxels are evaluated.
  std::optional<TrueSurfaces> true_surfaces = {};
  /// Unknown files and keys below come from archives of others; a new map leaves them empty.
  std::vector<OctomapExtension> octomaps = {};
  /// Extensions of unknown format, whole entries. Their files are among `opaque_files`.
  std::vector<ValueTree> foreign_extensions = {};
  /// Members that no layer and no known extension uses, in the order of their names.
  std::vector<OpaqueFile> opaque_files = {};
  /// Name, frame, file and unknown keys of our own extensions, by format, where they are not those
  /// that a new archive would have.
  std::map<std::string, ExtensionEntry, std::less<>> extension_entries = {};

  friend bool operator==(const MapArchive&, const MapArchive&) = default;
};

struct ArchiveLimits {
  ZipLimits zip = {};
  std::uint64_t max_text_bytes = std::uint64_t{16} << 20;       ///< Of a YAML entry.
  std::uint64_t max_shapes_bytes = std::uint64_t{1} << 30;      ///< Of a semantic layer.
  std::uint64_t max_objects_bytes = std::uint64_t{1} << 30;     ///< Of the objects, a line each.
  std::uint64_t max_embeddings_bytes = std::uint64_t{2} << 30;  ///< Of the objects' embeddings.
  std::uint64_t max_views_bytes = std::uint64_t{2} << 30;       ///< Of the objects' views.
  std::uint64_t max_octree_bytes = std::uint64_t{2} << 30;      ///< Of an octree.
  std::uint64_t max_octree_voxels = std::uint64_t{1} << 31;     ///< Of our own octree.
  BudgetLimits sums = {};                                       ///< Of all members together.
  FileReach reach = FileReach::kAnywhere;                       ///< Of a bare configuration.
};

/// Reads an archive, or a bare configuration file whose layers lie beside it (relative to it) or
/// anywhere (absolute) within `limits.reach`; distinguished by content.
///
/// Everything is parsed aside; what is returned is whole. `layers` are the types of layers that
/// are loaded; those of other classes are kept as they are.
/// Findings: whatever was repaired, is unknown and kept, or is used by nothing.
/// Errors: those of ZipReader and of the readers of the parts; kMalformedFile for a missing
/// configuration or member, a file that leads out of the archive, a file that two layers share, a
/// label without a class; kUnsupported for a newer version and for a file of another kind; kIo;
/// kOutOfMemory; kInterrupted when `stop` says so. Each names archive and member; where many small
/// members meet a limit together, the one that crosses it.
[[nodiscard]] Result<Loaded<MapArchive>> load_archive(
    const std::filesystem::path& path,
    const ArchiveLimits& limits = {},
    const LayerRegistry& layers = archive_layer_types(),
    const StopCheck& stop = {});
/// The same from an archive's bytes, which errors call `source.file`.
[[nodiscard]] Result<Loaded<MapArchive>> parse_archive(
    std::string_view bytes,
    const SourceName& source,
    const ArchiveLimits& limits = {},
    const LayerRegistry& layers = archive_layer_types(),
    const StopCheck& stop = {});

/// Which parts of an archive are read, beside its layers, classes and vocabulary: large ones that a
/// question may not need.
struct ArchiveParts {
  bool octrees = true;
  bool objects = true;      ///< With their embeddings and views, and the topological map.
  bool class_grids = true;  ///< One for each class.
};

/// Some parts of a map. The others, and members that nothing names, are not there: it answers
/// questions, and must not be saved in the place of the whole.
struct PartialMap {
  MapArchive map;
  /// Edge of the voxels of the octree, as its file declares it, also where that was not read.
  std::optional<double> octree_resolution_m = std::nullopt;
  /// What the configuration says of the parts that were not read, in the order of reading.
  std::vector<ExtensionEntry> left_out = {};
};

/// As load_archive. Members that are left out are not inflated, and so not checked beyond name and
/// declared size. Cost: that of the parts that are read.
[[nodiscard]] Result<Loaded<PartialMap>> load_archive_parts(
    const std::filesystem::path& path,
    const ArchiveParts& parts,
    const ArchiveLimits& limits = {},
    const LayerRegistry& layers = archive_layer_types(),
    const StopCheck& stop = {});

/// The bytes of the archive: equal maps give equal bytes, on any machine and at any number of
/// threads. Errors: kInvalidArgument or kLimit for whatever `parse_archive` would refuse; whether
/// it is within `limits.sums` is only known by reading, which `save_archive` does to verify.
[[nodiscard]] Result<std::string> write_archive(const MapArchive& archive,
                                                const ArchiveLimits& limits = {});

struct SaveOptions {
  ArchiveLimits limits = {};
  /// Parses the bytes before they replace anything, compares the maps, and after the replacement
  /// compares the file with the bytes. For archives up to `max_verified_bytes`.
  bool verify = true;
  /// Larger archives are written without that second look. Unit: byte. Default: 1 GiB.
  std::uint64_t max_verified_bytes = std::uint64_t{1} << 30;
  /// Types of layers that verification loads: all that the map has.
  LayerRegistry layers = archive_layer_types();
  /// Threads that make the bytes and read them again; the bytes are the same at any number. 0: one
  /// for each core.
  int num_threads = 0;
};

/// Replaces the file atomically. Errors: those of write_archive and write_file_atomically;
/// kMalformedFile when verification finds a difference (the old file is then still there, unless
/// the disk itself returned other bytes, which is said).
[[nodiscard]] Result<void> save_archive(const MapArchive& archive,
                                        const std::filesystem::path& path,
                                        const SaveOptions& options = {});

}  // namespace hypermap
