// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/place_explanation.hpp"

#include "hypermap/core/objects/object_query.hpp"
#include "hypermap/io/archive/archive_layers.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/archive/map_query.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

double distance_m(const Box& box, const PlanPoint& at) {
  const Eigen::Vector3d point(at.xy.x(), at.xy.y(), at.z.value_or(box.min_in_map.z()));
  return (point - point.cwiseMax(box.min_in_map).cwiseMin(box.max_in_map)).norm();
}

Result<std::optional<std::string>> space_at(const MapArchive& archive, const PlanPoint& at) {
  if (!at.z || !archive.octree) return std::optional<std::string>();
  const auto layers = archive_layers(archive);
  const auto octree = std::find_if(layers.begin(), layers.end(), [](const Layer& layer) {
    return layer.content->class_name() == kOctomapFormat;
  });
  if (octree == layers.end()) return std::optional<std::string>();
  HYPERMAP_ASSIGN_OR_RETURN(const MapAnswers voxel,
                            query_map(archive, {.layer = octree->info.name, .at = at}));
  return std::optional(voxel.found.empty() ? std::string("Unknown") : voxel.found.front().name);
}

}  // namespace

Result<PlaceExplanation> explain_place(const MapArchive& archive,
                                       const PlanPoint& at,
                                       const ConfirmationOptions& confirmation,
                                       const AbsenceOptions& absence) {
  PlaceExplanation out;
  HYPERMAP_ASSIGN_OR_RETURN(out.space, space_at(archive, at));
  const std::vector<ObjectId> shown = confirmed_ids_of(archive);
  for (const ObjectId id : find_objects(archive.objects, archive.classes, {.at = at})) {
    if (std::ranges::binary_search(shown, id)) {
      out.shown.push_back(id);
    } else if (auto why = explain(archive.objects, id, confirmation, absence)) {
      out.withheld.push_back(std::move(*why));
    }
  }
  std::optional<NearestObject> nearest_withheld;
  for (const Object& object : archive.objects.objects()) {
    const bool is_shown = std::ranges::binary_search(shown, object.id);
    std::optional<NearestObject>& nearest = is_shown ? out.nearest : nearest_withheld;
    const double distance = distance_m(object.box, at);
    if (!nearest || distance < nearest->distance_m) nearest = {object.id, distance};
  }
  if (out.withheld.empty()) out.nearest_withheld = nearest_withheld;
  return out;
}

}  // namespace hypermap
