// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/archive_changes.hpp"

#include "hypermap/core/objects/object_beliefs.hpp"
#include "hypermap/io/archive/map_layers.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

namespace hypermap {
namespace {

Result<void> check_compared(const MapArchive& archive, const char* field) {
  if (!archive.octree) {
    return fail(ErrorCode::kUnsupported,
                "has no semantic octree, so that nobody can say where it looked",
                field);
  }
  if (archive.objects.size() == 0 && !archive.hypermap.find(kSemanticLayer)) {
    return fail(ErrorCode::kUnsupported, "has no 3D objects", field);
  }
  return {};
}

/// Whether one of the eight voxels around that of the point, at its height, is occupied.
bool is_beside_occupied(const SemanticOctree& octree, const PointInMap& point) {
  const double step_m = octree.resolution_m();
  for (const double x_m : {-step_m, 0.0, step_m}) {
    for (const double y_m : {-step_m, 0.0, step_m}) {
      const auto leaf = octree.at(PointInMap{point.xyz + Eigen::Vector3d(x_m, y_m, 0.0)});
      if (leaf && leaf->occupied) return true;
    }
  }
  return false;
}

/// Two maps place one surface a voxel apart, by noise of depth and poses: free is what no occupied
/// voxel is beside. Above and below none counts, or a cup would not leave its table.
SpaceQuery space_of(const SemanticOctree& octree) {
  return [&octree](const PointInMap& point) {
    const auto leaf = octree.at(point);
    if (!leaf) return SpaceState::kUnknown;
    return is_beside_occupied(octree, point) ? SpaceState::kOccupied : SpaceState::kFree;
  };
}

/// Whether a frame from `first_index` on saw it or should have.
bool was_observed_since(const Object& object, std::uint64_t first_index) {
  const auto& newest = object.observation_log.state().newest;
  return !newest.empty() && newest.back().frame_index >= first_index;
}

MapOfPlace map_of_place(const MapArchive& archive, const ClassVocabulary& vocabulary) {
  MapOfPlace map{.objects = {}, .space = space_of(*archive.octree)};
  for (const Object* object : confirmed_objects_of(archive)) {
    map.objects.push_back(
        {.id = object->id,
         .class_name = vocabulary.class_of(best_class_name(*object, archive.classes)),
         .box = object->box,
         .centroid_in_map = object->centroid_in_map,
         .points_in_map = object->points.agreed_points()});
  }
  return map;
}

/// Whether a map that goes on from the object's looked through its place, or removed it for that:
/// one that was joined with another lies where that one is.
bool is_seen_gone(const ObjectInPlace& object, const ObjectMap& later) {
  if (const Object* kept = later.find(object.id)) return is_gone(kept->observation_log);
  return later.query(Box{object.centroid_in_map, object.centroid_in_map}).empty();
}

/// The earlier map with what the later one, which goes on from it, says of its objects.
MapOfPlace with_what_is_gone(MapOfPlace before, const ObjectMap& later) {
  for (ObjectInPlace& object : before.objects) object.was_seen_gone = is_seen_gone(object, later);
  return before;
}

/// The later map with what it looked at from frame `first_new` on.
MapOfPlace with_looks(MapOfPlace after, const ObjectMap& later, std::uint64_t first_new) {
  for (ObjectInPlace& object : after.objects) {
    object.was_looked_at = was_observed_since(later.at(object.id), first_new);
  }
  return after;
}

/// The first frame that is new, where the later map's oldest runs are the earlier's.
std::optional<std::uint64_t> first_new_frame(const MapArchive& before, const MapArchive& after) {
  const auto& old = before.provenance;
  const bool goes_on = !old.empty() && old.size() < after.provenance.size() &&
                       std::equal(old.begin(), old.end(), after.provenance.begin());
  if (!goes_on || old.back().next_frame_index == 0) return std::nullopt;
  return old.back().next_frame_index;
}

std::vector<Polygon> polygons_of(Result<Polygon> polygon) {
  if (!polygon) return {};
  return {std::move(*polygon)};
}

/// As the layer of the confirmed objects shows it, else by its points, else its box.
std::vector<Polygon> shape_of(const MapArchive& archive, ObjectId id) {
  if (const auto* semantic = archive.hypermap.find_as<SemanticLayer>(kSemanticLayer)) {
    if (const SemanticObject* shown = semantic->find(id.value)) return shown->parts;
  }
  const Object& object = archive.objects.at(id);
  if (auto of_points = footprint(object)) return polygons_of(std::move(of_points));
  const Eigen::Vector2d low = object.box.min_in_map.head<2>();
  const Eigen::Vector2d high = object.box.max_in_map.head<2>();
  return polygons_of(make_polygon({low, {high.x(), low.y()}, high, {low.x(), high.y()}}));
}

SemanticObject shape_of_change(const MapArchive& before,
                               const MapArchive& after,
                               const ObjectChange& change) {
  const MapArchive& shown = change.after ? after : before;
  const ObjectId id = change.after ? *change.after : change.before.value_or(kNoObject);
  SemanticObject shape;
  shape.name = std::string(name_of(change.kind)) + " " +
               best_class_name(shown.objects.at(id), shown.classes);
  shape.parts = shape_of(shown, id);
  shape.tags.emplace_back(key_of(change.kind));
  if (change.before) shape.tags.push_back("before " + std::to_string(change.before->value));
  if (change.after) shape.tags.push_back("after " + std::to_string(change.after->value));
  return shape;
}

}  // namespace

Result<ArchiveChanges> archive_changes(const MapArchive& before,
                                       const MapArchive& after,
                                       const ChangeOptions& options) {
  HYPERMAP_TRY(check_compared(before, "before"));
  HYPERMAP_TRY(check_compared(after, "after"));
  const std::string frame_id = shown_frame_id(after);
  if (shown_frame_id(before) != frame_id) {
    return fail(ErrorCode::kUnsupported,
                "lies in frame " + shown_frame_id(before) + ", the later map in " + frame_id,
                "before");
  }
  const ClassVocabulary& vocabulary =
      after.vocabulary.empty() ? before.vocabulary : after.vocabulary;
  const auto first_new = first_new_frame(before, after);
  MapOfPlace earlier = map_of_place(before, vocabulary);
  MapOfPlace later = map_of_place(after, vocabulary);
  if (first_new) {
    earlier = with_what_is_gone(std::move(earlier), after.objects);
    later = with_looks(std::move(later), after.objects, *first_new);
  }
  return ArchiveChanges{.frame_id = frame_id,
                        .goes_on = first_new.has_value(),
                        .changes = find_changes(earlier, later, options)};
}

Result<SemanticLayer> changes_layer(const MapArchive& before,
                                    const MapArchive& after,
                                    const ArchiveChanges& found) {
  std::vector<SemanticObject> shapes;
  for (const ObjectChange& change : found.changes) {
    if (change.kind == ChangeKind::kSame) continue;
    SemanticObject shape = shape_of_change(before, after, change);
    if (shape.parts.empty()) continue;
    shape.id = shapes.size() + 1;
    shapes.push_back(std::move(shape));
  }
  return SemanticLayer::create(std::move(shapes));
}

}  // namespace hypermap
