// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A grid for each class, as semantic sensor models fill them.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"

#include <string>
#include <utility>
#include <vector>

namespace hypermap {

/// Errors: kInvalidArgument when there is none.
[[nodiscard]] Result<void> check_has_classes(const ClassRegistry& classes);

/// Where layers belong.
struct LayerPlace {
  std::string parent;
  std::string frame_id;
};

/// Unknown at first. Requires, throughout: ids and cells that are there.
class ClassLayers {
 public:
  /// Errors: kLimit when all grids together would have more than 2^30 cells; kOutOfMemory.
  [[nodiscard]] static Result<ClassLayers> create(const ClassRegistry& classes,
                                                  const LayerPlace& place,
                                                  const GridGeometry& geometry);

  void set(ClassId id, Cell cell, LogOddsSteps steps) { grids_[id.value].grid.set(cell, steps); }
  void set_all(Cell cell, LogOddsSteps steps) {
    for (SensorGrid& sensor : grids_) sensor.grid.set(cell, steps);
  }
  [[nodiscard]] LogOddsSteps at(ClassId id, Cell cell) const {
    return grids_[id.value].grid.at(cell);
  }

  /// By class, each the smallest around what it knows. Errors: kOutOfMemory.
  [[nodiscard]] Result<std::vector<SensorGrid>> cropped() &&;

 private:
  std::vector<SensorGrid> grids_;
};

}  // namespace hypermap
