// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/completion/completion.hpp"
#include "hypermap/core/objects/object_outline.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace hypermap {
namespace {

/// One object alone is no habit of its class.
constexpr std::size_t kLeastWholeObjects = 2;

/// Requires: not empty.
double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

double median_along(const std::vector<Eigen::Vector3d>& extents, Eigen::Index axis) {
  std::vector<double> values;
  values.reserve(extents.size());
  for (const Eigen::Vector3d& extent : extents) values.push_back(extent[axis]);
  return median(std::move(values));
}

}  // namespace

UsualSizes usual_sizes(const ObjectMap& objects, std::span<const ObjectId> confirmed) {
  std::map<ClassId, std::vector<Eigen::Vector3d>> extents;
  double lowest_m = std::numeric_limits<double>::max();
  for (const ObjectId id : confirmed) {
    const Object& object = objects.at(id);
    lowest_m = std::min(lowest_m, object.box.min_in_map.z());
    const auto best = best_class(object);
    if (!best || seen_share(object) < kWholeSeenShare) continue;
    extents[best->id].push_back(turned_box_of(object).extent());
  }
  UsualSizes usual{.of_class = {}, .lowest_m = confirmed.empty() ? 0.0 : lowest_m};
  for (const auto& [id, of_class] : extents) {
    if (of_class.size() < kLeastWholeObjects) continue;
    usual.of_class.emplace(id,
                           UsualSize{.longer_m = median_along(of_class, 0),
                                     .shorter_m = median_along(of_class, 1),
                                     .height_m = median_along(of_class, 2),
                                     .num_objects = of_class.size()});
  }
  return usual;
}

}  // namespace hypermap
