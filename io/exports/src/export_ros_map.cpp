// SPDX-License-Identifier: BSD-3-Clause
#include "export_parts.hpp"
#include "hypermap/io/archive/map_server.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "map_file_pair.hpp"

namespace hypermap {

Result<WrittenFiles> write_map_pair(const OccupancyLayer& layer,
                                    const std::filesystem::path& stem,
                                    bool keep_rotation) {
  OccupancyLayer written = layer;
  if (!keep_rotation) {
    HYPERMAP_ASSIGN_OR_RETURN(written.grid, without_rotation(layer.grid));
  }
  std::filesystem::path image = stem;
  image += ".pgm";
  std::filesystem::path metadata = stem;
  metadata += ".yaml";
  HYPERMAP_ASSIGN_OR_RETURN(const MapFiles files,
                            write_trinary_map(written, image.filename().string()));
  // The image first: whoever sees the new YAML finds the image that it names.
  HYPERMAP_TRY(write_file_atomically(image, files.image));
  HYPERMAP_TRY(write_file_atomically(metadata, files.yaml));
  return WrittenFiles{metadata, image};
}

Result<WrittenFiles> export_ros_map(const MapArchive& archive, const ExportRequest& request) {
  HYPERMAP_ASSIGN_OR_RETURN(const Layer* layer, wanted_layer<OccupancyLayer>(archive, request));
  std::filesystem::path stem = request.output;
  if (stem.extension() == ".yaml" || stem.extension() == ".pgm") stem.replace_extension();
  return write_map_pair(*layer->content.as<OccupancyLayer>(), stem, request.keep_rotation);
}

}  // namespace hypermap
