// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/split_job.hpp"

#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/json_text.hpp"
#include "hypermap/io/codec/staged_folder.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"
#include "tile_places.hpp"

#include <cmath>
#include <utility>

namespace hypermap {
namespace {

constexpr std::string_view kTilePrefix = "tile_";
constexpr std::string_view kTileSuffix = ".hmap";

Result<void> require_replaceable_set(const std::filesystem::path& folder) {
  return require_replaceable(folder, "tile of a map", [](const std::string& name) {
    return name == kTileIndexName || (name.starts_with(kTilePrefix) && name.ends_with(kTileSuffix));
  });
}

std::string tile_name(const Rect& area, double edge_m) {
  const auto number = [&](double low_m) { return std::to_string(std::llround(low_m / edge_m)); };
  return std::string(kTilePrefix) + number(area.min.x()) + "_" + number(area.min.y()) +
         std::string(kTileSuffix);
}

void extend(Rect& rect, const Rect& by) {
  rect.min = rect.min.cwiseMin(by.min);
  rect.max = rect.max.cwiseMax(by.max);
}

/// The tile's area with all that is in it of a size. Shapes of frames that nothing connects with
/// the map are in no tile.
Rect reach_of(const MapArchive& part, const Rect& area) {
  Rect reach = area;
  for (const Object& object : part.objects.objects()) {
    extend(reach, {object.box.min_in_map.head<2>(), object.box.max_in_map.head<2>()});
  }
  for (const Layer& layer : part.hypermap.layers()) {
    const auto* shapes = layer.content.as<SemanticLayer>();
    const auto map_from_layer = part.hypermap.frames().to_from("map", layer.info.frame_id);
    if (shapes == nullptr || !map_from_layer) continue;
    for (const SemanticObject& shape : shapes->objects()) {
      const Rect box = bounds_of(shape);
      for (const double x : {box.min.x(), box.max.x()}) {
        for (const double y : {box.min.y(), box.max.y()}) {
          const Eigen::Vector2d corner = *map_from_layer * Eigen::Vector2d(x, y);
          extend(reach, {corner, corner});
        }
      }
    }
  }
  return reach;
}

MapTile described(const CroppedMap& cropped, const Rect& area, double edge_m) {
  const MapArchive& part = cropped.map;
  const LeafCount leaves = part.octree ? part.octree->num_leaves() : LeafCount{};
  return {.file = tile_name(area, edge_m),
          .area = area,
          .reach = reach_of(part, area),
          .num_voxels = leaves.occupied + leaves.free,
          .num_objects = part.objects.size(),
          .num_vertices = cropped.num_own_vertices};
}

std::string rect_json(const Rect& rect) {
  const std::vector<double> numbers{rect.min.x(), rect.min.y(), rect.max.x(), rect.max.y()};
  return json_array(numbers, [](double value) { return json_number(value); });
}

std::string tile_json(const MapTile& tile) {
  return json_object({{"file", json_quoted(tile.file)},
                      {"area", rect_json(tile.area)},
                      {"reach", rect_json(tile.reach)},
                      {"voxels", std::to_string(tile.num_voxels)},
                      {"objects", std::to_string(tile.num_objects)},
                      {"vertices", std::to_string(tile.num_vertices.value_or(0))}});
}

std::string way_json(const TileWay& way) {
  const std::vector<std::size_t> numbers{
      way.from.tile, way.from.number, way.to.tile, way.to.number};
  return json_array(numbers, [](std::size_t number) { return std::to_string(number); });
}

std::string index_json(const SplitReport& report, double edge_m) {
  return json_object({{"tile_m", json_number(edge_m)},
                      {"tiles", json_array(report.tiles, tile_json)},
                      {"ways", json_array(report.ways, way_json)}}) +
         "\n";
}

}  // namespace

Result<SplitReport> run_split(const MapArchive& archive,
                              const SplitJob& job,
                              const JobProgress& progress) {
  HYPERMAP_TRY(require_replaceable_set(job.output));
  HYPERMAP_ASSIGN_OR_RETURN(const auto regions, map_tiles(archive, job.edge_m));
  HYPERMAP_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(job.output));
  SplitReport report;
  if (archive.topological_map) report.ways = ways_between(*archive.topological_map, regions);
  for (const CropRegion& region : regions) {
    if (progress && !progress(report.tiles.size(), regions.size())) {
      return interrupted();
    }
    HYPERMAP_ASSIGN_OR_RETURN(CroppedMap part, cropped(archive, region));
    const MapTile tile = described(part, bounds(region.area), job.edge_m);
    HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, write_archive(part.map, job.limits));
    HYPERMAP_TRY(staged.write(tile.file, bytes));
    report.tiles.push_back(tile);
    report.left_out = std::move(part.left_out);
  }
  HYPERMAP_TRY(staged.write(kTileIndexName, index_json(report, job.edge_m)));
  HYPERMAP_TRY(require_replaceable_set(job.output));  // the writing took a while
  HYPERMAP_TRY(staged.commit());
  return report;
}

}  // namespace hypermap
