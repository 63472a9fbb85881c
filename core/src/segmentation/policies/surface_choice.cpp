// SPDX-License-Identifier: BSD-3-Clause
#include "surface_choice.hpp"

#include "level_faces.hpp"
#include "part_behind.hpp"
#include "parted_surfaces.hpp"
#include "support_contacts.hpp"
#include "surface_score.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace hypermap {
namespace {

/// A part has to widen what is covered of the box by this share; else it merely stands before it.
constexpr double kPartMinGain = 0.03;
/// Or it is a fragment of less than this share of the best surface and from above no larger than
/// this: a leaf, a blade, a leg, not what stands beside a bed.
constexpr double kFragmentShare = 0.2;
constexpr double kFragmentSizeM = 0.5;
/// A part is not the background seen through the object: of what is hidden more, only what is of an
/// upright face with the best surface, and the upper end of the box.
constexpr double kPartMinOutline = 0.3;
/// What stands out of its support covers at least this share of the box; else the object is flat.
constexpr double kStandsOutShare = 0.05;
/// And a flat object fills its box; otherwise the box shows only background and what is in the way,
/// and to say that nothing was found is better than to put the object in the wrong place.
constexpr double kFlatShare = 0.8;

/// Upright columns of space that a surface occupies, by their place on the floor plan.
struct Column {
  int x = 0;
  int y = 0;
  float low_m = 0.0F;
  float high_m = 0.0F;
};
using Columns = std::vector<Column>;  // ascending by (x, y), each place once

bool before(const Column& a, const Column& b) {
  return std::tie(a.x, a.y) < std::tie(b.x, b.y);
}

bool same_place(const Column& a, const Column& b) {
  return a.x == b.x && a.y == b.y;
}

/// Joins columns of one place.
Columns united(Columns columns) {
  std::sort(columns.begin(), columns.end(), before);
  Columns out;
  for (const Column& column : columns) {
    if (out.empty() || !same_place(out.back(), column)) {
      out.push_back(column);
      continue;
    }
    out.back().low_m = std::min(out.back().low_m, column.low_m);
    out.back().high_m = std::max(out.back().high_m, column.high_m);
  }
  return out;
}

Columns columns_of(const DepthWindow& window,
                   const DepthComponents& labelled,
                   std::uint32_t id,
                   const Eigen::Matrix3f& gravity_aligned_from_camera,
                   float edge_m) {
  Columns columns;
  for_each_cell_of(window, labelled, id, [&](int x, int y) {
    const Eigen::Vector3f point = gravity_aligned_from_camera * window.point_in_camera(x, y);
    const Column column{static_cast<int>(std::floor(point.x() / edge_m)),
                        static_cast<int>(std::floor(point.y() / edge_m)),
                        point.z(),
                        point.z()};
    if (columns.empty() || !same_place(columns.back(), column)) columns.push_back(column);
    columns.back().low_m = std::min(columns.back().low_m, point.z());
    columns.back().high_m = std::max(columns.back().high_m, point.z());
  });
  return united(std::move(columns));
}

/// Whether a column of `a` stands beside, over or under one of `b`.
bool are_near(const Columns& a, const Columns& b, float height_gap_m) {
  return std::any_of(a.begin(), a.end(), [&](const Column& column) {
    for (int x = column.x - 1; x <= column.x + 1; ++x) {
      auto other = std::lower_bound(b.begin(), b.end(), Column{.x = x, .y = column.y - 1}, before);
      for (; other != b.end() && other->x == x && other->y <= column.y + 1; ++other) {
        const float gap_m = std::max(other->low_m - column.high_m, column.low_m - other->high_m);
        if (gap_m <= height_gap_m) return true;
      }
    }
    return false;
  });
}

/// The diagonal of the rectangle along the axes that they cover of the plan.
double plan_size_m(const Columns& columns, double edge_m) {
  Eigen::AlignedBox2i cover;
  for (const Column& column : columns) cover.extend(Eigen::Vector2i(column.x, column.y));
  return cover.isEmpty() ? 0.0
                         : edge_m * (cover.sizes() + Eigen::Vector2i::Ones()).cast<double>().norm();
}

/// Surfaces that may complete the object, the largest first: no background, and not a few pixels.
ComponentIds part_candidates(const DepthWindow& window,
                             const DepthComponents& labelled,
                             std::uint32_t best,
                             const SupportContacts& supports,
                             const ForegroundOptions& options) {
  ComponentIds ids;
  const std::vector<bool> is_of_passed_support = supports.of_passed_supports(best);
  for (std::uint32_t id = 0; id < labelled.components.size(); ++id) {
    const DepthComponent& component = labelled.components[id];
    if (id == best || component.kind != 0 || component.num_in_box < 6) continue;
    if (is_of_passed_support[id] || supports.is_rim(id)) continue;
    if (is_of_competing_box(component, window)) continue;
    if (component.outside_share() <= options.part_max_outside) ids.push_back(id);
  }
  std::stable_sort(ids.begin(), ids.end(), [&](std::uint32_t a, std::uint32_t b) {
    return labelled.components[a].num_in_box > labelled.components[b].num_in_box;
  });
  return ids;
}

/// Adds surfaces near the best one that widen what is covered of the box, until none does: the seat
/// to the back of a chair, not the cup in front of a screen. And those that stand free behind it or
/// end the box there, and below or above it what the same thing hides.
ComponentIds with_parts(const DepthWindow& window,
                        const DepthComponents& labelled,
                        std::uint32_t best,
                        const SupportContacts& supports,
                        const Eigen::Matrix3f& gravity_aligned_from_camera,
                        const ForegroundOptions& options) {
  ComponentIds chosen{best};
  if (options.part_gap_m <= 0.0) return chosen;
  ComponentIds candidates = part_candidates(window, labelled, best, supports, options);
  if (candidates.empty()) return chosen;
  const auto columns = [&](std::uint32_t id) {
    return columns_of(
        window, labelled, id, gravity_aligned_from_camera, static_cast<float>(options.part_gap_m));
  };
  Columns reached = columns(best);
  PixelRect covered = labelled.components[best].bounds_in_box;
  const auto is_upright_with_best = [&](std::uint32_t id) {
    return are_one_upright_face(window, labelled, best, id, gravity_aligned_from_camera);
  };
  const auto is_other_level = [&](std::uint32_t id) {
    return are_two_levels(window, labelled, best, id, gravity_aligned_from_camera);
  };
  const auto joins = [&](std::uint32_t id) {
    const DepthComponent& component = labelled.components[id];
    const PixelRect wider = united(covered, component.bounds_in_box);
    const double gain = span_share(wider, window.box) - span_share(covered, window.box);
    const bool widens = gain >= kPartMinGain;
    const bool is_small =
        component.num_in_box < kFragmentShare * labelled.components[best].num_in_box;
    const bool is_hidden = component.outline_share() < kPartMinOutline;
    if (!widens && !is_small) return false;
    const bool is_top = widens && is_top_of_box(window, labelled, covered, best, id);
    if (is_hidden && !is_top && (!widens || is_small || !is_upright_with_best(id))) return false;
    const double height_gap_m = widens ? options.part_height_gap_m : options.part_gap_m;
    const Columns part = columns(id);
    if (!widens && plan_size_m(part, options.part_gap_m) > kFragmentSizeM) return false;
    if (!is_hidden && !is_top && !are_near(part, reached, static_cast<float>(height_gap_m)) &&
        !is_part_behind(window, labelled, best, id) &&
        !is_side_of_box(window, labelled, covered, best, id) &&
        !are_ends_of_one_face(window, labelled, best, id))
      return false;
    if (is_other_level(id)) return false;
    reached.insert(reached.end(), part.begin(), part.end());
    reached = united(std::move(reached));
    covered = wider;
    chosen.push_back(id);
    return true;
  };
  while (std::erase_if(candidates, joins) > 0) {
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

/// The component of the highest score; `only_planes` or else any.
std::uint32_t best_component(const DepthWindow& window,
                             const DepthComponents& labelled,
                             const SupportContacts& supports,
                             bool only_planes) {
  std::uint32_t best = kNoComponent;
  double best_score = 0.0;
  for (std::uint32_t id = 0; id < labelled.components.size(); ++id) {
    if (only_planes && labelled.components[id].kind == 0) continue;
    const double value = surface_score(window, labelled, supports, id);
    if (value <= best_score) continue;
    best = id;
    best_score = value;
  }
  return best;
}

}  // namespace

ComponentIds choose_surfaces(const RgbdFrame& frame,
                             const DepthWindow& window,
                             const DepthComponents& labelled,
                             const std::vector<Plane>& planes,
                             const ForegroundOptions& options) {
  const Eigen::Matrix3f gravity_aligned_from_camera =
      frame.map_from_camera.isometry().linear().cast<float>();
  const SupportContacts supports(
      frame.depth_m, window, labelled, planes, gravity_aligned_from_camera.row(2).transpose());
  const std::uint32_t best = best_component(window, labelled, supports, false);
  if (best == kNoComponent) return {};
  const std::vector<DepthComponent>& components = labelled.components;
  double num_in_box = 0.0;
  for (const DepthComponent& component : components) {
    if (component.kind != kOthersKind) num_in_box += component.num_in_box;
  }
  if (components[best].kind == 0 && !is_of_competing_box(components[best], window)) {
    ComponentIds chosen =
        with_parts(window, labelled, best, supports, gravity_aligned_from_camera, options);
    double num_chosen = 0.0;
    for (const std::uint32_t id : chosen) num_chosen += components[id].num_in_box;
    if (num_chosen >= kStandsOutShare * num_in_box) return chosen;
  }
  const std::uint32_t flat = best_component(window, labelled, supports, true);
  const bool is_flat =
      flat != kNoComponent && components[flat].num_in_box >= kFlatShare * num_in_box;
  return is_flat ? ComponentIds{flat} : ComponentIds{};
}

}  // namespace hypermap
