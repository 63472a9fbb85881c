// SPDX-License-Identifier: BSD-3-Clause
#include "asked_tiles.hpp"

#include "hypermap/io/jobs/tile_set.hpp"

#include <utility>

namespace hypermap::app {

std::optional<Rect> asked_region(const MapQuery& query) {
  if (!query.frame_id.empty() && query.frame_id != "map") return std::nullopt;
  if (query.area) return bounds(*query.area);
  if (query.at) return Rect{query.at->xy, query.at->xy};
  return std::nullopt;
}

Result<PartialMap> load_asked(const std::string& file,
                              const std::optional<Rect>& region,
                              const ArchiveParts& parts,
                              const LoadArguments& load) {
  const StopCheck stop = stop_when_interrupted();
  const bool is_divided = is_tile_set(file);
  if (!is_divided && parts.octrees && parts.objects && parts.class_grids) {
    HYPERMAP_ASSIGN_OR_RETURN(auto loaded,
                              load_archive(file, load.limits, archive_layer_types(), stop));
    return PartialMap{.map = std::move(loaded.value)};
  }
  if (!is_divided) {
    HYPERMAP_ASSIGN_OR_RETURN(
        auto loaded, load_archive_parts(file, parts, load.limits, archive_layer_types(), stop));
    return std::move(loaded.value);
  }
  HYPERMAP_ASSIGN_OR_RETURN(const TileSet set, read_tile_set(file));
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded,
                            load_tiles(set, tiles_reached(set, region), parts, load.limits, stop));
  return std::move(loaded.value);
}

}  // namespace hypermap::app
