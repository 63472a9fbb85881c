// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_outline.hpp"

#include <utility>

namespace hypermap {

Ring outline_of(const Object& object) {
  if (auto shape = footprint(object)) return std::move(shape->outer);
  const Eigen::Vector3d& low = object.box.min_in_map;
  const Eigen::Vector3d& high = object.box.max_in_map;
  return {{low.x(), low.y()}, {high.x(), low.y()}, {high.x(), high.y()}, {low.x(), high.y()}};
}

TurnedBox turned_box_of(const Object& object) {
  return turned_box_around(
      outline_of(object), object.box.min_in_map.z(), object.box.max_in_map.z());
}

}  // namespace hypermap
