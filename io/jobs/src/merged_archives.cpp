// SPDX-License-Identifier: BSD-3-Clause
#include "merged_archives.hpp"

#include "appended_input.hpp"
#include "hypermap/core/changes/map_changes.hpp"
#include "hypermap/core/objects/id_translation.hpp"
#include "hypermap/core/objects/object_map_merge.hpp"
#include "hypermap/core/places/merged_topological_map.hpp"
#include "hypermap/io/archive/archive_changes.hpp"
#include "hypermap/io/archive/archive_floor.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/octree_semantic/octree/free_way.hpp"
#include "hypermap/octree_semantic/octree/merged_octree.hpp"
#include "known_detectors.hpp"
#include "merged_layers.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace hypermap {
namespace {

/// Classes and detectors of both, and what those of the added map are there.
struct UnitedNames {
  ClassRegistry classes;
  DetectorRegistry detectors;
  IdTranslation ids;
};

Result<UnitedNames> united_names(const MapArchive& map, const MapArchive& added) {
  UnitedNames names{.classes = map.classes, .detectors = {}, .ids = {}};
  names.ids.classes.reserve(added.classes.size());
  for (const std::string& name : added.classes.names()) {
    HYPERMAP_ASSIGN_OR_RETURN(const ClassId id, names.classes.add(name));
    names.ids.classes.push_back(id);
  }
  HYPERMAP_ASSIGN_OR_RETURN(names.detectors, known_detectors(map));
  HYPERMAP_ASSIGN_OR_RETURN(const DetectorRegistry others, known_detectors(added));
  names.ids.detectors.reserve(others.size());
  for (const DetectorDescription& detector : others.detectors()) {
    HYPERMAP_ASSIGN_OR_RETURN(const DetectorId id, names.detectors.add(detector));
    names.ids.detectors.push_back(id);
  }
  HYPERMAP_ASSIGN_OR_RETURN(names.ids.frame_offset, index_offset(map, 0));
  return names;
}

/// All objects, not the confirmed ones alone: those of a map to which others were added are only
/// confirmed when all are.
MapArchive without_confirmation(const MapArchive& archive) {
  MapArchive all{.hypermap = {}};
  all.classes = archive.classes;
  all.vocabulary = archive.vocabulary;
  all.objects = archive.objects;
  all.octree = archive.octree;
  return all;
}

/// Objects of the earlier map that left the place where the later one looked.
Result<std::vector<ObjectId>> gone_objects(const MapArchive& map, const MapArchive& later) {
  std::vector<ObjectId> gone;
  if (map.objects.empty()) return gone;
  if (later.objects.empty()) return gone;
  HYPERMAP_ASSIGN_OR_RETURN(
      const ArchiveChanges found,
      archive_changes(without_confirmation(map), without_confirmation(later)));
  for (const ObjectChange& change : found.changes) {
    const bool has_left = change.kind == ChangeKind::kGone || change.kind == ChangeKind::kMoved;
    if (has_left && change.before) gone.push_back(*change.before);
  }
  return gone;
}

void remove_objects(MapArchive& map, const std::vector<ObjectId>& gone) {
  if (gone.empty()) return;
  for (const ObjectId id : gone) {
    map.objects.erase(id);
    map.views.erase(id);
  }
  map.octree->forget_objects([&](ObjectId id) { return !map.objects.contains(id); });
}

/// The better view of an object stays; of equals the earlier frame's.
void keep_better(ObjectViews& views, ObjectId id, ObjectView view) {
  const auto [known, is_new] = views.try_emplace(id, view);
  if (is_new) return;
  const ObjectView& old = known->second;
  const bool is_better =
      view.quality != old.quality ? view.quality > old.quality : view.frame_index < old.frame_index;
  if (is_better) known->second = std::move(view);
}

/// Voxels and views of objects that became part of another are that one's.
void follow_absorbed(MapArchive& map, const ObjectMapMerge& objects) {
  for (const auto& [id, into] : objects.id_of_absorbed) {
    map.octree->relabel_object(id, into);  // also those that its box no longer has
    auto view = map.views.extract(id);
    if (!view.empty()) keep_better(map.views, into, std::move(view.mapped()));
  }
}

void add_views(MapArchive& map,
               const ObjectViews& added,
               const ObjectMapMerge& objects,
               std::uint64_t frame_offset) {
  for (const auto& [id, view] : added) {
    const auto found = objects.id_of_added.find(id);
    if (found == objects.id_of_added.end()) continue;
    ObjectView later = view;
    later.frame_index += frame_offset;
    keep_better(map.views, found->second, std::move(later));
  }
}

Result<void> add_octree(MapArchive& map,
                        const MapArchive& added,
                        const ObjectMapMerge& objects,
                        const IdTranslation& ids,
                        bool is_later) {
  const OctreeMergeOptions options{.object_of =
                                       [&](ObjectId id) {
                                         const auto found = objects.id_of_added.find(id);
                                         return found == objects.id_of_added.end() ? kNoObject
                                                                                   : found->second;
                                       },
                                   .class_of = [&](ClassId id) { return ids.classes.at(id.value); },
                                   .times = is_later ? MergedTimes::kLater : MergedTimes::kBeside};
  SemanticOctree octree = *std::move(map.octree);
  map.octree.reset();
  HYPERMAP_ASSIGN_OR_RETURN(map.octree, merged(std::move(octree), *added.octree, options));
  return {};
}

Result<void> add_places(MapArchive& map, const MapArchive& added) {
  if (!added.topological_map) return {};
  if (!map.topological_map) {
    map.topological_map = added.topological_map;
    return {};
  }
  const IsWayFree is_free = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return is_way_free(*map.octree, from, to);
  };
  HYPERMAP_ASSIGN_OR_RETURN(map.topological_map,
                            merged(*map.topological_map, *added.topological_map, is_free));
  return {};
}

/// The added runs behind those of the map, counted on. Returns how many are forgotten for that.
std::size_t add_runs(std::vector<Provenance>& runs,
                     std::span<const Provenance> added,
                     std::uint64_t frame_offset) {
  std::size_t num_forgotten = 0;
  for (Provenance run : added) {
    if (run.next_frame_index != 0) run.next_frame_index += frame_offset;
    num_forgotten += runs.size() == kMaxRuns ? 1U : 0U;
    add_run(runs, std::move(run));
  }
  return num_forgotten;
}

/// One band of heights cannot be over two floors.
Finding apart_floors(double higher_m) {
  std::array<char, 32> height{};
  std::snprintf(height.data(), height.size(), "%.2f", std::abs(higher_m));
  return {.error = {.code = ErrorCode::kInvalidArgument,
                    .what = "its floor lies " + std::string(height.data()) + " m " +
                            (higher_m > 0.0 ? "above" : "below") +
                            " that of the maps added before it: the layers of the result are over "
                            "one of both",
                    .field = "floor"}};
}

}  // namespace

Result<MergedArchives> merged(MapArchive map,
                              MapArchive added,
                              const ArchiveMergeOptions& options) {
  MergedArchives out;
  const auto higher_m = options.is_floor_stated ? std::nullopt : floors_apart_m(map, added);
  map.floor = merged_floor(map, added);
  if (options.is_later) {
    HYPERMAP_ASSIGN_OR_RETURN(const auto gone, gone_objects(map, added));
    remove_objects(map, gone);
    out.num_gone = gone.size();
  }
  HYPERMAP_ASSIGN_OR_RETURN(UnitedNames names, united_names(map, added));
  HYPERMAP_ASSIGN_OR_RETURN(const ObjectMap translated_objects,
                            translated(added.objects, names.ids));
  HYPERMAP_ASSIGN_OR_RETURN(ObjectMapMerge objects,
                            merged(map.objects, translated_objects, options.association));
  follow_absorbed(map, objects);
  HYPERMAP_TRY(add_octree(map, added, objects, names.ids, options.is_later));
  map.classes = std::move(names.classes);
  map.detectors = std::move(names.detectors);
  add_views(map, added.views, objects, names.ids.frame_offset);
  HYPERMAP_TRY(add_places(map, added));
  out.num_forgotten_runs = add_runs(map.provenance, added.provenance, names.ids.frame_offset);
  HYPERMAP_ASSIGN_OR_RETURN(out.findings, add_layers(map, std::move(added), options.name));
  if (higher_m) out.findings.push_back(apart_floors(*higher_m));
  map.objects = std::move(objects.objects);
  out.num_joined = objects.num_joined;
  out.num_new = objects.num_new;
  out.map = std::move(map);
  return out;
}

}  // namespace hypermap
