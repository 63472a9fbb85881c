// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/joined_map.hpp"

#include "hypermap/projection/grids/joined_grid.hpp"
#include "hypermap/projection/layers/occupancy_layer.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <algorithm>
#include <iterator>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace hypermap {
namespace {

using MapParts = std::span<const MapArchive>;

Unexpected of_other_map(std::string what, const char* field) {
  return fail(ErrorCode::kInvalidArgument, std::move(what), field);
}

/// What all parts of one map have alike.
Result<void> check_one_map(MapParts parts) {
  const MapArchive& first = parts.front();
  for (const MapArchive& part : parts) {
    if (!std::ranges::equal(part.classes.names(), first.classes.names())) {
      return of_other_map("must be those of the other parts", "classes");
    }
    if (part.provenance != first.provenance) {
      return of_other_map("must tell of the runs of the other parts", "provenance");
    }
    const bool is_alike = part.octree.has_value() == first.octree.has_value() &&
                          (!part.octree || part.octree->options() == first.octree->options());
    if (!is_alike) return of_other_map("must have the options of the other parts", "octree");
    if (part.floor != first.floor) return of_other_map("must be that of the other parts", "floor");
  }
  return {};
}

Result<SemanticOctree> joined_octree(MapParts parts) {
  std::vector<StoredLeaf> leaves;
  for (const MapArchive& part : parts) {
    part.octree->for_each_stored_leaf([&](const StoredLeaf& leaf) { leaves.push_back(leaf); });
  }
  return SemanticOctree::from_leaves(parts.front().octree->options(), leaves);
}

Result<ObjectMap> joined_objects(MapParts parts) {
  std::vector<Object> objects;
  ObjectId next_id = parts.front().objects.next_id();
  for (const MapArchive& part : parts) {
    for (const Object& object : part.objects.objects()) objects.push_back(object);
    next_id = std::max(next_id, part.objects.next_id());
  }
  std::ranges::sort(objects, {}, &Object::id);
  return ObjectMap::restore(std::move(objects), next_id);
}

Result<TopologicalMap> joined_places(MapParts parts) {
  std::vector<TopologicalVertex> vertices;
  std::vector<TopologicalEdge> edges;
  for (const MapArchive& part : parts) {
    if (!part.topological_map) continue;
    const auto offset = static_cast<std::uint32_t>(vertices.size());
    std::ranges::copy(part.topological_map->vertices(), std::back_inserter(vertices));
    for (const auto& [from, to] : part.topological_map->edges()) {
      edges.push_back({.from = VertexId{from.value + offset}, .to = VertexId{to.value + offset}});
    }
  }
  return TopologicalMap::create(
      parts.front().topological_map->options(), vertices, edges, std::nullopt);
}

/// The contents of the layer in the parts that have it as that type.
template <class Type>
std::vector<const Type*> contents_of(MapParts parts, const std::string& layer) {
  std::vector<const Type*> contents;
  for (const MapArchive& part : parts) {
    if (const auto* content = part.hypermap.find_as<Type>(layer)) contents.push_back(content);
  }
  return contents;
}

/// None for a layer that cannot be divided, and so is in no part.
Result<std::optional<LayerContent>> joined_content(MapParts parts, const Layer& layer) {
  const std::string& name = layer.info.name;
  if (const auto* first = layer.content.as<OccupancyLayer>()) {
    std::vector<OccupancyGrid> grids;
    for (const auto* one : contents_of<OccupancyLayer>(parts, name)) grids.push_back(one->grid);
    HYPERMAP_ASSIGN_OR_RETURN(OccupancyGrid grid, joined(std::span<const OccupancyGrid>(grids)));
    return LayerContent(OccupancyLayer(std::move(grid), first->extra));
  }
  if (layer.content.as<SemanticLayer>() == nullptr) return std::optional<LayerContent>();
  std::vector<SemanticObject> shapes;
  for (const auto* one : contents_of<SemanticLayer>(parts, name)) {
    std::ranges::copy(one->objects(), std::back_inserter(shapes));
  }
  HYPERMAP_ASSIGN_OR_RETURN(SemanticLayer whole, SemanticLayer::create(std::move(shapes)));
  return LayerContent(std::move(whole));
}

Result<void> join_layers(MapArchive& whole, MapParts parts) {
  for (const Layer& layer : parts.front().hypermap.layers()) {
    HYPERMAP_ASSIGN_OR_RETURN(auto content, joined_content(parts, layer));
    if (content) {
      HYPERMAP_TRY(whole.hypermap.set_content(layer.info.name, std::move(*content)));
    }
  }
  return {};
}

/// A grid of a class, where the parts have one each at most, in order of first mention.
Result<std::vector<ClassGrid>> joined_class_grids(MapParts parts) {
  std::vector<ClassGrid> grids;
  std::vector<std::vector<OccupancyGrid>> cells;
  for (const MapArchive& part : parts) {
    for (const ClassGrid& grid : part.class_grids) {
      const auto same = std::ranges::find_if(grids, [&](const ClassGrid& one) {
        return one.class_name == grid.class_name && one.frame_id == grid.frame_id;
      });
      const auto i = static_cast<std::size_t>(same - grids.begin());
      if (same == grids.end()) {
        grids.push_back(grid);
        cells.emplace_back();
      }
      cells[i].push_back(grid.grid);
    }
  }
  for (std::size_t i = 0; i < grids.size(); ++i) {
    HYPERMAP_ASSIGN_OR_RETURN(grids[i].grid, joined(std::span<const OccupancyGrid>(cells[i])));
  }
  return grids;
}

Result<MapArchive> joined_parts(MapParts parts) {
  HYPERMAP_TRY(check_one_map(parts));
  MapArchive whole = parts.front();
  if (whole.octree) {
    HYPERMAP_ASSIGN_OR_RETURN(whole.octree, joined_octree(parts));
  }
  HYPERMAP_ASSIGN_OR_RETURN(whole.objects, joined_objects(parts));
  if (whole.topological_map) {
    HYPERMAP_ASSIGN_OR_RETURN(whole.topological_map, joined_places(parts));
  }
  HYPERMAP_TRY(join_layers(whole, parts));
  HYPERMAP_ASSIGN_OR_RETURN(whole.class_grids, joined_class_grids(parts));
  for (const MapArchive& part : parts.subspan(1)) {
    whole.views.insert(part.views.begin(), part.views.end());
    if (!whole.true_surfaces || !part.true_surfaces) continue;
    std::ranges::copy(part.true_surfaces->objects,
                      std::back_inserter(whole.true_surfaces->objects));
  }
  return whole;
}

}  // namespace

Result<MapArchive> joined(std::vector<MapArchive> parts) {
  if (parts.size() == 1) return std::move(parts.front());
  try {
    return joined_parts(parts);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for the parts of the map as one");
  }
}

}  // namespace hypermap
