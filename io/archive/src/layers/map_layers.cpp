// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_layers.hpp"

#include "hypermap/io/archive/archive_layers.hpp"
#include "hypermap/projection/grids/class_grids.hpp"
#include "hypermap/projection/grids/occupancy_projection.hpp"
#include "hypermap/projection/layers/object_footprints.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr const char* kOccupancyName = "occupancy";
constexpr const char* kSemanticName = "semantic";

std::vector<const Object*> objects_of(const ObjectMap& objects,
                                      std::span<const ObjectId> confirmed) {
  std::vector<const Object*> found;
  for (const ObjectId id : confirmed) found.push_back(&objects.at(id));
  return found;
}

/// A surface is measured so much before or behind where it is.
constexpr double kSurfaceNoiseM = 0.05;

/// What an object lends to its voxels, and where.
struct Owner {
  ClassId class_id;
  Box bounds;
};

std::map<ObjectId, Owner> owners_of(const ObjectMap& objects, std::span<const ObjectId> confirmed) {
  std::map<ObjectId, Owner> owners;
  for (const ObjectId id : confirmed) {
    const Object* object = objects.find(id);
    const auto best = object != nullptr ? best_class(*object) : std::nullopt;
    if (best) owners.emplace(id, Owner{best->id, grown(object->box, kSurfaceNoiseM)});
  }
  return owners;
}

/// Null for a voxel of none.
const Owner* owner_of(const LeafSample& leaf, const std::map<ObjectId, Owner>& owners) {
  const auto named = owners.find(leaf.object);
  if (named == owners.end()) return nullptr;
  const bool touches = grown(named->second.bounds, 0.5 * leaf.edge_m).contains(leaf.centre_in_map);
  return touches ? &named->second : nullptr;
}

/// Replaces the content of a layer, or adds the layer.
Result<void> put_layer(Hypermap& hypermap, const char* name, LayerContent content) {
  if (hypermap.find(name) != nullptr) return hypermap.set_content(name, std::move(content));
  return hypermap.add_layer({LayerInfo{.name = name}, std::move(content)});
}

}  // namespace

std::vector<const Object*> confirmed_objects_of(const MapArchive& archive) {
  const auto* semantic = archive.hypermap.find_as<SemanticLayer>(kSemanticName);
  std::vector<const Object*> confirmed;
  for (const Object& object : archive.objects.objects()) {
    if (semantic == nullptr || semantic->find(object.id.value) != nullptr) {
      confirmed.push_back(&object);
    }
  }
  return confirmed;
}

LeafSource confirmed_leaves(const MapArchive& archive, std::span<const ObjectId> confirmed) {
  return [leaves = leaf_source(*archive.octree),
          owners = owners_of(archive.objects, confirmed)](const LeafVisitor& visit) {
    leaves([&](const LeafSample& leaf) {
      LeafSample sample = leaf;
      const Owner* owner = owner_of(leaf, owners);
      sample.best_class = owner == nullptr ? std::nullopt : std::optional(owner->class_id);
      if (owner == nullptr) sample.object = kNoObject;
      visit(sample);
    });
  };
}

LeafSource shown_leaves(const MapArchive& archive) {
  if (archive.octree) {
    std::vector<ObjectId> confirmed;
    for (const Object* object : confirmed_objects_of(archive)) confirmed.push_back(object->id);
    return confirmed_leaves(archive, confirmed);
  }
  return archive.octomaps.empty() ? LeafSource() : leaf_source(archive.octomaps.front().tree);
}

std::string shown_frame_id(const MapArchive& archive) {
  const std::vector<Layer> layers = archive_layers(archive);
  const auto solid = std::find_if(
      layers.begin(), layers.end(), [](const Layer& layer) { return !layer.content->is_flat(); });
  if (solid != layers.end()) return solid->info.frame_id;
  return layers.empty() ? LayerInfo{}.frame_id : layers.front().info.frame_id;
}

Result<void> derive_layers(MapArchive& archive,
                           const ObjectPipelineOptions& objects,
                           const LayerOptions& options) {
  HYPERMAP_TRY(validate(options));
  const auto confirmed = confirmed_objects(archive.objects, objects.confirmation);
  const LeafSource leaves = confirmed_leaves(archive, confirmed);
  const HeightBand band{.min_m = options.min_height_m, .max_m = options.max_height_m};
  const OccupancyProjectionOptions projection{.min_free_share = options.min_free_share};
  HYPERMAP_ASSIGN_OR_RETURN(OccupancyGrid occupancy, project_occupancy(leaves, band, projection));
  HYPERMAP_ASSIGN_OR_RETURN(auto class_grids, project_class_grids(leaves, band, projection));
  HYPERMAP_ASSIGN_OR_RETURN(auto footprints,
                            project_footprints(objects_of(archive.objects, confirmed),
                                               archive.classes,
                                               {.policy = objects.footprint,
                                                .confidence = objects.confirmation.confidence}));
  HYPERMAP_TRY(put_layer(archive.hypermap, kOccupancyName, OccupancyLayer(std::move(occupancy))));
  HYPERMAP_TRY(put_layer(archive.hypermap, kSemanticName, std::move(footprints.layer)));
  archive.class_grids.clear();
  for (auto& [id, grid] : class_grids) {
    archive.class_grids.push_back(
        {.class_name = archive.classes.name(id), .frame_id = "map", .grid = std::move(grid)});
  }
  return {};
}

}  // namespace hypermap
