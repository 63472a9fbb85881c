// SPDX-License-Identifier: BSD-3-Clause
#include "export_parts.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/archive/cleared_floor.hpp"
#include "hypermap/io/archive/hashed_image_name.hpp"
#include "hypermap/io/archive/map_server.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/projection/layers/hypermap_query.hpp"
#include "map_file_pair.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace hypermap {

namespace {

constexpr std::uint64_t kMaxYamlBytes = std::uint64_t{1} << 20U;

/// The image that a YAML names, as written there; empty when it is no such YAML.
Result<std::string> image_named_by(const std::filesystem::path& metadata) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string yaml, read_file(metadata, kMaxYamlBytes));
  const auto parsed = parse_map_metadata(yaml, {.file = metadata.string()});
  return parsed ? parsed->value.image : std::string();
}

/// Six lines that lead from columns and rows of the image to the map, for programs that know no
/// map_server: steps along a row (x, y), steps down a column (x, y), the centre of the first pixel.
std::string world_file(const GridGeometry& geometry) {
  const Eigen::Vector2d first = from_cells(geometry, {0.5, geometry.rows - 0.5});
  const Eigen::Vector2d along = geometry.resolution_m * Eigen::Vector2d(std::cos(geometry.yaw_rad),
                                                                        std::sin(geometry.yaw_rad));
  const Eigen::Vector2d down(along.y(), -along.x());
  std::string text;
  for (const Eigen::Vector2d& pair : {along, down, first}) {
    text += number_text(pair.x()) + "\n" + number_text(pair.y()) + "\n";
  }
  return text;
}

std::string world_name(const std::string& image) {
  return std::filesystem::path(image).replace_extension(".pgw").string();
}

/// The error of a sub-map with the flag that gave its cause.
Unexpected of_area(Error error) {
  if (error.field == "area") error.field = "--area";
  if (error.field == "frame_id") error.field = "--frame";
  return Unexpected(std::move(error));
}

}  // namespace

Result<MapFileSet> map_files(const OccupancyLayer& layer,
                             const std::string& stem,
                             bool keep_rotation) {
  OccupancyLayer written = layer;
  if (!keep_rotation) {
    HYPERMAP_ASSIGN_OR_RETURN(written.grid, without_rotation(layer.grid));
  }
  HYPERMAP_ASSIGN_OR_RETURN(const MapFiles unnamed, write_trinary_map(written, ""));
  const std::string name = hashed_image_name(stem, unnamed.image);
  HYPERMAP_ASSIGN_OR_RETURN(MapFiles files, write_trinary_map(written, name));
  return MapFileSet{.yaml = {stem + ".yaml", std::move(files.yaml)},
                    .image = {name, std::move(files.image)},
                    .world = {world_name(name), world_file(written.grid.geometry())}};
}

Result<std::string> image_of_pair(const std::filesystem::path& yaml) {
  HYPERMAP_ASSIGN_OR_RETURN(std::string image, image_named_by(yaml));
  return stem_of_hashed_name(image) == yaml.stem().string() ? image : std::string();
}

Result<WrittenFiles> write_map_pair(const OccupancyLayer& layer,
                                    const std::filesystem::path& stem,
                                    bool keep_rotation) {
  const std::filesystem::path folder = stem.parent_path();
  HYPERMAP_ASSIGN_OR_RETURN(const MapFileSet files,
                            map_files(layer, stem.filename().string(), keep_rotation));
  const std::filesystem::path metadata = folder / files.yaml.name;
  const std::string old_image = image_of_pair(metadata).value_or(std::string());  // none: new

  // Until the YAML is renamed the old pair stands, from then on the new one.
  const std::filesystem::path image = folder / files.image.name;
  const std::filesystem::path world = folder / files.world.name;
  HYPERMAP_TRY(write_file_atomically(image, files.image.bytes));
  HYPERMAP_TRY(write_file_atomically(world, files.world.bytes));
  HYPERMAP_TRY(write_file_atomically(metadata, files.yaml.bytes));
  std::error_code stays;
  if (!old_image.empty() && old_image != files.image.name) {
    std::filesystem::remove(folder / old_image, stays);
    std::filesystem::remove(folder / world_name(old_image), stays);
  }
  return WrittenFiles{metadata, image, world};
}

std::filesystem::path ros_map_yaml(std::filesystem::path output) {
  if (output.extension() == ".yaml" || output.extension() == ".pgm") output.replace_extension();
  output += ".yaml";
  return output;
}

Result<WrittenFiles> export_ros_map(const MapArchive& archive, const ExportRequest& request) {
  HYPERMAP_ASSIGN_OR_RETURN(const Layer* layer,
                            wanted_layer<OccupancyLayer>(archive, request, kOccupancyLayerClass));
  OccupancyLayer map = *layer->content.as<OccupancyLayer>();
  if (request.without_objects) {
    HYPERMAP_ASSIGN_OR_RETURN(map, without_objects(archive, *layer, ObjectRims::kGo));
  }
  if (request.area) {
    auto part = sub_map({.info = layer->info, .content = std::move(map)},
                        archive.hypermap.frames(),
                        request.area_frame_id,
                        *request.area);
    if (!part) return of_area(part.error());
    map = *std::move(part);
  }
  const OccupancyCounts counts = map.grid.counts();
  if (counts.occupied + counts.free + counts.between == 0) return WrittenFiles{};
  const std::filesystem::path stem = ros_map_yaml(request.output).replace_extension();
  return write_map_pair(map, stem, request.keep_rotation);
}

}  // namespace hypermap
