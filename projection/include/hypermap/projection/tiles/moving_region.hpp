// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The region of interest around a vehicle, as a stack that moves over a store of tiles.
///
/// Source: [sogm] III-E, figures 7 and 8: tile publisher and map server.
/// Deviation: the region moves by whole tiles of a fixed lattice, so that a tile has one place for
/// ever and what is stored can be entered again.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/layers/frame_tree.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"
#include "hypermap/projection/stack/resampling.hpp"
#include "hypermap/projection/tiles/geographic_datum.hpp"
#include "hypermap/projection/tiles/tile_lattice.hpp"
#include "hypermap/projection/tiles/tile_store.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <utility>

namespace hypermap {

struct OptionTable;

struct MovingRegionOptions {
  int tile_cols = 3;  ///< Tiles side by side along x, W of [sogm] figure 8. Unit: tiles.
  int tile_rows = 3;  ///< Along y, H of the figure. Unit: tiles.
  /// The inner bounds lie so far within the region's. What a sensor says farther away than this
  /// may lie outside, and is then not kept. At most half a tile less than half the region's
  /// shorter side: then a vehicle in the middle tile is within.
  double inner_margin_m = 5.0;
  GridStackOptions stack = {};  ///< Its frame is the lattice's, whatever stands there.
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const MovingRegionOptions& options);
[[nodiscard]] const OptionTable& option_table(const MovingRegionOptions& options);

/// What is announced of a region: the tuple of pose, geographic datum and name of [sogm] III-E.
///
/// The name belongs to the place: one that was announced always stands for the same pose.
struct TileFrame {
  /// Pose of the region's lower-left corner in the frame of the map, and both names:
  /// `<frame>_tile_<col>_<row>` by the region's lower-left tile. To be added to a FrameTree.
  FrameTransform map_from_tile;
  std::optional<GeographicDatum> datum = {};  ///< Of that corner.
  friend bool operator==(const TileFrame&, const TileFrame&) = default;
};

/// The region has moved.
struct TileChange {
  TileFrame left;
  TileFrame entered;
  std::size_t num_stored = 0;  ///< Tiles that left the region and had changed.
  std::size_t num_loaded = 0;  ///< Tiles that came from the store.
};

/// A stack of the cells around a vehicle. It fuses sensors' grids; when the vehicle leaves the
/// inner bounds, the region moves by whole tiles: cells that stay are carried over as they are,
/// tiles that leave are put into the store, tiles that are entered come from there.
///
/// Whatever way the vehicle takes, store and region together hold what one large stack would: to
/// the bit, as long as what sensors say lies within the region. Memory: two regions, the current
/// and the last one. Movable.
class MovingRegion {
 public:
  /// A region around the vehicle, with what the store has of it.
  /// Errors: those of validate(MovingRegionOptions), validate(TileLattice) of the store's lattice,
  /// window_around, GridStack::create and TileStore::get; kInvalidArgument for a margin that is too
  /// large for the lattice, and for a stored tile that the options of the stack do not allow.
  /// Requires: `store` is not null.
  [[nodiscard]] static Result<MovingRegion> create(const Eigen::Vector2d& vehicle_in_map,
                                                   std::unique_ptr<TileStore> store,
                                                   MovingRegionOptions options = {});

  [[nodiscard]] const GridStack& stack() const noexcept { return current_.stack; }
  /// As it was when the region moved, for those who still work in the last frame: the other half of
  /// the double buffer. None before the first move.
  [[nodiscard]] const std::optional<GridStack>& last_stack() const noexcept { return last_; }
  [[nodiscard]] const TileStore& store() const noexcept { return *store_; }
  [[nodiscard]] const TileWindow& window() const noexcept { return current_.window; }
  /// Cells of sensors' grids whose centres lay outside the region when they were fused, since it
  /// was created: what was known there is not kept. More than a few say that `inner_margin_m` is
  /// less than the sensors' range.
  [[nodiscard]] std::size_t num_outside() const noexcept { return num_outside_; }
  [[nodiscard]] TileFrame frame() const;

  /// Where on Earth the origin of the map's frame lies, from now on; none when it is not known.
  /// Errors: those of validate(GeographicDatum).
  [[nodiscard]] Result<void> set_datum(const std::optional<GeographicDatum>& map_datum);

  /// Moves the region when the vehicle is not within the inner bounds, so that it is in the middle
  /// tile; tells the change. None when it stays.
  /// Errors: as create, and those of TileStore::put; then the region is as it was. Boundary: a
  /// vehicle on the inner bounds is within. Cost: a copy of the region, and the store's.
  [[nodiscard]] Result<std::optional<TileChange>> follow(const Eigen::Vector2d& vehicle_in_map);

  /// As GridStack::fuse; `map_from_sensor` takes points of the sensor's frame to the map's.
  /// What the sensor says of cells outside the region is not kept, but counted: num_outside.
  [[nodiscard]] Result<std::size_t> fuse(const SensorGrid& sensor,
                                         const Eigen::Matrix3d& map_from_sensor,
                                         const ResamplingOptions& resampling = {});
  /// The same where `frames` say how the sensor's frame lies to the map's.
  /// Errors: also those of FrameTree::to_from.
  [[nodiscard]] Result<std::size_t> fuse(const SensorGrid& sensor,
                                         const FrameTree& frames,
                                         const ResamplingOptions& resampling = {});

  /// Puts the tiles of the region that changed since they were loaded or put; gives their number.
  /// To be called when a drive ends, and as often as others are to see the region's tiles.
  /// Errors: those of TileStore::put; some tiles may be put then, the others still are to be.
  [[nodiscard]] Result<std::size_t> store_changes();

 private:
  /// A window of the lattice and what is known of it.
  struct Buffer {
    TileWindow window;
    GridStack stack;
    std::set<TileIndex> stored = {};   ///< Tiles of the window that the store has.
    std::set<TileIndex> changed = {};  ///< Tiles of the window that differ from the store's.
  };

  MovingRegion(std::unique_ptr<TileStore> store, MovingRegionOptions options, Buffer first);
  [[nodiscard]] static Result<Buffer> unknown_buffer(const TileStore& store,
                                                     const MovingRegionOptions& options,
                                                     const TileWindow& window);
  [[nodiscard]] static Result<std::size_t> load_tiles(const TileStore& store,
                                                      const TileWindow& known,
                                                      Buffer& buffer);
  [[nodiscard]] bool is_within_inner_bounds(const Eigen::Vector2d& vehicle) const;
  [[nodiscard]] Result<void> carry_overlap(Buffer& next) const;
  [[nodiscard]] Result<std::size_t> store_changed(const std::set<TileIndex>& tiles);
  void mark_changed(const SensorGrid& sensor,
                    const Eigen::Matrix3d& map_from_sensor,
                    const ResamplingOptions& resampling);

  std::unique_ptr<TileStore> store_;
  MovingRegionOptions options_;
  std::optional<GeographicDatum> map_datum_;
  Buffer current_;
  std::optional<GridStack> last_;
  std::size_t num_outside_ = 0;
};

}  // namespace hypermap
