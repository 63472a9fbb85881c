// SPDX-License-Identifier: BSD-3-Clause
// What stands on what in the scenes that ship, seen from all sides, against what the scenes say.
#include "hypermap/core/places/relations.hpp"
#include "hypermap/io/simulator/scene_file.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// Points 2 cm apart, or nearer, on all triangles.
std::vector<Eigen::Vector3f> points_on(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& corners = mesh.triangles[i];
    const Eigen::Vector3d a = mesh.vertices[corners[0]].cast<double>();
    const Eigen::Vector3d u = mesh.vertices[corners[1]].cast<double>() - a;
    const Eigen::Vector3d v = mesh.vertices[corners[2]].cast<double>() - a;
    const double longest_m = std::max({u.norm(), v.norm(), (u - v).norm()});
    const int steps = std::max(1, static_cast<int>(std::ceil(longest_m / 0.02)));
    for (int k = 0; k <= steps; ++k) {
      for (int m = 0; m + k <= steps; ++m) {
        points.emplace_back((a + u * k / steps + v * m / steps).cast<float>());
      }
    }
  }
  return points;
}

Object object_of(const PlacedObject& placed, ClassRegistry& classes) {
  const ClassId id = classes.add(placed.class_name).value();
  Object object;
  object.id = placed.id;
  object.belief.observe(std::array{ClassEvidence{id, Probability(1.0)}}, Probability(0.5));
  object.points.observe(points_on(placed.mesh));
  object.box = placed.box;
  return object;
}

using Pairs = std::vector<std::pair<std::string, std::string>>;

/// What the scene says of what stands on top of what.
Pairs said_pairs(const Scene& scene) {
  Pairs pairs;
  for (const SceneObject& object : scene.objects) {
    if (!object.on.empty() && object.height_m == 0.0) pairs.emplace_back(object.name, object.on);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

Pairs found_pairs(const FurnishedScene& furnished) {
  ClassRegistry classes;
  std::vector<Object> objects;
  std::vector<ObjectId> ids;
  std::map<ObjectId, std::string> names;
  for (const PlacedObject& placed : furnished.objects) {
    objects.push_back(object_of(placed, classes));
    ids.push_back(placed.id);
    names[placed.id] = placed.name;
  }
  const ObjectId next{static_cast<std::uint32_t>(ids.size() + 1)};
  const ObjectMap all = ObjectMap::restore(std::move(objects), next).value();
  Pairs pairs;
  for (const Relation& one : find_relations(all, classes, ids).relations) {
    if (one.kind == RelationKind::kOn) pairs.emplace_back(names[one.subject], names[one.object]);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST(SceneRelations, WhatStandsOnWhatIsFoundFromSurfaces) {
  for (const char* name : {"laboratory", "flat", "office"}) {
    const Scene scene =
        load_scene(test::source_path("data/scenes/" + std::string(name) + ".yaml")).value();
    const Pairs said = said_pairs(scene);
    ASSERT_GE(said.size(), 5U) << name;
    EXPECT_THAT(found_pairs(furnish(scene, 101).value()), testing::ElementsAreArray(said)) << name;
  }
}

}  // namespace
}  // namespace hypermap
