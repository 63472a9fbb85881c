// SPDX-License-Identifier: BSD-3-Clause
#include "export_folder.hpp"
#include "export_parts.hpp"
#include "hypermap/io/codec/staged_folder.hpp"
#include "hypermap/io/exports/map_stack.hpp"
#include "hypermap/io/tiles/tile_file.hpp"
#include "hypermap/projection/tiles/stored_map.hpp"
#include "hypermap/projection/tiles/tile_store.hpp"

#include <optional>
#include <set>
#include <string>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

constexpr int kExportedTileCells = 256;
constexpr std::string_view kEnding = ".tile";

Result<void> require_replaceable_tiles(const fs::path& folder) {
  return require_replaceable(
      folder, "tile", [](const std::string& name) { return name.ends_with(kEnding); });
}

/// Tiles of a folder that is not there yet: all of them are synced at once when it is put in place.
/// None is read before that.
class StagedTiles final : public TileStore {
 public:
  StagedTiles(const StagedFolder& folder, TileLattice lattice)
      : folder_(folder), lattice_(std::move(lattice)) {}

  [[nodiscard]] const TileLattice& lattice() const override { return lattice_; }
  [[nodiscard]] Result<void> put(const StackTile& tile) override {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string name, tile_file_name(lattice_, tile.index));
    HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, encode_tile(tile, lattice_));
    HYPERMAP_TRY(folder_.write(name, bytes));
    put_.insert(tile.index);
    return {};
  }
  [[nodiscard]] Result<std::optional<StackTile>> get(TileIndex /*index*/) const override {
    return fail(ErrorCode::kUnsupported, "tiles are not read while they are exported");
  }
  [[nodiscard]] Result<std::vector<TileIndex>> list() const override {
    return std::vector<TileIndex>(put_.begin(), put_.end());
  }

 private:
  const StagedFolder& folder_;
  TileLattice lattice_;
  std::set<TileIndex> put_;
};

}  // namespace

Result<WrittenFiles> export_tiles(const MapArchive& archive, const ExportRequest& request) {
  HYPERMAP_TRY(require_replaceable_tiles(request.output));
  HYPERMAP_ASSIGN_OR_RETURN(const GridStack stack,
                            stack_of_map(archive, {.of_classes = {.classes = request.classes}}));
  HYPERMAP_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(request.output));
  StagedTiles tiles(staged,
                    {.frame_id = stack.options().frame_id,
                     .resolution_m = stack.geometry().resolution_m,
                     .tile_cells = kExportedTileCells});
  HYPERMAP_TRY(store_stack(stack, tiles));
  WrittenFiles written;
  HYPERMAP_ASSIGN_OR_RETURN(const auto indices, tiles.list());
  for (const TileIndex index : indices) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string name, tile_file_name(tiles.lattice(), index));
    written.push_back(request.output / name);
  }
  HYPERMAP_TRY(require_replaceable_tiles(request.output));  // the writing took a while
  HYPERMAP_TRY(staged.commit());
  return written;
}

}  // namespace hypermap
