// SPDX-License-Identifier: BSD-3-Clause
#include "export_folder.hpp"
#include "export_parts.hpp"
#include "exported_objects.hpp"
#include "hypermap/core/geometry/polygon_motion.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/archive/map_server.hpp"
#include "hypermap/io/codec/staged_folder.hpp"
#include "hypermap/projection/layers/occupancy_layer.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"
#include "map_file_pair.hpp"
#include "nav2_parameters.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 9> kBundleFiles{"map.yaml",
                                                       "map.pgm",
                                                       "keepout_mask.yaml",
                                                       "keepout_mask.pgm",
                                                       "keepout_filter_info.yaml",
                                                       "speed_mask.yaml",
                                                       "speed_mask.pgm",
                                                       "speed_filter_info.yaml",
                                                       "nav2_params.yaml"};

/// An older bundle is there with all its files: a map.yaml by itself is somebody's map.
Result<void> require_replaceable_bundle(const std::filesystem::path& folder) {
  std::size_t num_files = 0;
  HYPERMAP_TRY(require_replaceable(folder, "file of a Nav2 bundle", [&](const std::string& name) {
    ++num_files;
    return std::ranges::find(kBundleFiles, name) != kBundleFiles.end();
  }));
  if (num_files == 0 || num_files == kBundleFiles.size()) return {};
  return Unexpected(Error{ErrorCode::kInvalidArgument,
                          "would be replaced, but is no whole Nav2 bundle: has " +
                              std::to_string(num_files) + " of its " +
                              std::to_string(kBundleFiles.size()) + " files",
                          folder.string()});
}

/// The layer `semantic`, else the first of its kind; null when the map has none.
const Layer* layer_of_shapes(const MapArchive& archive) {
  const Layer* found = nullptr;
  for (const Layer& layer : archive.hypermap.layers()) {
    if (layer.content.as<SemanticLayer>() == nullptr) continue;
    if (found == nullptr || layer.info.name == kSemanticLayer) found = &layer;
  }
  return found;
}

bool hangs_above(const Object* object, double height_m) {
  return object != nullptr && object->box.min_in_map.z() > height_m;
}

/// The shapes of the classes that were asked for, in the grid's frame, without what hangs above the
/// robot. Errors: kNotFound when no transform leads from their frame to the grid's.
Result<std::vector<SemanticObject>> shapes_in_the_way(const MapArchive& archive,
                                                      const ExportRequest& request,
                                                      const LayerInfo& grid) {
  std::vector<SemanticObject> shapes;
  const Layer* layer = layer_of_shapes(archive);
  if (layer == nullptr) return shapes;
  HYPERMAP_ASSIGN_OR_RETURN(
      const auto wanted,
      exported_shapes(archive, *layer->content.as<SemanticLayer>(), request.classes));
  const auto grid_from_layer =
      archive.hypermap.frames().to_from(grid.frame_id, layer->info.frame_id);
  if (!grid_from_layer) return fail(ErrorCode::kNotFound, grid_from_layer.error().what, "frames");
  const double highest_m = archive.floor.height_m + request.zones.robot_height_m;
  shapes.reserve(wanted.size());
  for (const SemanticObject* shape : wanted) {
    if (hangs_above(object_of(*shape, *layer, archive), highest_m)) continue;
    SemanticObject& in_grid = shapes.emplace_back(*shape);
    for (Polygon& part : in_grid.parts) part = moved(std::move(part), *grid_from_layer);
  }
  return shapes;
}

void append_map(const std::string& name, MapFiles files, std::vector<NamedBytes>& bundle) {
  bundle.push_back({name + ".yaml", std::move(files.yaml)});
  bundle.push_back({name + ".pgm", std::move(files.image)});
}

Result<std::vector<NamedBytes>> bundle_files(const OccupancyLayer& map,
                                             const ZoneMasks& masks,
                                             const std::string& frame_id) {
  std::vector<NamedBytes> bundle;
  HYPERMAP_ASSIGN_OR_RETURN(MapFiles plain, write_trinary_map(map, "map.pgm"));
  append_map("map", std::move(plain), bundle);
  HYPERMAP_ASSIGN_OR_RETURN(MapFiles keepout,
                            write_trinary_map(OccupancyLayer(masks.keepout), "keepout_mask.pgm"));
  append_map("keepout_mask", std::move(keepout), bundle);
  HYPERMAP_ASSIGN_OR_RETURN(MapFiles speed,
                            write_raw_map(OccupancyLayer(masks.speed), "speed_mask.pgm"));
  append_map("speed_mask", std::move(speed), bundle);
  bundle.push_back({"keepout_filter_info.yaml", filter_info_yaml(keepout_filter(), frame_id)});
  bundle.push_back({"speed_filter_info.yaml", filter_info_yaml(speed_filter(), frame_id)});
  bundle.push_back({"nav2_params.yaml", nav2_params_yaml(frame_id)});
  return bundle;
}

}  // namespace

Result<WrittenFiles> export_nav2(const MapArchive& archive, const ExportRequest& request) {
  HYPERMAP_TRY(require_replaceable_bundle(request.output));
  HYPERMAP_ASSIGN_OR_RETURN(const Layer* layer,
                            wanted_layer<OccupancyLayer>(archive, request, kOccupancyLayerClass));
  OccupancyLayer map = *layer->content.as<OccupancyLayer>();
  const OccupancyCounts counts = map.grid.counts();
  if (counts.occupied + counts.free + counts.between == 0) return WrittenFiles{};
  HYPERMAP_ASSIGN_OR_RETURN(map.grid, without_rotation(map.grid));  // filters do not turn masks
  HYPERMAP_ASSIGN_OR_RETURN(const auto shapes, shapes_in_the_way(archive, request, layer->info));
  HYPERMAP_ASSIGN_OR_RETURN(
      const ZoneMasks masks,
      zone_masks(map.grid.geometry(), shapes, request.zones, archive.vocabulary));
  HYPERMAP_ASSIGN_OR_RETURN(const auto bundle, bundle_files(map, masks, layer->info.frame_id));
  HYPERMAP_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(request.output));
  WrittenFiles written;
  for (const auto& [name, bytes] : bundle) {
    HYPERMAP_TRY(staged.write(name, bytes));
    written.push_back(request.output / name);
  }
  HYPERMAP_TRY(staged.commit());
  return written;
}

}  // namespace hypermap
