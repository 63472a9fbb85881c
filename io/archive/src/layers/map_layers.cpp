// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_layers.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/io/archive/archive_floor.hpp"
#include "hypermap/io/archive/archive_layers.hpp"
#include "hypermap/io/archive/class_stack.hpp"
#include "hypermap/io/archive/grid_stack_layer.hpp"
#include "hypermap/octree_semantic/octree/voxel_owners.hpp"
#include "hypermap/projection/grids/class_grids.hpp"
#include "hypermap/projection/grids/occupancy_projection.hpp"
#include "hypermap/projection/grids/rooms.hpp"
#include "hypermap/projection/layers/object_footprints.hpp"

#include <algorithm>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

std::vector<const Object*> objects_of(const ObjectMap& objects,
                                      std::span<const ObjectId> confirmed) {
  std::vector<const Object*> found;
  for (const ObjectId id : confirmed) found.push_back(&objects.at(id));
  return found;
}

/// The mapper feeds a layer that is new; one that was there keeps its flags.
Result<void> put_layer(Hypermap& hypermap, std::string_view name, LayerContent content) {
  return hypermap.put_layer(
      {LayerInfo{.name = std::string(name), .subscribe_mode = true}, std::move(content)});
}

/// Heights over the floor as heights of the map.
HeightBand band_of(const LayerOptions& options, const MapFloor& floor) {
  return over(floor, {.min_m = options.min_height_m, .max_m = options.max_height_m});
}

/// `make()`, and what a library throws is its error.
template <class Make>
auto guarded_layer(const Make& make) -> decltype(make()) {
  return guarded(ErrorCode::kInvalidArgument, "it", make);
}

OccupancyProjectionOptions projection_of(const LayerOptions& options) {
  return {.min_free_share = options.min_free_share, .max_unseen_m = options.max_unseen_m};
}

/// Shapes that were held against the map, column by column, and that say what stands on the floor.
struct StandingShapes {
  const SemanticLayer* layer = nullptr;  ///< None: there are no such shapes.
  std::vector<ObjectId> left_out = {};   ///< Their box stands in for them.
};

/// Of those objects that reach into the band by more than a voxel.
std::vector<Polygon> shapes_in(const HeightBand& band,
                               const StandingShapes& standing,
                               const MapArchive& archive,
                               std::span<const ObjectId> confirmed) {
  std::vector<Polygon> found;
  if (standing.layer == nullptr) return found;
  const double least_m = archive.octree->resolution_m();
  for (const ObjectId id : confirmed) {
    const SemanticObject* shape = standing.layer->find(id.value);
    const auto& out = standing.left_out;
    if (shape == nullptr || std::find(out.begin(), out.end(), id) != out.end()) continue;
    const Box& box = archive.objects.at(id).box;
    const double top_m = std::min(box.max_in_map.z(), band.max_m);
    if (top_m - std::max(box.min_in_map.z(), band.min_m) <= least_m) continue;
    found.insert(found.end(), shape->parts.begin(), shape->parts.end());
  }
  return found;
}

/// The layer is new, or, on an error, not there: one of an earlier map would be of another map.
/// What shapes cover is not free, though rays passed over a seat.
Result<void> put_occupancy(MapArchive& archive,
                           const LeafSource& leaves,
                           std::span<const ObjectId> confirmed,
                           const StandingShapes& standing,
                           const LayerOptions& options) {
  const HeightBand band = band_of(options, archive.floor);
  auto grid = guarded_layer([&] {
    auto projected = project_occupancy(leaves, band, projection_of(options));
    if (!projected) return projected;
    const auto shapes = shapes_in(band, standing, archive, confirmed);
    return Result<OccupancyGrid>(with_obstacles(std::move(*projected), shapes));
  });
  const bool has_cells = grid && grid->geometry().num_cells() > 0;
  if (has_cells) {
    return put_layer(archive.hypermap, kOccupancyLayer, OccupancyLayer(std::move(*grid)));
  }
  archive.hypermap.remove_layer(kOccupancyLayer);
  if (!grid) return Unexpected(std::move(grid).error());
  return fail(ErrorCode::kNotFound,
              "no voxel lies between projection.min_height_m (" +
                  std::to_string(options.min_height_m) + ") and projection.max_height_m (" +
                  std::to_string(options.max_height_m) + ") over the floor at " +
                  std::to_string(archive.floor.height_m) + " m");
}

Result<FootprintLayer> footprints_of(const MapArchive& archive,
                                     const LeafSource& leaves,
                                     std::span<const ObjectId> confirmed,
                                     const ObjectPipelineOptions& objects,
                                     const LayerOptions& options) {
  auto carving = options.carve_footprints
                     ? std::optional(CarvingMap{leaves, archive.octree->resolution_m()})
                     : std::nullopt;
  return guarded_layer([&] {
    return project_footprints(objects_of(archive.objects, confirmed),
                              archive.classes,
                              {.policy = objects.footprint,
                               .confidence = objects.confirmation.confidence,
                               .carving = std::move(carving)});
  });
}

/// As put_occupancy.
Result<void> put_footprints(MapArchive& archive, Result<FootprintLayer> footprints) {
  if (footprints) return put_layer(archive.hypermap, kSemanticLayer, std::move(footprints->layer));
  archive.hypermap.remove_layer(kSemanticLayer);
  return Unexpected(std::move(footprints).error());
}

/// All class grids are new, or, on an error, none is there.
Result<void> put_class_grids(MapArchive& archive,
                             const LeafSource& leaves,
                             const LayerOptions& options) {
  archive.class_grids.clear();
  HYPERMAP_ASSIGN_OR_RETURN(auto grids, guarded_layer([&] {
                              return project_class_grids(
                                  leaves, band_of(options, archive.floor), projection_of(options));
                            }));
  for (auto& [id, grid] : grids) {
    archive.class_grids.push_back(
        {.class_name = archive.classes.name(id), .frame_id = "map", .grid = std::move(grid)});
  }
  return {};
}

/// As put_occupancy.
Result<void> put_stack(MapArchive& archive, const LeafSource& leaves, const LayerOptions& options) {
  auto stack = guarded_layer([&] {
    return class_stack(leaves,
                       archive.classes,
                       {.band = band_of(options, archive.floor), .classes = {}, .options = {}});
  });
  if (stack) return put_layer(archive.hypermap, kStackLayer, GridStackLayer(std::move(*stack)));
  archive.hypermap.remove_layer(kStackLayer);
  return Unexpected(std::move(stack).error());
}

/// A stack that an earlier run made is made anew: the old one would be of another map.
bool wants_stack(const MapArchive& archive, const LayerOptions& options) {
  return options.class_stack || archive.hypermap.find_as<GridStackLayer>(kStackLayer) != nullptr;
}

bool takes_updates(const Hypermap& map, std::string_view name) {
  const Layer* layer = map.find(name);
  return layer == nullptr || layer->info.enable_update.value_or(true);
}

/// Of a layer that takes no updates.
Finding kept_as_it_was(std::string_view layer) {
  return {
      Severity::kWarning,
      {.code = ErrorCode::kUnsupported,
       .what = "stays as it was, its enable_update is false: what was mapped since is not in it",
       .entry = std::string(layer)}};
}

/// Of a layer that is there.
Finding made_without_footprints(Error error) {
  error.what = "made without the footprints of objects: " + error.what;
  error.entry = std::string(kOccupancyLayer);
  return {Severity::kWarning, std::move(error)};
}

Finding left_out(Error error, std::string_view layer) {
  error.what = "left out: " + error.what;
  error.entry = std::string(layer);
  return {Severity::kWarning, std::move(error)};
}

}  // namespace

std::vector<const Object*> confirmed_objects_of(const MapArchive& archive) {
  const auto* semantic = archive.hypermap.find_as<SemanticLayer>(kSemanticLayer);
  std::vector<const Object*> confirmed;
  for (const Object& object : archive.objects.objects()) {
    if (semantic == nullptr || semantic->find(object.id.value) != nullptr) {
      confirmed.push_back(&object);
    }
  }
  return confirmed;
}

LeafSource confirmed_leaves(const MapArchive& archive, std::span<const ObjectId> confirmed) {
  return owned_leaves(*archive.octree, VoxelOwners(archive.objects, confirmed));
}

std::vector<ObjectId> confirmed_ids_of(const MapArchive& archive) {
  std::vector<ObjectId> ids;
  for (const Object* object : confirmed_objects_of(archive)) ids.push_back(object->id);
  return ids;
}

LeafSource shown_leaves(const MapArchive& archive) {
  if (!archive.octree)
    return archive.octomaps.empty() ? LeafSource() : leaf_source(archive.octomaps.front().tree);
  if (archive.objects.empty()) return leaf_source(*archive.octree);
  return confirmed_leaves(archive, confirmed_ids_of(archive));
}

std::string shown_frame_id(const MapArchive& archive) {
  const std::vector<Layer> layers = archive_layers(archive);
  const auto solid = std::find_if(
      layers.begin(), layers.end(), [](const Layer& layer) { return !layer.content->is_flat(); });
  if (solid != layers.end()) return solid->info.frame_id;
  return layers.empty() ? LayerInfo{}.frame_id : layers.front().info.frame_id;
}

Result<DerivedLayers> derive_layers(MapArchive& archive,
                                    const ObjectPipelineOptions& objects,
                                    const LayerOptions& options) {
  HYPERMAP_TRY(validate(options));
  const auto confirmed = confirmed_objects(archive.objects, objects.confirmation);
  const MapRegions regions = MapRegions::find(leaf_source(*archive.octree));
  const LeafSource leaves = leaves_of_largest(confirmed_leaves(archive, confirmed), regions);
  if (options.floor_m) archive.floor = {*options.floor_m, FloorSource::kStated};
  archive.floor = shown_floor(archive, leaves);
  DerivedLayers derived;
  const auto all = regions.regions();
  if (all.size() > 1) derived.outlying.assign(all.begin() + 1, all.end());
  derived.main = all.empty() ? MapRegion{} : all.front();
  const auto make = [&](std::string_view layer, const auto& put) {
    if (!takes_updates(archive.hypermap, layer)) {
      derived.left_out.push_back(kept_as_it_was(layer));
    } else if (const Result<void> done = put(); !done) {
      derived.left_out.push_back(left_out(done.error(), layer));
    }
  };
  auto footprints = footprints_of(archive, leaves, confirmed, objects, options);
  const bool are_held_against_map =
      options.carve_footprints && objects.footprint == ShapePolicy::kVoxels;
  make(kOccupancyLayer, [&] {
    StandingShapes standing;
    if (!takes_updates(archive.hypermap, kSemanticLayer)) {
      standing.layer = archive.hypermap.find_as<SemanticLayer>(kSemanticLayer);
    } else if (are_held_against_map && footprints) {
      standing = {.layer = &footprints->layer, .left_out = footprints->from_box};
    } else if (are_held_against_map) {
      derived.left_out.push_back(made_without_footprints(footprints.error()));
    }
    return put_occupancy(archive, leaves, confirmed, standing, options);
  });
  make(kSemanticLayer, [&] { return put_footprints(archive, std::move(footprints)); });
  make("class grids", [&] { return put_class_grids(archive, leaves, options); });
  if (wants_stack(archive, options)) {
    make(kStackLayer, [&] { return put_stack(archive, leaves, options); });
  }
  return derived;
}

}  // namespace hypermap
