// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What one reading of a sensor says of the plane, as grids for a stack.
///
/// Source: [sogm] III-B: each pair of sensor and algorithm has its own inverse sensor model, which
/// turns what it puts out into a grid of occupancies.
#pragma once

#include "hypermap/core/base/log_odds.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"

#include <vector>

namespace hypermap {

struct OptionTable;

namespace frame {
struct Scanner {};  ///< Of a range sensor: +x ahead, +y left, +z up; it scans its plane z = 0.
}  // namespace frame

using MapFromScanner = Transform<frame::Map, frame::Scanner>;

/// What a reading is worth to a cell, and how large cells are.
struct EvidenceOptions {
  double resolution_m = 0.05;  ///< Edge of a cell.
  Probability p_hit{0.7};      ///< That a cell in which something was measured is occupied.
  Probability p_free{0.4};     ///< That a cell that was seen free is occupied.
  friend bool operator==(const EvidenceOptions&, const EvidenceOptions&) = default;
};

/// Errors: kInvalidArgument naming the field: p_hit is above 0.5 and below 1, p_free above 0 and
/// below 0.5.
[[nodiscard]] Result<void> validate(const EvidenceOptions& options);
[[nodiscard]] const OptionTable& option_table(const EvidenceOptions& options);

/// In which heights things are the ground or obstacles.
struct HeightOptions {
  double ground_m = 0.0;             ///< Height of the ground. Frame: Map.
  double ground_tolerance_m = 0.05;  ///< What lies so near to that height is the ground.
  double max_obstacle_m = 1.8;       ///< Above the ground; what is higher is no obstacle.
  friend bool operator==(const HeightOptions&, const HeightOptions&) = default;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const HeightOptions& options);
[[nodiscard]] const OptionTable& option_table(const HeightOptions& options);

/// Turns readings of one kind, which bear their pose in the map, into grids. Whoever has another
/// sensor derives from it; nothing of ours changes.
///
/// What every model keeps (tests/projection/sensor_models/sensor_model_contract.hpp): grids lie in
/// the map's frame, unturned, their cells' edges at whole multiples of the resolution from its
/// origin; what the reading says nothing of has log-odds 0; a reading in which nothing was measured
/// gives grids that know nothing, of at least one cell; ranges and depths that are NaN, negative or
/// 0 are no measurements; a sensor moved by whole cells, in a world that moves with it, gives the
/// same grids moved. The layers are the same with every reading, in the same order.
template <class Reading>
class InverseSensorModel {
 public:
  InverseSensorModel() = default;
  InverseSensorModel(const InverseSensorModel&) = default;
  InverseSensorModel(InverseSensorModel&&) noexcept = default;
  InverseSensorModel& operator=(const InverseSensorModel&) = default;
  InverseSensorModel& operator=(InverseSensorModel&&) noexcept = default;
  virtual ~InverseSensorModel() = default;

  /// One grid for each layer that the model speaks of.
  /// Errors: kInvalidArgument for a reading that breaks its own rules, such as a pose that is no
  /// rigid motion; kLimit when the grids would have too many cells; kOutOfMemory.
  [[nodiscard]] virtual Result<std::vector<SensorGrid>> grids(const Reading& reading) const = 0;
};

}  // namespace hypermap
