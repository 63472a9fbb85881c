// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where the picture of a plan has its metres.
#pragma once

#include "hypermap/core/evaluation/compared_plan.hpp"

#include <Eigen/Geometry>

namespace hypermap {

inline constexpr int kPlanPageWidthPx = 1280;  ///< Of the whole picture.
inline constexpr int kPlanPageMarginPx = 40;   ///< On both sides of the plan.
inline constexpr int kPlanPageTopPx = 64;      ///< Above it.

/// Metres of the plan as pixels of the picture.
struct PlanLayout {
  Eigen::AlignedBox2d bounds;
  double px_per_m = 1.0;

  [[nodiscard]] Eigen::Vector2d to_px(const Eigen::Vector2d& point) const {
    return {kPlanPageMarginPx + px_per_m * (point.x() - bounds.min().x()),
            kPlanPageTopPx + px_per_m * (bounds.max().y() - point.y())};
  }
  [[nodiscard]] double height_px() const { return px_per_m * bounds.sizes().y(); }
};

/// The largest view that holds all shapes in that width, and is not too high for a screen.
[[nodiscard]] PlanLayout plan_layout_of(const ComparedPlan& plan);

}  // namespace hypermap
