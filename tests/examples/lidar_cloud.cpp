// SPDX-License-Identifier: BSD-3-Clause
// How do the scans of a lidar get into the map, with classes and instances of their points?
// Usage: lidar_cloud
#include <hypermap/octree_semantic/mapper/semantic_mapper.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>

using namespace hypermap;  // NOLINT(google-build-using-namespace): a program in one file

// 32 x 512 rays from 1.8 m above a street; a van stands beside it, 12 m ahead of the start.
static LabelledCloud scan(std::uint64_t index) {
  LabelledCloud cloud{.index = index,
                      .name = "scan",
                      .stamp = {},
                      .sensor = {{0.5 * static_cast<double>(index), 0, 1.8}}};
  const std::vector<ClassId> known{{0}, {1}};
  for (const ClassId id : known) {
    cloud.class_vectors.push_back(spread_score(id, Probability(0.9), known));
  }
  const Box van{{10.0, 2.0, 0.0}, {14.0, 4.0, 2.2}};
  for (int ray = 0; ray < 32 * 512; ++ray) {
    const double turn = 2.0 * std::numbers::pi * (ray % 512) / 512.0;
    const double fall = 0.005 + 0.012 * (ray / 512);  // NOLINT: rows are whole
    const Eigen::Vector3d way(std::cos(turn), std::sin(turn), -fall);
    const Eigen::Vector3d from = cloud.sensor.xyz;
    double distance = 1.8 / fall;  // to the ground
    const double to_van = (van.min_in_map.y() + 0.02 - from.y()) / way.y();
    const bool is_van = to_van > 0.0 && to_van < distance && van.contains(from + to_van * way);
    if (is_van) distance = to_van;
    cloud.points_in_map.emplace_back((from + distance * way).cast<float>());
    cloud.class_vector_of_point.push_back(is_van ? 1 : 0);
    cloud.instance_of_point.push_back(is_van ? 1 : LabelledCloud::kNoInstance);
  }
  return cloud;
}

int main() {
  const std::vector<std::string> names{"street", "van"};
  const auto classes = ClassRegistry::from_names(names).value();
  SemanticMapperOptions options;
  options.octree.resolution_m = 0.1;
  options.cloud = {.max_range_m = 100.0, .free_range_m = 15.0, .max_memory_mb = 256};
  auto mapper = SemanticMapper::create(options, classes).value();
  for (std::uint64_t i = 0; i < 5; ++i) {
    const auto report = mapper.integrate_cloud(scan(i));
    if (!report) {
      std::fprintf(stderr, "%s\n", to_string(report.error()).c_str());
      return 2;
    }
  }
  for (const Object& object : mapper.objects().objects()) {
    std::size_t num_voxels = 0;
    mapper.octree().for_each_leaf_of(object.id, [&](const LeafSample&) { ++num_voxels; });
    const std::string& name = classes.name(best_class(object)->id);
    const Eigen::Vector3d at = object.centroid_in_map;
    std::printf("%s at (%.1f, %.1f), %zu voxels\n", name.c_str(), at.x(), at.y(), num_voxels);
  }
}
