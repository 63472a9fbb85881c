// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/cropped_map.hpp"

#include "hypermap/projection/grids/cropped_grid.hpp"
#include "hypermap/projection/layers/occupancy_layer.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <set>
#include <utility>

namespace hypermap {
namespace {

constexpr std::string_view kRegionFrame = "map";

/// Whether a ray from the point to the right crosses the ring an odd number of times; edges own
/// their lower end, and points on them lie to their right.
bool is_within(const Ring& ring, const Eigen::Vector2d& point) {
  bool is_inside = false;
  for (std::size_t i = 0, k = ring.size() - 1; i < ring.size(); k = i++) {
    const Eigen::Vector2d& a = ring[i];
    const Eigen::Vector2d& b = ring[k];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    const double x = a.x() + (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y());
    if (point.x() < x) is_inside = !is_inside;
  }
  return is_inside;
}

Result<SemanticOctree> cropped_octree(const SemanticOctree& octree, const CropRegion& region) {
  std::vector<StoredLeaf> inside;
  octree.for_each_stored_leaf([&](const StoredLeaf& leaf) {
    if (region.contains(octree.grid().centre(leaf.key).xyz)) inside.push_back(leaf);
  });
  return SemanticOctree::from_leaves(octree.options(), inside);
}

Result<ObjectMap> cropped_objects(const ObjectMap& objects, const CropRegion& region) {
  std::vector<Object> inside;
  for (const Object& object : objects.objects()) {
    if (region.contains(object.centroid_in_map)) inside.push_back(object);
  }
  return ObjectMap::restore(std::move(inside), objects.next_id());
}

Result<TopologicalMap> cropped_places(const TopologicalMap& places, const CropRegion& region) {
  std::vector<TopologicalVertex> vertices;
  std::vector<std::optional<VertexId>> kept(places.vertices().size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const TopologicalVertex& vertex = places.vertices()[i];
    if (!region.contains(vertex.position_in_map)) continue;
    kept[i] = VertexId{static_cast<std::uint32_t>(vertices.size())};
    vertices.push_back(vertex);
  }
  std::vector<TopologicalEdge> edges;
  for (const TopologicalEdge& edge : places.edges()) {
    const auto from = kept[edge.from.value];
    const auto to = kept[edge.to.value];
    if (from && to) edges.push_back({.from = *from, .to = *to});
  }
  return TopologicalMap::create(places.options(), vertices, edges, std::nullopt);
}

/// Where the shapes of a layer are asked for: in the region, or where the map's objects are.
class KeptShapes {
 public:
  KeptShapes(const ObjectMap& whole, const ObjectMap& part) : whole_(whole), part_(part) {}

  [[nodiscard]] bool keeps(const SemanticObject& shape,
                           const CropRegion& region,
                           const Eigen::Isometry2d& map_from_layer) const {
    const ObjectId id{static_cast<std::uint32_t>(shape.id)};
    if (id.value == shape.id && whole_.contains(id)) return part_.contains(id);
    return region.contains(Eigen::Vector2d(map_from_layer * position_of(shape)));
  }

 private:
  const ObjectMap& whole_;
  const ObjectMap& part_;
};

/// None when the type of layer cannot be divided.
Result<std::optional<LayerContent>> cropped_content(const Layer& layer,
                                                    const CropRegion& region,
                                                    const Eigen::Isometry2d& map_from_layer,
                                                    const KeptShapes& shapes) {
  if (const auto* occupancy = layer.content.as<OccupancyLayer>()) {
    return LayerContent(OccupancyLayer(cropped(occupancy->grid,
                                               [&](const Eigen::Vector2d& at) {
                                                 return region.contains(
                                                     Eigen::Vector2d(map_from_layer * at));
                                               }),
                                       occupancy->extra));
  }
  const auto* semantic = layer.content.as<SemanticLayer>();
  if (semantic == nullptr) return std::optional<LayerContent>();
  std::vector<SemanticObject> inside;
  for (const SemanticObject& shape : semantic->objects()) {
    if (shapes.keeps(shape, region, map_from_layer)) inside.push_back(shape);
  }
  HYPERMAP_ASSIGN_OR_RETURN(SemanticLayer part, SemanticLayer::create(std::move(inside)));
  return LayerContent(std::move(part));
}

Result<void> crop_layers(CroppedMap& part, const CropRegion& region, const KeptShapes& shapes) {
  const Hypermap whole = part.map.hypermap;
  for (const Layer& layer : whole.layers()) {
    const auto map_from_layer = whole.frames().to_from(kRegionFrame, layer.info.frame_id);
    std::optional<LayerContent> content;
    if (map_from_layer) {
      HYPERMAP_ASSIGN_OR_RETURN(content, cropped_content(layer, region, *map_from_layer, shapes));
    }
    if (content) {
      HYPERMAP_TRY(part.map.hypermap.set_content(layer.info.name, std::move(*content)));
    } else {
      part.left_out.push_back(layer.info.name);
      part.map.hypermap.remove_layer(layer.info.name);
    }
  }
  return {};
}

void crop_class_grids(CroppedMap& part, const CropRegion& region) {
  const FrameTree& frames = part.map.hypermap.frames();
  std::erase_if(part.map.class_grids, [&](ClassGrid& grid) {
    const auto map_from_grid = frames.to_from(kRegionFrame, grid.frame_id);
    if (!map_from_grid) {
      part.left_out.push_back("grid of " + grid.class_name);
      return true;
    }
    grid.grid = cropped(grid.grid, [&](const Eigen::Vector2d& at) {
      return region.contains(Eigen::Vector2d(*map_from_grid * at));
    });
    return grid.grid.counts().unknown == grid.grid.cells().size();
  });
}

/// Of a truth: those of the true objects that are in the part.
void crop_true_surfaces(TrueSurfaces& surfaces, const CropRegion& region) {
  std::erase_if(surfaces.objects, [&](const TrueSurface& surface) {
    if (surface.vertices.empty()) return true;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3f& vertex : surface.vertices) sum += vertex.cast<double>();
    return !region.contains(Eigen::Vector3d(sum / static_cast<double>(surface.vertices.size())));
  });
}

Result<CroppedMap> cropped_parts(const MapArchive& archive, const CropRegion& region) {
  CroppedMap part{.map = archive};
  HYPERMAP_ASSIGN_OR_RETURN(part.map.objects, cropped_objects(archive.objects, region));
  std::erase_if(part.map.views,
                [&](const auto& view) { return !part.map.objects.contains(view.first); });
  if (archive.octree) {
    HYPERMAP_ASSIGN_OR_RETURN(part.map.octree, cropped_octree(*archive.octree, region));
    part.map.octree->forget_objects([&](ObjectId id) { return !part.map.objects.contains(id); });
  }
  if (archive.topological_map) {
    HYPERMAP_ASSIGN_OR_RETURN(TopologicalMap places,
                              cropped_places(*archive.topological_map, region));
    part.num_own_vertices = places.vertices().size();
    for (const Object& object : part.map.objects.objects()) {
      (void)places.cover(object.centroid_in_map);
    }
    part.map.topological_map = std::move(places);
  }
  HYPERMAP_TRY(crop_layers(part, region, KeptShapes(archive.objects, part.map.objects)));
  crop_class_grids(part, region);
  if (part.map.true_surfaces) crop_true_surfaces(*part.map.true_surfaces, region);
  for (const OctomapExtension& octomap : archive.octomaps) {
    part.left_out.push_back(octomap.entry.name);
  }
  part.map.octomaps.clear();
  part.map.checkpoint = {};
  return part;
}

/// Tiles by row, then column.
using TileIndex = std::pair<std::int64_t, std::int64_t>;

/// The n for which n edges are not above `coordinate_m`, and n + 1 are: as `contains` compares.
std::int64_t num_edges_below(double coordinate_m, double edge_m) {
  auto n = static_cast<std::int64_t>(std::floor(coordinate_m / edge_m));
  if (static_cast<double>(n) * edge_m > coordinate_m) --n;
  if (static_cast<double>(n + 1) * edge_m <= coordinate_m) ++n;
  return n;
}

TileIndex tile_of(const Eigen::Vector2d& point, double edge_m) {
  return {num_edges_below(point.y(), edge_m), num_edges_below(point.x(), edge_m)};
}

/// Those in which a voxel, an object, a vertex, or a cell or shape of a layer of frame `map` lies.
std::set<TileIndex> tiles_in_use(const MapArchive& archive, double edge_m) {
  std::set<TileIndex> tiles;
  const auto use = [&](const Eigen::Vector2d& point) { tiles.insert(tile_of(point, edge_m)); };
  if (archive.octree) {
    archive.octree->for_each_stored_leaf([&](const StoredLeaf& leaf) {
      use(archive.octree->grid().centre(leaf.key).xyz.head<2>());
    });
  }
  for (const Object& object : archive.objects.objects()) use(object.centroid_in_map.head<2>());
  if (archive.topological_map) {
    for (const auto& vertex : archive.topological_map->vertices()) {
      use(vertex.position_in_map.head<2>());
    }
  }
  for (const Layer& layer : archive.hypermap.layers()) {
    const auto map_from_layer =
        archive.hypermap.frames().to_from(kRegionFrame, layer.info.frame_id);
    if (!map_from_layer) continue;
    if (const auto* semantic = layer.content.as<SemanticLayer>()) {
      for (const SemanticObject& shape : semantic->objects()) {
        use(*map_from_layer * position_of(shape));
      }
    } else if (const auto* occupancy = layer.content.as<OccupancyLayer>()) {
      const GridGeometry& geometry = occupancy->grid.geometry();
      for (std::size_t i = 0; i < geometry.num_cells(); ++i) {
        if (occupancy->grid.cells()[i] == kUnknownCell) continue;
        const auto cols = static_cast<std::size_t>(geometry.cols);
        use(*map_from_layer *
            centre(geometry,
                   {.col = static_cast<int>(i % cols), .row = static_cast<int>(i / cols)}));
      }
    }
  }
  return tiles;
}

}  // namespace

bool CropRegion::contains(const Eigen::Vector2d& point) const {
  return is_within(area.outer, point) &&
         std::ranges::none_of(area.holes, [&](const Ring& hole) { return is_within(hole, point); });
}

bool CropRegion::contains(const Eigen::Vector3d& point) const {
  return point.z() >= min_z_m && point.z() < max_z_m && contains(Eigen::Vector2d(point.head<2>()));
}

Result<void> validate(const CropRegion& region) {
  if (auto area = make_polygon(region.area.outer, region.area.holes); !area) {
    Error error = std::move(area).error();
    error.field = "area";
    return Unexpected(std::move(error));
  }
  if (!(region.min_z_m < region.max_z_m)) {
    return fail(ErrorCode::kInvalidArgument,
                "must be above min_z_m (" + std::to_string(region.min_z_m) + "), is " +
                    std::to_string(region.max_z_m),
                "max_z_m");
  }
  return {};
}

Result<CroppedMap> cropped(const MapArchive& archive, const CropRegion& region) {
  HYPERMAP_TRY(validate(region));
  try {
    return cropped_parts(archive, region);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for a part of the map");
  }
}

Result<std::vector<CropRegion>> map_tiles(const MapArchive& archive, double edge_m) {
  if (!(edge_m >= 0.1 && edge_m <= 1e5)) {
    return fail(ErrorCode::kInvalidArgument,
                "must be 0.1 .. 100000 m, is " + std::to_string(edge_m),
                "edge_m");
  }
  const std::set<TileIndex> tiles = tiles_in_use(archive, edge_m);
  if (tiles.size() > kMaxMapTiles) {
    return fail(ErrorCode::kLimit,
                "must give at most " + std::to_string(kMaxMapTiles) + " tiles, gives " +
                    std::to_string(tiles.size()),
                "edge_m");
  }
  std::vector<CropRegion> regions;
  regions.reserve(tiles.size());
  for (const auto& [row, col] : tiles) {
    const Eigen::Vector2d low(static_cast<double>(col) * edge_m, static_cast<double>(row) * edge_m);
    const Eigen::Vector2d high(static_cast<double>(col + 1) * edge_m,
                               static_cast<double>(row + 1) * edge_m);
    regions.push_back(
        {.area = {.outer = {low, {high.x(), low.y()}, high, {low.x(), high.y()}}, .holes = {}}});
  }
  return regions;
}

}  // namespace hypermap
