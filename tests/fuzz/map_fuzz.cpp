// SPDX-License-Identifier: BSD-3-Clause
// A map's description; the image is one of four grey values.
#include "fuzz_target.hpp"
#include "hypermap/io/archive/map_server.hpp"
#include "targets.hpp"

#include <utility>

namespace hypermap::fuzz {
namespace {

Result<OccupancyLayer> map_layer_of(std::string_view yaml, MapDialect dialect) {
  const DecodedImage image{.width_px = 2, .height_px = 2, .samples8 = {0, 100, 205, 254}};
  HYPERMAP_ASSIGN_OR_RETURN(auto metadata, parse_map_metadata(yaml, kFuzzSource));
  HYPERMAP_ASSIGN_OR_RETURN(auto grid, grid_from_image(image, metadata.value, dialect));
  return OccupancyLayer(std::move(grid.value), std::move(metadata.value.extra));
}

}  // namespace

void fuzz_map(std::string_view bytes) {
  for (const MapDialect dialect : {MapDialect::kHypermap, MapDialect::kMapServer}) {
    const auto layer = map_layer_of(bytes, dialect);
    if (!layer) continue;
    const auto files = write_scale_map(*layer, "image.png");
    require(files.has_value(), "a map can be written");
    const auto again = parse_map_metadata(files->yaml, kFuzzSource);
    require(again.has_value(), "what was written is read");
    require(again->value.extra == layer->extra, "with the same unknown keys");
    require(again->value.resolution_m == layer->grid.geometry().resolution_m,
            "with the same resolution");
    static_cast<void>(without_rotation(layer->grid));
  }
}

}  // namespace hypermap::fuzz
