// SPDX-License-Identifier: BSD-3-Clause
#include "completeness.hpp"

#include "hypermap/io/archive/archive_layers.hpp"
#include "hypermap/io/archive/object_completion.hpp"
#include "hypermap/io/archive/objects_layer.hpp"

namespace hypermap::app {
namespace {

Box moved(const Box& box, const Eigen::Isometry2d& to_from) {
  const Eigen::Vector3d first = box.corners().front();
  Box around{first, first};
  around.min_in_map.head<2>() = around.max_in_map.head<2>() = to_from * first.head<2>();
  for (Eigen::Vector3d corner : box.corners()) {
    corner.head<2>() = to_from * Eigen::Vector2d(corner.head<2>());
    around = bounding_box(around, {corner, corner});
  }
  return around;
}

}  // namespace

Result<CompletenessById> completeness_of(const MapArchive& archive,
                                         const MapQuery& query,
                                         const MapAnswers& answers,
                                         bool complete) {
  HYPERMAP_ASSIGN_OR_RETURN(const Layer layer, archive_layer(archive, query.layer));
  if (layer.content.as<ObjectsLayer>() == nullptr) return CompletenessById{};
  HYPERMAP_ASSIGN_OR_RETURN(
      const Eigen::Isometry2d answer_from_map,
      archive.hypermap.frames().to_from(answers.frame_id, layer.info.frame_id));
  const auto boxes = complete ? completed_boxes(archive) : std::map<ObjectId, Box>();
  CompletenessById seen;
  for (const MapAnswer& one : answers.found) {
    const ObjectId id{static_cast<std::uint32_t>(one.id)};
    const Object* object = archive.objects.find(id);
    if (object == nullptr) continue;
    Completeness& entry = seen[one.id];
    entry.seen_share = seen_share(*object);
    const auto box = boxes.find(id);
    if (box != boxes.end()) entry.completed = moved(box->second, answer_from_map);
  }
  return seen;
}

nlohmann::ordered_json guess_json(const Completeness& object) {
  if (!object.completed) return nullptr;
  const Eigen::Vector3d& low = object.completed->min_in_map;
  const Eigen::Vector3d& high = object.completed->max_in_map;
  return {{"bbox", {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()}}, {"guess", true}};
}

}  // namespace hypermap::app
