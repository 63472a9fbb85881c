// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/completion/completion.hpp"
#include "hypermap/core/objects/object_outline.hpp"
#include "seen_directions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// Boxes of objects that were seen whole differ from the truth by as much.
constexpr double kLeastGrowthM = 0.05;
/// Share of a usual side that must be lacking at least: sides within a class differ by less than
/// that, and what lacks less may be small of its class. Not asked of heights: free space above and
/// the lowest bottom below bound them.
constexpr double kLeastLackingSide = 1.0 / 3.0;
/// Most of the added part that may be known to be free: between its legs and before its back about
/// half of a chair's own box is.
constexpr double kMostKnownFree = 0.6;
/// Known shares that differ by less say nothing about which end it is.
constexpr double kClearDifference = 0.1;
constexpr double kSampleM = 0.05;
constexpr int kMostSamples = 20;  ///< Along an edge.

enum class BoxEnd { kLow, kHigh };

/// What would be added at one end.
struct Growth {
  BoxEnd end = BoxEnd::kLow;
  double by_m = 0.0;
  double known_free = 0.0;  ///< Share of the added part.
  bool faced = false;       ///< By a detection.
};

Eigen::Vector3d unit(Eigen::Index axis) {
  return Eigen::Vector3d::Unit(axis);
}

/// The part alone that lies beyond one end of the box.
TurnedBox part_beyond(const TurnedBox& box, Eigen::Index axis, const Growth& growth) {
  TurnedBox part = box;
  if (growth.end == BoxEnd::kLow) {
    part.high[axis] = box.low[axis];
    part.low[axis] = box.low[axis] - growth.by_m;
  } else {
    part.low[axis] = box.high[axis];
    part.high[axis] = box.high[axis] + growth.by_m;
  }
  return part;
}

int num_samples(double length_m) {
  const double wanted = std::ceil(length_m / kSampleM);
  return static_cast<int>(std::clamp(wanted, 1.0, static_cast<double>(kMostSamples)));
}

/// Share of evenly spaced points of the box that are known to be free.
double known_free_share(const TurnedBox& box, const KnownFree& is_free) {
  const Eigen::Vector3d extent = box.extent();
  const std::array<int, 3> n{
      num_samples(extent.x()), num_samples(extent.y()), num_samples(extent.z())};
  const Eigen::Vector3d step(extent.x() / n[0], extent.y() / n[1], extent.z() / n[2]);
  int num_free = 0;
  for (int i = 0; i < n[0]; ++i) {
    for (int j = 0; j < n[1]; ++j) {
      for (int k = 0; k < n[2]; ++k) {
        const Eigen::Vector3d own =
            box.low + step.cwiseProduct(Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5));
        num_free += is_free(PointInMap{box.map_from_box * own}) ? 1 : 0;
      }
    }
  }
  return static_cast<double>(num_free) / (n[0] * n[1] * n[2]);
}

/// The extent that is usual along each axis of the box.
Eigen::Vector3d usual_extent(const TurnedBox& seen, const UsualSize& usual) {
  const double side_m = seen.extent().x();
  const bool is_longer = std::abs(side_m - usual.longer_m) <= std::abs(side_m - usual.shorter_m);
  return is_longer ? Eigen::Vector3d(usual.longer_m, usual.shorter_m, usual.height_m)
                   : Eigen::Vector3d(usual.shorter_m, usual.longer_m, usual.height_m);
}

/// Says of one object's box at which end what it lacks is to be added.
class GrowthChoice {
 public:
  GrowthChoice(const Object& object, const UsualSizes& usual, const KnownFree& is_free)
      : seen_(turned_box_of(object)),
        directions_(seen_directions(object.observation_log)),
        lowest_m_(usual.lowest_m),
        is_free_(is_free) {}

  [[nodiscard]] const TurnedBox& seen() const { return seen_; }

  [[nodiscard]] std::optional<Growth> along(Eigen::Index axis, double missing_m) const {
    const auto low = growth_at(BoxEnd::kLow, axis, missing_m);
    const auto high = growth_at(BoxEnd::kHigh, axis, missing_m);
    if (!low || !high) return low ? low : high;
    if (std::abs(low->known_free - high->known_free) >= kClearDifference) {
      return low->known_free < high->known_free ? low : high;
    }
    if (low->faced == high->faced) return std::nullopt;
    return low->faced ? high : low;
  }

 private:
  /// None where the object cannot go on.
  [[nodiscard]] std::optional<Growth> growth_at(BoxEnd end,
                                                Eigen::Index axis,
                                                double missing_m) const {
    const bool is_upright = axis == 2;
    Growth growth{.end = end, .by_m = missing_m};
    if (is_upright && end == BoxEnd::kLow) {
      growth.by_m = std::min(missing_m, seen_.low.z() - lowest_m_);
    }
    if (growth.by_m < kLeastGrowthM) return std::nullopt;
    growth.known_free = known_free_share(part_beyond(seen_, axis, growth), is_free_);
    if (growth.known_free > kMostKnownFree) return std::nullopt;
    growth.faced = is_upright ? end == BoxEnd::kHigh : is_end_faced(end, axis);
    return growth;
  }

  [[nodiscard]] bool is_end_faced(BoxEnd end, Eigen::Index axis) const {
    const Eigen::Vector3d normal =
        seen_.map_from_box * (end == BoxEnd::kLow ? -unit(axis) : unit(axis));
    return is_faced(normal.head<2>(), directions_);
  }

  TurnedBox seen_;
  std::vector<Eigen::Vector2d> directions_;
  double lowest_m_;
  const KnownFree& is_free_;
};

}  // namespace

std::optional<Box> completed_box(const Object& object,
                                 const UsualSizes& usual,
                                 const KnownFree& is_free) {
  if (seen_share(object) >= kWholeSeenShare) return std::nullopt;
  const auto best = best_class(object);
  const auto size = best ? usual.of_class.find(best->id) : usual.of_class.end();
  if (size == usual.of_class.end()) return std::nullopt;
  const GrowthChoice choice(object, usual, is_free);
  const Eigen::Vector3d usual_m = usual_extent(choice.seen(), size->second);
  const Eigen::Vector3d missing = usual_m - choice.seen().extent();
  TurnedBox completed = choice.seen();
  bool has_grown = false;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (axis < 2 && missing[axis] < kLeastLackingSide * usual_m[axis]) continue;
    const auto growth = choice.along(axis, missing[axis]);
    if (!growth) continue;
    has_grown = true;
    if (growth->end == BoxEnd::kLow) completed.low[axis] -= growth->by_m;
    if (growth->end == BoxEnd::kHigh) completed.high[axis] += growth->by_m;
  }
  if (!has_grown) return std::nullopt;
  return bounding_box(object.box, bounding_box(completed));
}

}  // namespace hypermap
