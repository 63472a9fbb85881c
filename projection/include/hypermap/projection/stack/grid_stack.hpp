// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What is known of each cell of the plane on several semantic layers at once, from sensors of any
/// kind that say it as grids.
///
/// Source: [sogm] III-A, III-B, III-E, Eq. (1), Eq. (2).
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/layers/frame_tree.hpp"
#include "hypermap/projection/stack/log_odds_grid.hpp"
#include "hypermap/projection/stack/resampling.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace hypermap {

struct OptionTable;

struct GridStackOptions {
  std::string parent = "/ism";   ///< Layers have names below this one: "/ism/a", "/ism/a/b".
  std::string frame_id = "map";  ///< In which the geometry lies.
  LogOdds max_log_odds{13.815};  ///< Evidence saturates here, for and against. Unit: log-odds.
  /// Share of a cell's log-odds that stays when new evidence reaches the cell; below 1 old evidence
  /// is forgotten, and the order in which grids are fused counts.
  double keep_share = 1.0;
  friend bool operator==(const GridStackOptions&, const GridStackOptions&) = default;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const GridStackOptions& options);
[[nodiscard]] const OptionTable& option_table(const GridStackOptions& options);

/// The largest factor of a sensor's evidence.
inline constexpr double kMaxSensorWeight = 1000.0;

/// An inverse sensor model: what one source says of the plane now.
struct SensorGrid {
  std::string layer;             ///< "/ism/laser": sources of one layer are fused.
  std::string frame_id = "map";  ///< In which `grid` lies.
  LogOddsGrid grid = {};
  /// Factor of its log-odds. A source that speaks n times as often as another one speaks as loud
  /// with a weight of 1/n: its readings are not independent.
  double weight = 1.0;
};

/// Layers of log-odds on the cells of one geometry; each layer is one M of [sogm] Eq. (2).
///
/// A value: copy it, compare it. Stacks that were given the same evidence in any order are equal,
/// as long as no cell saturates and nothing is forgotten.
class GridStack {
 public:
  using Layers = std::map<std::string, LogOddsGrid, std::less<>>;

  /// Without layers. Errors: those of validate; kInvalidArgument when the geometry has no cells.
  [[nodiscard]] static Result<GridStack> create(const GridGeometry& geometry,
                                                GridStackOptions options = {});
  /// With layers that were fused before. Errors: also those of fuse for names and sizes;
  /// kInvalidArgument for a layer of another geometry or a cell beyond `max_log_odds`.
  [[nodiscard]] static Result<GridStack> create(const GridGeometry& geometry,
                                                GridStackOptions options,
                                                Layers layers);

  [[nodiscard]] const GridGeometry& geometry() const noexcept { return geometry_; }
  [[nodiscard]] const GridStackOptions& options() const noexcept { return options_; }
  [[nodiscard]] const Layers& layers() const noexcept { return layers_; }  ///< By name.

  /// Adds what `sensor` says to its layer, which is made when it is not there; gives the number of
  /// cells that it reached.
  ///
  /// Source: [sogm] Eq. (1) in log-odds: l += weight * l(sensor). Cells that it does not know, and
  /// those whose share comes to less than half a step, stay as they are.
  /// Frame: `stack_from_sensor` as target_from_source of `resampled`; `sensor.frame_id` is not
  /// asked. Errors: kInvalidArgument for a name that is not below `parent`, is longer than 512
  /// bytes or has an empty part, for a weight that is not in (0, kMaxSensorWeight], and as
  /// `resampled`; kLimit when all layers together would have more than 2^30 cells; kOutOfMemory.
  /// Then the stack is as it was. Cost: as `resampled`, for the cells that the sensor's grid
  /// covers.
  [[nodiscard]] Result<std::size_t> fuse(const SensorGrid& sensor,
                                         const Eigen::Matrix3d& stack_from_sensor,
                                         const ResamplingOptions& resampling = {});
  /// The same where `frames` say how the sensor's frame lies to the stack's.
  /// Errors: also those of FrameTree::to_from.
  [[nodiscard]] Result<std::size_t> fuse(const SensorGrid& sensor,
                                         const FrameTree& frames,
                                         const ResamplingOptions& resampling = {});

  /// Puts the cells of `grid` in the place of those that a layer has from `first` on; the layer is
  /// made when it is not there. Exact: nothing is resampled, and where `grid` says that it lies is
  /// not asked. Boundary: what reaches beyond the stack is left out. Errors: kInvalidArgument for
  /// the name as `fuse`, and for a cell beyond max_log_odds; kLimit as `fuse`; kOutOfMemory. Then
  /// the stack is as it was.
  [[nodiscard]] Result<void> replace_cells(const std::string& layer,
                                           const LogOddsGrid& grid,
                                           Cell first = {});

  friend bool operator==(const GridStack&, const GridStack&) = default;

 private:
  [[nodiscard]] Result<void> check_new_layer(const std::string& layer) const;
  GridStack(const GridGeometry& geometry, GridStackOptions options)
      : geometry_(geometry), options_(std::move(options)) {}

  GridGeometry geometry_;
  GridStackOptions options_;
  Layers layers_;
};

/// The name of a class's or another map's layer in a stack: below the parent, slashes replaced.
[[nodiscard]] std::string stack_layer_name(std::string_view parent, std::string_view name);
/// The last part of a layer's name, of a class's layer the class: "b" of "/ism/a/b".
[[nodiscard]] std::string_view last_part(std::string_view layer);

/// Whether a layer is the one of that name or lies below it: "/ism/a/b" is of "/ism/a".
[[nodiscard]] bool is_at_or_below(std::string_view layer, std::string_view name);

}  // namespace hypermap
