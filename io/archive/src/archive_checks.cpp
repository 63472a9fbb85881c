// SPDX-License-Identifier: BSD-3-Clause
#include "archive_checks.hpp"

#include <algorithm>
#include <string>

namespace hypermap {
namespace {

Result<void> check_class(const ClassRegistry& classes, ClassId id, const std::string& where) {
  if (classes.contains(id)) return {};
  return fail(ErrorCode::kMalformedFile,
              "speaks of class " + std::to_string(id.value) + ", there are " +
                  std::to_string(classes.size()),
              where);
}

template <class Visit>
void for_each_class(const ObservationLogEntry& entry, const Visit& visit) {
  visit(entry.class_id);
  for (const BeliefChange& change : entry.other_changes.entries()) visit(change.class_id);
}

/// Calls `visit(id)` for each class that an object speaks of, with repetitions.
template <class Visit>
void for_each_class(const Object& object, const Visit& visit) {
  for (const ClassLogOdds& entry : object.belief.entries()) visit(entry.id);
  for (const ClassLogOdds& entry : object.prior.log_factors()) visit(entry.id);
  const ObservationLogState& observation_log = object.observation_log.state();
  if (observation_log.first) for_each_class(*observation_log.first, visit);
  for (const ObservationLogEntry& entry : observation_log.newest) for_each_class(entry, visit);
  for (const ObservationLogSummary& summary : observation_log.summaries) visit(summary.class_id);
}

Result<void> check_object(const ClassRegistry& classes, const Object& object) {
  std::optional<ClassId> unknown;
  for_each_class(object, [&](ClassId id) {
    if (!unknown && !classes.contains(id)) unknown = id;
  });
  if (!unknown) return {};
  return check_class(classes, *unknown, "object " + std::to_string(object.id.value));
}

/// The largest class id that a label names, if any does.
std::optional<ClassId> largest_class(const SemanticOctree& octree) {
  std::optional<ClassId> largest;
  octree.for_each_label([&largest](const VoxelLabel& label) {
    for (const ClassWeight& weight : label.classes)
      if (weight.class_id != ClassWeight::kNone)
        largest = std::max(largest.value_or(ClassId{0}), ClassId{weight.class_id});
  });
  return largest;
}

/// The first object that a voxel names and the map does not have.
std::optional<ObjectId> absent_object(const MapArchive& archive) {
  std::optional<ObjectId> absent;
  if (!archive.octree) return absent;
  archive.octree->for_each_label([&](const VoxelLabel& label) {
    if (label.object == kNoObject || archive.objects.contains(label.object)) return;
    absent = std::min(absent.value_or(label.object), label.object);
  });
  return absent;
}

}  // namespace

std::optional<ClassId> largest_class_of(const MapArchive& archive) {
  auto largest = archive.octree ? largest_class(*archive.octree) : std::nullopt;
  for (const Object& object : archive.objects.objects()) {
    for_each_class(object,
                   [&](ClassId id) { largest = std::max(largest.value_or(ClassId{0}), id); });
  }
  return largest;
}

Result<void> check_classes(const MapArchive& archive) {
  const auto largest = archive.octree ? largest_class(*archive.octree) : std::nullopt;
  if (largest) HYPERMAP_TRY(check_class(archive.classes, *largest, "octree"));
  for (const Object& object : archive.objects.objects())
    HYPERMAP_TRY(check_object(archive.classes, object));
  return {};
}

Result<void> check_objects_of_voxels(const MapArchive& archive) {
  const auto absent = absent_object(archive);
  if (!absent) return {};
  return fail(
      ErrorCode::kInvalidArgument,
      "a voxel names object " + std::to_string(absent->value) + ", which the map does not have",
      "octree");
}

std::optional<Finding> forget_absent_objects(MapArchive& archive) {
  const auto absent = absent_object(archive);
  if (!absent) return std::nullopt;
  const std::size_t num_voxels =
      archive.octree->forget_objects([&](ObjectId id) { return !archive.objects.contains(id); });
  return Finding{.error = {.code = ErrorCode::kMalformedFile,
                           .what = std::to_string(num_voxels) +
                                   " voxels name objects that the map does not have (" +
                                   std::to_string(absent->value) +
                                   " is one); they are voxels of none now",
                           .field = "octree"}};
}

}  // namespace hypermap
