// SPDX-License-Identifier: BSD-3-Clause
#include "places/pair_rules.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// The highest share of a holder's surface that its top is made of.
constexpr double kTopShare = 0.1;
/// Footprints that have more in common are not beside each other.
constexpr double kMostInCommon = 0.5;

/// Heights at which a foot touches a surface.
struct FootWindow {
  double low_m = 0.0;
  double high_m = 0.0;
  [[nodiscard]] bool contains(double height_m) const {
    return height_m >= low_m && height_m <= high_m;
  }
};

/// Sums of decimal fractions round: a gap of exactly the greatest one counts.
constexpr double kRoundingM = 1e-9;

FootWindow window_below(const PlacedShape& a, const RelationOptions& options) {
  return {.low_m = a.foot_m() - options.gap_voxels * voxel_of(options) - kRoundingM,
          .high_m = a.foot_m() + options.sink_voxels * voxel_of(options) + kRoundingM};
}

/// A surface at the foot of an object.
struct SurfaceContact {
  double height_m = 0.0;
  double share = 0.0;  ///< Of the surface around the foot.
  RelationSource source = RelationSource::kPoints;
};

/// The top of b's columns in and around a's footprint: what `a` hides of it is seen around it.
std::optional<SurfaceContact> contact_below(const PlacedShape& a,
                                            const PlacedShape& b,
                                            const RelationOptions& options) {
  const FootWindow window = window_below(a, options);
  const std::vector<Column> around = b.surface.within(a.footprint, 2.0 * voxel_of(options));
  if (around.empty()) {
    if (!window.contains(b.top_m())) return std::nullopt;
    return SurfaceContact{b.top_m(), 1.0, RelationSource::kBoxes};
  }
  std::vector<double> at_foot;
  for (const Column& column : around) {
    if (window.contains(column.top_m)) at_foot.push_back(column.top_m);
  }
  if (at_foot.empty()) return std::nullopt;
  const double share = static_cast<double>(at_foot.size()) / static_cast<double>(around.size());
  return SurfaceContact{lower_median(std::move(at_foot)), share, RelationSource::kPoints};
}

/// How much of an object lies below another one.
struct Clearance {
  double share = 0.0;   ///< Of its plan.
  double free_m = 0.0;  ///< Median over that.
  RelationSource source = RelationSource::kPoints;
};

std::optional<Clearance> clearance_of_boxes(const PlacedShape& a, const PlacedShape& b) {
  const double free_m = b.foot_m() - a.top_m();
  if (free_m < 0.0) return std::nullopt;
  return Clearance{covered_share(a.footprint, b.footprint), free_m, RelationSource::kBoxes};
}

std::optional<Clearance> clearance_below(const PlacedShape& a, const PlacedShape& b) {
  if (a.surface.empty() || b.surface.empty()) return clearance_of_boxes(a, b);
  std::vector<double> free_m;
  for (const Column& own : a.surface.columns()) {
    const Column* above = b.surface.find(own.x, own.y);
    if (above != nullptr && above->bottom_m >= own.top_m) {
      free_m.push_back(above->bottom_m - own.top_m);
    }
  }
  if (free_m.empty()) return std::nullopt;
  const double share =
      static_cast<double>(free_m.size()) / static_cast<double>(a.surface.columns().size());
  return Clearance{share, lower_median(std::move(free_m)), RelationSource::kPoints};
}

/// The share of a's prism below `top_m` that lies in b's; none when less than `least`.
std::optional<RelationEvidence> inside_evidence(const PlacedShape& a,
                                                const PlacedShape& b,
                                                double top_m,
                                                double least) {
  // What holds is larger and not higher: with `on_evidence`, nobody carries himself over others.
  if (!(b.volume_m3 > a.volume_m3) || b.foot_m() > a.foot_m()) return std::nullopt;
  if (a.height_m() <= 0.0) return std::nullopt;
  const double common_m = std::min(a.top_m(), top_m) - std::max(a.foot_m(), b.foot_m());
  const double height_share = std::max(0.0, common_m) / a.height_m();
  if (height_share * most_covered_share(a, b) < least) return std::nullopt;
  const double plan_share = covered_share(a.footprint, b.footprint);
  if (height_share * plan_share < least) return std::nullopt;
  return RelationEvidence{.plan_share = plan_share,
                          .inside_share = height_share * plan_share,
                          .source = b.surface.empty() || a.surface.empty()
                                        ? RelationSource::kBoxes
                                        : RelationSource::kPoints};
}

/// Whether b has points within a column's width, and a voxel's height, of the column.
bool is_on_surface(const Column& column, const ColumnSurface& surface, double voxel_m) {
  for (std::int32_t dx = -1; dx <= 1; ++dx) {
    for (std::int32_t dy = -1; dy <= 1; ++dy) {
      const Column* near = surface.find(column.x + dx, column.y + dy);
      if (near != nullptr && near->bottom_m <= column.top_m + voxel_m &&
          near->top_m >= column.bottom_m - voxel_m) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

std::optional<RelationEvidence> on_evidence(const PlacedShape& a,
                                            const PlacedShape& b,
                                            const RelationOptions& options) {
  // Strictly higher feet: no two objects support each other, over others either.
  if (!(a.foot_m() > b.foot_m()) || window_below(a, options).low_m > b.top_m()) return std::nullopt;
  if (most_covered_share(a, b) < options.min_support_share) return std::nullopt;
  const double plan_share = covered_share(a.footprint, b.footprint);
  if (plan_share < options.min_support_share) return std::nullopt;
  const auto contact = contact_below(a, b, options);
  if (!contact || contact->share < options.min_surface_share) return std::nullopt;
  return RelationEvidence{.plan_share = plan_share,
                          .gap_m = a.foot_m() - contact->height_m,
                          .contact_height_m = contact->height_m,
                          .contact_share = contact->share,
                          .source = contact->source};
}

std::optional<RelationEvidence> under_evidence(const PlacedShape& a,
                                               const PlacedShape& b,
                                               const RelationOptions& options) {
  if (b.top_m() < a.foot_m()) return std::nullopt;
  if (most_covered_share(a, b) < options.min_under_share) return std::nullopt;
  const auto clearance = clearance_below(a, b);
  if (!clearance || clearance->share < options.min_under_share) return std::nullopt;
  const bool touches = clearance->free_m <= options.gap_voxels * voxel_of(options) + kRoundingM;
  if (touches || clearance->free_m > options.max_clearance_m + kRoundingM) return std::nullopt;
  return RelationEvidence{
      .plan_share = clearance->share, .gap_m = clearance->free_m, .source = clearance->source};
}

std::optional<RelationEvidence> in_evidence(const PlacedShape& a,
                                            const PlacedShape& b,
                                            const RelationOptions& options) {
  const double top_m = b.surface.empty() ? b.top_m() : b.surface.height_reached_by(kTopShare);
  return inside_evidence(a, b, top_m, options.min_inside_share);
}

std::optional<RelationEvidence> part_evidence(const PlacedShape& a,
                                              const PlacedShape& b,
                                              const RelationOptions& options) {
  auto evidence = inside_evidence(a, b, b.top_m(), options.min_part_share);
  if (!evidence || evidence->source == RelationSource::kBoxes) return std::nullopt;
  const auto columns = a.surface.columns();
  const auto common = std::count_if(columns.begin(), columns.end(), [&](const Column& column) {
    return is_on_surface(column, b.surface, voxel_of(options));
  });
  evidence->contact_share = static_cast<double>(common) / static_cast<double>(columns.size());
  if (*evidence->contact_share < options.min_contact_share) return std::nullopt;
  return evidence;
}

std::optional<RelationEvidence> beside_evidence(const PlacedShape& a,
                                                const PlacedShape& b,
                                                const RelationOptions& options) {
  const double foot_share = options.max_foot_share * std::min(a.height_m(), b.height_m());
  const double most_m = std::max(foot_share, options.gap_voxels * voxel_of(options)) + kRoundingM;
  if (std::abs(a.foot_m() - b.foot_m()) > most_m || common_height_m(a, b) <= 0.0) {
    return std::nullopt;
  }
  const double reach = std::min(reach_m(a, options), reach_m(b, options));
  const double gap_m = distance_m(a.footprint, b.footprint);
  if (gap_m > reach) return std::nullopt;
  if (gap_m == 0.0 && std::max(covered_share(a.footprint, b.footprint),
                               covered_share(b.footprint, a.footprint)) > kMostInCommon) {
    return std::nullopt;
  }
  return RelationEvidence{.gap_m = gap_m};
}

double reach_m(const PlacedShape& shape, const RelationOptions& options) {
  return std::clamp(
      options.reach_share * shape.longest_side_m, options.least_reach_m, options.max_reach_m);
}

}  // namespace hypermap
