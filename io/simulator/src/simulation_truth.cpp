// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/simulation_truth.hpp"

#include "seen_surfaces.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace hypermap {
namespace {

constexpr int kLeastDepthPixels = 200;
constexpr std::size_t kLeastFramesNamed = 3;
constexpr double kOnFloorM = 0.001;  ///< A moved object stands on the floor, whatever it stood on.

ValueTree box_tree(const Box& box) {
  std::vector<ValueTree> numbers;
  for (const Eigen::Vector3d& corner : {box.min_in_map, box.max_in_map}) {
    for (const double coordinate : corner) numbers.push_back(make_number(coordinate));
  }
  return make_list(std::move(numbers));
}

/// What an object stands on: the floor, or the number of the object that the scene names; null when
/// it hangs, or stands elsewhere than on top of that.
ValueTree support_tree(const PlacedObject& object, const Simulator& simulator, const Scene& scene) {
  if (object.box.min_in_map.z() < kOnFloorM) return make_text("floor");
  const auto said = std::ranges::find(scene.objects, object.name, &SceneObject::name);
  if (said == scene.objects.end() || said->on.empty() || said->height_m != 0.0) return {};
  const auto below = std::ranges::find(simulator.objects(), said->on, &PlacedObject::name);
  return below == simulator.objects().end() ? ValueTree{} : make_number(below->id.value);
}

SemanticObject semantic_object(const PlacedObject& object,
                               ValueTree support,
                               const SimulatedTruth& truth,
                               const TrueSurface& surface,
                               double seen_cell_m) {
  const double seen_share = seen_footprint_share(surface, seen_cell_m, object.footprint);
  std::vector<ValueTree::Entry> extra{
      {"thing", make_text(object.name)},
      {"box", box_tree(object.box)},
      {"frames_named", make_number(static_cast<double>(truth.num_frames_named))},
      {"seen_footprint", make_number(seen_share)}};
  if (support.kind != ValueKind::kNull) extra.emplace_back("stands_on", std::move(support));
  if (!surface.is_nameable) extra.emplace_back("nameable", make_bool(false));
  if (!truth.exclusion_reason.empty())
    extra.emplace_back("excluded", make_text(truth.exclusion_reason));
  SemanticObject result;
  result.id = object.id.value;
  result.name = object.class_name;
  result.parts = {object.footprint};
  result.extra = make_map(std::move(extra));
  return result;
}

/// The object as an object of a map that is sure of everything.
Object certain_object(const PlacedObject& placed, ClassId class_id) {
  Object object;
  object.id = placed.id;
  object.belief.observe(std::array{ClassEvidence{class_id, Probability(1.0)}}, Probability(0.5));
  object.existence = object.belief.options().max_log_odds;
  object.box_confidence = object.belief.options().max_log_odds;
  object.box = placed.box;
  object.centroid_in_map = placed.centroid_in_map;
  object.shapes.add(placed.footprint);
  object.num_observations = 1;
  return object;
}

}  // namespace

std::string exclusion(const SimulatedTruth& truth, const SimulatedDetector& detector) {
  if (!detector.knows_class(truth.class_name)) return "the detector has no word for this class";
  if (truth.most_depth_pixels < kLeastDepthPixels)
    return "never covered " + std::to_string(kLeastDepthPixels) + " depth pixels, at most " +
           std::to_string(truth.most_depth_pixels);
  if (truth.num_frames_named < kLeastFramesNamed)
    return "rarely seen: named rightly in " + std::to_string(truth.num_frames_named) +
           " frames, fewer than " + std::to_string(kLeastFramesNamed);
  return "";
}

Result<MapArchive> make_truth(const Simulator& simulator,
                              const Scene& scene,
                              std::span<const SimulatedTruth> truths,
                              TrueSurfaces surfaces) {
  std::vector<SemanticObject> semantic_objects;
  std::vector<Object> objects;
  MapArchive archive;
  for (const PlacedObject& placed : simulator.objects()) {
    const std::size_t index = placed.id.value - 1;
    semantic_objects.push_back(semantic_object(placed,
                                               support_tree(placed, simulator, scene),
                                               truths[index],
                                               surfaces.objects[index],
                                               surfaces.seen_cell_m));
    HYPERMAP_ASSIGN_OR_RETURN(const ClassId class_id, archive.classes.add(placed.class_name));
    objects.push_back(certain_object(placed, class_id));
  }
  const ObjectId next_id{static_cast<std::uint32_t>(objects.size() + 1)};
  HYPERMAP_ASSIGN_OR_RETURN(archive.objects, ObjectMap::restore(std::move(objects), next_id));
  HYPERMAP_ASSIGN_OR_RETURN(SemanticLayer semantic,
                            SemanticLayer::create(std::move(semantic_objects)));
  HYPERMAP_ASSIGN_OR_RETURN(OccupancyGrid grid,
                            true_occupancy(simulator.furnished(), scene.waypoints));
  HYPERMAP_TRY(archive.hypermap.add_layer(
      {LayerInfo{.name = "occupancy"}, OccupancyLayer(std::move(grid))}));
  HYPERMAP_TRY(archive.hypermap.add_layer({LayerInfo{.name = "semantic"}, std::move(semantic)}));
  archive.true_surfaces = std::move(surfaces);
  return archive;
}

}  // namespace hypermap
