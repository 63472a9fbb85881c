// SPDX-License-Identifier: BSD-3-Clause
// What stands where in a map that was saved? Usage: query_map MAP.hmap CLASS
#include <hypermap/io/archive/map_archive.hpp>
#include <hypermap/io/archive/map_layers.hpp>

#include <cstdio>

using namespace hypermap;  // NOLINT(google-build-using-namespace): a program in one file

int main(int argc, char** argv) {
  if (argc != 3) return 4;
  const auto loaded = load_archive(argv[1]);
  if (!loaded) {
    std::fprintf(stderr, "%s\n", to_string(loaded.error()).c_str());
    return 2;
  }
  const MapArchive& map = loaded->value;
  const auto wanted = map.classes.find(argv[2]);
  if (!wanted) {
    std::fprintf(stderr, "the map knows no class \"%s\"\n", argv[2]);
    return 2;
  }

  // Objects of a class.
  for (const Object* object : confirmed_objects_of(map)) {
    const auto best = best_class(*object);
    if (!best || best->id != *wanted) continue;
    const Eigen::Vector3d at = object->centroid_in_map;
    std::printf("object %u at (%.2f, %.2f, %.2f)\n", object->id.value, at.x(), at.y(), at.z());
  }

  // The one nearest to the origin, ...
  const auto nearest = map.objects.nearest(PointInMap{{0.0, 0.0, 0.0}}, wanted);
  if (!nearest) return 0;
  const Eigen::Vector3d place = map.objects.at(*nearest).centroid_in_map;

  // ... the cell of the occupancy grid that it stands on, ...
  for (const Layer& layer : map.hypermap.layers()) {
    const auto* occupancy = layer.content.as<OccupancyLayer>();
    const auto cell = occupancy ? occupancy->grid.at_point(place.head<2>()) : std::nullopt;
    if (cell) std::printf("layer %s: %d\n", layer.info.name.c_str(), static_cast<int>(*cell));
  }

  // ... and how many of its voxels are in the octree, and what is known at its centre.
  if (!map.octree) return 0;
  std::size_t num_voxels = 0;
  map.octree->for_each_leaf_of(*nearest, [&](const LeafSample&) { ++num_voxels; });
  const auto voxel = map.octree->at(PointInMap{place});
  std::printf("nearest: object %u, %zu voxels, its centre is %s\n",
              nearest->value,
              num_voxels,
              voxel ? (voxel->occupied ? "occupied" : "free") : "unknown");
}
