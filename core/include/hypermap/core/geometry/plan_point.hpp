// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A place in the plan of a map, with or without a height.
#pragma once

#include <Eigen/Core>

#include <optional>

namespace hypermap {

/// A point of the plan, at one height or, without one, at every height. Unit: metre.
struct PlanPoint {
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();
  std::optional<double> z = std::nullopt;
};

}  // namespace hypermap
