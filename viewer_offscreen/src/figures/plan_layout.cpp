// SPDX-License-Identifier: BSD-3-Clause
#include "plan_layout.hpp"

#include <algorithm>

namespace hypermap {
namespace {

constexpr double kMaxPlanPageHeightPx = 1400.0;
constexpr double kMinPlanLayoutSideM = 1.0;

}  // namespace

PlanLayout plan_layout_of(const ComparedPlan& plan) {
  PlanLayout view;
  for (const auto* shapes : {&plan.truths, &plan.objects}) {
    for (const ComparedShape& shape : *shapes) {
      for (const Eigen::Vector2d& point : shape.footprint.outer) view.bounds.extend(point);
      view.bounds.extend(shape.centroid);
    }
  }
  if (view.bounds.isEmpty()) view.bounds.extend(Eigen::Vector2d::Zero());
  const Eigen::Vector2d sides = view.bounds.sizes().cwiseMax(kMinPlanLayoutSideM);
  const Eigen::Vector2d half = 0.54 * sides;
  const Eigen::Vector2d middle = view.bounds.center();
  view.bounds = Eigen::AlignedBox2d(middle - half, middle + half);
  view.px_per_m = std::min((kPlanPageWidthPx - 2.0 * kPlanPageMarginPx) / view.bounds.sizes().x(),
                           kMaxPlanPageHeightPx / view.bounds.sizes().y());
  // What the height leaves free on the sides is plan as well.
  const double width_m = (kPlanPageWidthPx - 2.0 * kPlanPageMarginPx) / view.px_per_m;
  const Eigen::Vector2d wide(0.5 * width_m, half.y());
  view.bounds = Eigen::AlignedBox2d(middle - wide, middle + wide);
  return view;
}

}  // namespace hypermap
