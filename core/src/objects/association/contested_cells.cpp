// SPDX-License-Identifier: BSD-3-Clause
// Two objects do not take the same space: what frames put into the wrong one goes back.
#include "hypermap/core/objects/object.hpp"
#include "policies.hpp"

#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// Fewer observations agree on nothing yet.
constexpr std::uint32_t kLeastObservations = 4;

std::optional<ClassId> class_of(const Object& object) {
  const auto best = best_detected_class(object);
  return best ? std::optional(best->id) : std::nullopt;
}

/// The object without the cells that another one agrees on more; none when it keeps all.
std::optional<Object> without_cells_of(const Object& object,
                                       const Object& other,
                                       const AssociationOptions& options) {
  // Of one class, what was taken for both once may lie beside the other's cells.
  const bool is_of_one_class = class_of(object) == class_of(other);
  const ContestedPlace place = is_of_one_class ? ContestedPlace::kBlock : ContestedPlace::kCell;
  OccupancyVotes points = object.points;
  if (points.yield_to(other.points, options.assignment.contested_factor, place) == 0) {
    return std::nullopt;
  }
  Object smaller = object;
  smaller.points = std::move(points);
  const auto box = options.box_from_points ? smaller.points.agreed_box() : std::nullopt;
  if (box) {
    smaller.box = *box;
    smaller.centroid_in_map = box->centre();
  }
  return smaller;
}

void settle(AssociationRun& run, ObjectId a, ObjectId b) {
  auto of_a = without_cells_of(run.objects.at(a), run.objects.at(b), run.options);
  auto of_b = without_cells_of(run.objects.at(b), run.objects.at(a), run.options);
  if (of_a) run.objects.replace(std::move(*of_a));
  if (of_b) run.objects.replace(std::move(*of_b));
}

}  // namespace

void settle_contested_cells(AssociationRun& run) {
  std::set<ObjectId> changed(run.report.created.begin(), run.report.created.end());
  changed.insert(run.report.matched.begin(), run.report.matched.end());
  const auto is_settled = [&](ObjectId id) {
    return run.objects.contains(id) && run.objects.at(id).num_observations >= kLeastObservations;
  };
  for (const ObjectId id : changed) {
    if (!is_settled(id)) continue;
    for (const ObjectId other : run.objects.query(run.objects.at(id).box)) {
      const bool is_next = other != id && is_settled(other);
      if (is_next && !(changed.contains(other) && other < id)) settle(run, id, other);
    }
  }
}

}  // namespace hypermap
