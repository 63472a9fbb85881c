// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A furnished room in words, as objects that were seen whole.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/core/places/relations.hpp"
#include "support/object_builders.hpp"

#include <Eigen/Geometry>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace hypermap::testing_support {

using Points = std::vector<Eigen::Vector3f>;

/// Faces of boxes together.
inline Points surfaces_of(const std::vector<Box>& boxes) {
  Points all;
  for (const Box& box : boxes) {
    const Points points = surface_of(box);
    all.insert(all.end(), points.begin(), points.end());
  }
  return all;
}

/// An upright box on `foot_m` over the rectangle around (x, y).
inline Box standing(double x, double y, double foot_m, const Eigen::Vector3d& size) {
  return box_at({x, y, foot_m + 0.5 * size.z()}, size);
}

/// 1.2 m by 0.8 m, the top 3 cm thick at 0.73 m, four legs.
inline Points table_at(double x, double y) {
  std::vector<Box> boxes{standing(x, y, 0.70, {1.2, 0.8, 0.03})};
  for (const double dx : {-0.57, 0.57}) {
    for (const double dy : {-0.37, 0.37}) {
      boxes.push_back(standing(x + dx, y + dy, 0.0, {0.04, 0.04, 0.70}));
    }
  }
  return surfaces_of(boxes);
}

/// A seat of 0.44 m by 0.44 m at 0.45 m, its back at +y up to 0.9 m, four legs.
inline Points chair_at(double x, double y) {
  std::vector<Box> boxes{standing(x, y, 0.42, {0.44, 0.44, 0.03}),
                         standing(x, y + 0.21, 0.45, {0.44, 0.02, 0.45})};
  for (const double dx : {-0.2, 0.2}) {
    for (const double dy : {-0.2, 0.2}) {
      boxes.push_back(standing(x + dx, y + dy, 0.0, {0.03, 0.03, 0.42}));
    }
  }
  return surfaces_of(boxes);
}

/// Walls of 2 cm around a floor, open above.
inline Points bowl_at(double x, double y, double foot_m) {
  return surfaces_of({standing(x, y, foot_m, {0.3, 0.3, 0.02}),
                      standing(x - 0.14, y, foot_m, {0.02, 0.3, 0.12}),
                      standing(x + 0.14, y, foot_m, {0.02, 0.3, 0.12}),
                      standing(x, y - 0.14, foot_m, {0.3, 0.02, 0.12}),
                      standing(x, y + 0.14, foot_m, {0.3, 0.02, 0.12})});
}

inline const Eigen::Vector3d kCup(0.08, 0.08, 0.1);
inline const Eigen::Vector3d kBook(0.2, 0.16, 0.04);

/// Objects with their classes; ids are 1, 2, ... in the order of adding.
struct FurnishedRoom {
  ObjectMap objects;
  ClassRegistry classes;

  ObjectId add(const std::string& class_name, const Points& points) {
    const ClassId id = classes.add(class_name).value();
    Object object;
    object.belief.observe(std::array{ClassEvidence{id, Probability(0.9)}}, Probability(0.5));
    object.points.observe(points);
    object.box = bounding_box(points);
    object.centroid_in_map = object.box.centre();
    return objects.add(std::move(object));
  }
  ObjectId add(const std::string& class_name, const Box& box) {
    return add(class_name, surface_of(box));
  }
  /// Without points: its box is all that is known.
  ObjectId add_box(const std::string& class_name, const Box& box) {
    const ObjectId id = add(class_name, box);
    objects.modify(id, [&](Object& object) {
      object.points = OccupancyVotes();
      object.box = box;
    });
    return id;
  }
  [[nodiscard]] std::vector<ObjectId> ids() const {
    std::vector<ObjectId> all;
    for (const Object& object : objects.objects()) all.push_back(object.id);
    return all;
  }
};

/// Of all objects of the room.
inline RelationGraph graph_of(const FurnishedRoom& room, const RelationOptions& options = {}) {
  return find_relations(room.objects, room.classes, room.ids(), options);
}

}  // namespace hypermap::testing_support
