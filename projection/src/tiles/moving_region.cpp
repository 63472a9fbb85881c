// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/tiles/moving_region.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/base/option_rows.hpp"
#include "stack/resampler.hpp"
#include "tile_cells.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cassert>
#include <string>

namespace hypermap {
namespace {

constexpr int kMaxTilesAcross = 1000;

constexpr OptionRow kRegionRows[] = {
    option::count<&MovingRegionOptions::tile_cols>(
        "tile_cols",
        {.min = 1, .max = kMaxTilesAcross},
        {.unit = "tiles", .source = "[sogm] figure 8", .effect = "Width of the region."}),
    option::count<&MovingRegionOptions::tile_rows>(
        "tile_rows",
        {.min = 1, .max = kMaxTilesAcross},
        {.unit = "tiles", .source = "[sogm] figure 8", .effect = "Height of the region."}),
    option::number<&MovingRegionOptions::inner_margin_m>(
        "inner_margin_m",
        {.min = 0.0, .max = 1e6},
        {.unit = "m",
         .source = "[sogm] III-E",
         .effect = "How near the vehicle may come to the region's edge before it moves."}),
    option::section<&MovingRegionOptions::stack>("stack"),
};

/// A vehicle in the middle tile must be within the inner bounds, or the region would never rest.
Result<void> check_margin(const MovingRegionOptions& options, const TileLattice& lattice) {
  const int shorter = std::min(options.tile_cols, options.tile_rows);
  const double most_m = (shorter - 1) / 2.0 * lattice.tile_m();
  if (options.inner_margin_m <= most_m) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be at most " + number_text(most_m) + " m with tiles of " +
                  number_text(lattice.tile_m()) + " m, is " + number_text(options.inner_margin_m),
              "inner_margin_m");
}

std::set<TileIndex> tiles_of(const TileWindow& window) {
  std::set<TileIndex> tiles;
  for (int row = 0; row < window.rows; ++row) {
    for (int col = 0; col < window.cols; ++col) {
      tiles.insert({window.first.col + col, window.first.row + row});
    }
  }
  return tiles;
}

/// Those of the set that lie in the window, or those that do not.
std::set<TileIndex> chosen(const std::set<TileIndex>& tiles,
                           const TileWindow& window,
                           bool inside) {
  std::set<TileIndex> kept;
  for (const TileIndex tile : tiles) {
    if (window.contains(tile) == inside) kept.insert(tile);
  }
  return kept;
}

/// Cells that the sensor knows and whose centres lie outside the region.
std::size_t known_outside(const LogOddsGrid& sensor,
                          const Eigen::Matrix3d& map_from_sensor,
                          const GridGeometry& region) {
  const GridGeometry& own = sensor.geometry();
  const auto is_inside = [&](const Eigen::Vector2d& in_sensor) {
    const Eigen::Vector2d cells =
        to_cells(region, (map_from_sensor * in_sensor.homogeneous()).hnormalized());
    return (cells.array() >= 0.0).all() && cells.x() < region.cols && cells.y() < region.rows;
  };
  const Eigen::Vector2d end(own.cols, own.rows);
  const bool is_affine = map_from_sensor.row(2).head<2>().isZero(0.0);
  const bool is_all_inside = is_affine && is_inside(from_cells(own, {0.0, 0.0})) &&
                             is_inside(from_cells(own, {end.x(), 0.0})) &&
                             is_inside(from_cells(own, {0.0, end.y()})) &&
                             is_inside(from_cells(own, end));
  if (is_all_inside) return 0;
  std::size_t count = 0;
  for (int row = 0; row < own.rows; ++row) {
    for (int col = 0; col < own.cols; ++col) {
      const Cell cell{col, row};
      if (sensor.at(cell) != 0 && !is_inside(centre(own, cell))) ++count;
    }
  }
  return count;
}

TileFrame frame_of(const GridStack& stack,
                   TileIndex first,
                   const std::optional<GeographicDatum>& map_datum) {
  const std::string& map = stack.options().frame_id;
  const Eigen::Vector2d& corner = stack.geometry().origin;
  TileFrame frame{.map_from_tile = {.frame_id = map,
                                    .child_frame_id = map + "_tile_" + std::to_string(first.col) +
                                                      "_" + std::to_string(first.row),
                                    .x_m = corner.x(),
                                    .y_m = corner.y()}};
  if (map_datum) frame.datum = shifted(*map_datum, corner);
  return frame;
}

}  // namespace

const OptionTable& option_table(const MovingRegionOptions&) {
  static constexpr OptionTable kTable{kRegionRows};
  return kTable;
}

Result<void> validate(const MovingRegionOptions& options) {
  return check_options(options);
}

MovingRegion::MovingRegion(std::unique_ptr<TileStore> store,
                           MovingRegionOptions options,
                           Buffer first)
    : store_(std::move(store)), options_(std::move(options)), current_(std::move(first)) {}

Result<MovingRegion> MovingRegion::create(const Eigen::Vector2d& vehicle_in_map,
                                          std::unique_ptr<TileStore> store,
                                          MovingRegionOptions options) {
  assert(store != nullptr);
  const TileLattice& lattice = store->lattice();
  HYPERMAP_TRY(validate(options));
  HYPERMAP_TRY(validate(lattice));
  HYPERMAP_TRY(check_margin(options, lattice));
  options.stack.frame_id = lattice.frame_id;
  HYPERMAP_ASSIGN_OR_RETURN(
      const TileWindow window,
      window_around(lattice, vehicle_in_map, options.tile_cols, options.tile_rows));
  HYPERMAP_ASSIGN_OR_RETURN(Buffer buffer, unknown_buffer(*store, options, window));
  HYPERMAP_TRY(load_tiles(*store, TileWindow{.cols = 0, .rows = 0}, buffer));
  return MovingRegion(std::move(store), std::move(options), std::move(buffer));
}

Result<MovingRegion::Buffer> MovingRegion::unknown_buffer(const TileStore& store,
                                                          const MovingRegionOptions& options,
                                                          const TileWindow& window) {
  HYPERMAP_ASSIGN_OR_RETURN(const GridGeometry geometry, geometry_of(store.lattice(), window));
  HYPERMAP_ASSIGN_OR_RETURN(GridStack stack, GridStack::create(geometry, options.stack));
  return Buffer{.window = window, .stack = std::move(stack)};
}

/// The tiles of the buffer's window that do not lie in `known`.
Result<std::size_t> MovingRegion::load_tiles(const TileStore& store,
                                             const TileWindow& known,
                                             Buffer& buffer) {
  const LatticeCell first = first_cell(buffer.window.first, store.lattice());
  std::size_t num_loaded = 0;
  for (const TileIndex index : chosen(tiles_of(buffer.window), known, false)) {
    HYPERMAP_ASSIGN_OR_RETURN(const auto tile, store.get(index));
    if (!tile) continue;
    HYPERMAP_TRY(place_tile(*tile, first, store.lattice(), buffer.stack));
    buffer.stored.insert(index);
    ++num_loaded;
  }
  return num_loaded;
}

TileFrame MovingRegion::frame() const {
  return frame_of(current_.stack, current_.window.first, map_datum_);
}

Result<void> MovingRegion::set_datum(const std::optional<GeographicDatum>& map_datum) {
  if (map_datum) HYPERMAP_TRY(validate(*map_datum));
  map_datum_ = map_datum;
  return {};
}

bool MovingRegion::is_within_inner_bounds(const Eigen::Vector2d& vehicle) const {
  const Rect region = bounds(current_.stack.geometry());
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(options_.inner_margin_m);
  return (vehicle - region.min - margin).minCoeff() >= 0.0 &&
         (region.max - margin - vehicle).minCoeff() >= 0.0;
}

Result<void> MovingRegion::carry_overlap(Buffer& next) const {
  const TileLattice& lattice = store_->lattice();
  const Cell place =
      cell_from(first_cell(next.window.first, lattice), first_cell(current_.window.first, lattice));
  for (const auto& [name, grid] : current_.stack.layers()) {
    HYPERMAP_TRY(next.stack.replace_cells(name, grid, place));
  }
  next.stored = chosen(current_.stored, next.window, true);
  next.changed = chosen(current_.changed, next.window, true);
  return {};
}

Result<std::optional<TileChange>> MovingRegion::follow(const Eigen::Vector2d& vehicle_in_map) {
  HYPERMAP_ASSIGN_OR_RETURN(
      const TileWindow window,
      window_around(store_->lattice(), vehicle_in_map, options_.tile_cols, options_.tile_rows));
  if (window == current_.window || is_within_inner_bounds(vehicle_in_map)) {
    return std::optional<TileChange>();
  }
  return guarded(
      ErrorCode::kInvalidArgument, "the region", [&]() -> Result<std::optional<TileChange>> {
        TileChange change{.left = frame(), .entered = {}};
        HYPERMAP_ASSIGN_OR_RETURN(Buffer next, unknown_buffer(*store_, options_, window));
        HYPERMAP_TRY(carry_overlap(next));
        HYPERMAP_ASSIGN_OR_RETURN(change.num_loaded, load_tiles(*store_, current_.window, next));
        change.entered = frame_of(next.stack, window.first, map_datum_);
        HYPERMAP_ASSIGN_OR_RETURN(change.num_stored,
                                  store_changed(chosen(current_.changed, window, false)));
        last_ = std::move(current_.stack);
        current_ = std::move(next);
        return std::optional(std::move(change));
      });
}

Result<std::size_t> MovingRegion::fuse(const SensorGrid& sensor,
                                       const Eigen::Matrix3d& map_from_sensor,
                                       const ResamplingOptions& resampling) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::size_t num_reached,
                            current_.stack.fuse(sensor, map_from_sensor, resampling));
  num_outside_ += known_outside(sensor.grid, map_from_sensor, current_.stack.geometry());
  if (num_reached > 0) mark_changed(sensor, map_from_sensor, resampling);
  return num_reached;
}

Result<std::size_t> MovingRegion::fuse(const SensorGrid& sensor,
                                       const FrameTree& frames,
                                       const ResamplingOptions& resampling) {
  HYPERMAP_ASSIGN_OR_RETURN(const Eigen::Isometry2d map_from_sensor,
                            frames.to_from(current_.stack.options().frame_id, sensor.frame_id));
  return fuse(sensor, Eigen::Matrix3d(map_from_sensor.matrix()), resampling);
}

/// The tiles that the sensor's grid reaches. Requires: it was fused.
void MovingRegion::mark_changed(const SensorGrid& sensor,
                                const Eigen::Matrix3d& map_from_sensor,
                                const ResamplingOptions& resampling) {
  const auto resampler =
      Resampler::create(sensor.grid, current_.stack.geometry(), map_from_sensor, resampling);
  assert(resampler);
  if (!resampler) return;
  const int side = store_->lattice().tile_cells;
  const CellWindow& reached = resampler->window();
  const TileIndex& first = current_.window.first;
  for (int row = reached.first.row / side; row <= (reached.end.row - 1) / side; ++row) {
    for (int col = reached.first.col / side; col <= (reached.end.col - 1) / side; ++col) {
      current_.changed.insert({first.col + col, first.row + row});
    }
  }
}

/// Of those given, all of them changed; what is put is no longer so. A tile of which nothing is
/// known is put only over one that knew something.
Result<std::size_t> MovingRegion::store_changed(const std::set<TileIndex>& tiles) {
  const TileLattice& lattice = store_->lattice();
  const LatticeCell first = first_cell(current_.window.first, lattice);
  std::size_t num_stored = 0;
  for (const TileIndex index : tiles) {
    HYPERMAP_ASSIGN_OR_RETURN(StackTile tile, tile_of(current_.stack, first, index, lattice));
    if (map_datum_) {
      HYPERMAP_ASSIGN_OR_RETURN(const GridGeometry cells, geometry_of(lattice, {.first = index}));
      tile.datum = shifted(*map_datum_, cells.origin);
    }
    if (!tile.layers.empty() || current_.stored.contains(index)) {
      HYPERMAP_TRY(store_->put(tile));
      current_.stored.insert(index);
      ++num_stored;
    }
    current_.changed.erase(index);
  }
  return num_stored;
}

Result<std::size_t> MovingRegion::store_changes() {
  return guarded(ErrorCode::kInvalidArgument, "the region", [&] {
    return store_changed(std::set<TileIndex>(current_.changed));
  });
}

}  // namespace hypermap
