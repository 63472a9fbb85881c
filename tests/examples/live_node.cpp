// SPDX-License-Identifier: BSD-3-Clause
// How does a live node map, answer and save at once? Usage: live_node DATASET OUTPUT.hmap
#include <hypermap/io/archive/map_archive.hpp>
#include <hypermap/io/dataset/dataset_reader.hpp>
#include <hypermap/octree_semantic/mapper/semantic_mapper.hpp>
#include <hypermap/projection/grids/occupancy_projection.hpp>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <thread>
#include <utility>

using namespace hypermap;  // NOLINT(google-build-using-namespace): a program in one file

int main(int argc, char** argv) {
  if (argc != 3) return 4;
  ClassRegistry classes;
  const auto dataset = open_dataset(argv[1], {}, classes);
  if (!dataset) return 2;
  SemanticMapperOptions options;
  options.publish_every_n_frames = 1;
  auto mapper = SemanticMapper::create(options, classes).value();
  std::atomic<bool> done = false;
  std::atomic<bool> failed = false;

  std::jthread writer([&] {  // the only thread that changes the map
    for (std::size_t i = 0; i < (*dataset)->size(); ++i) {
      const auto frame = (*dataset)->read(i);
      if (!frame || !mapper.set_classes(classes) || !mapper.integrate(*frame)) failed = true;
    }
    done = true;
  });
  // Calls `use` with the newest snapshot again and again, the last time with the whole map.
  const auto while_mapping = [&](auto use) {
    bool is_last = false;
    while (!is_last) {
      is_last = done;
      use(*mapper.snapshot());
    }
  };
  std::size_t most_objects = 0;
  std::jthread objects([&] {  // each answer belongs to one moment between two frames
    while_mapping(
        [&](const MapSnapshot& now) { most_objects = std::max(most_objects, now.objects.size()); });
  });
  std::size_t num_grids = 0;
  std::jthread grids([&] {  // a grid for the planner, whenever there is news
    while_mapping([&, seen = std::uint64_t{0}](const MapSnapshot& now) mutable {
      if (std::exchange(seen, now.num_frames) == now.num_frames) return;
      if (project_occupancy(leaf_source(now.octree))) ++num_grids;
    });
  });
  std::jthread saver([&] {  // the writer does not wait for the disk
    while_mapping([&](const MapSnapshot& now) {
      const MapArchive map{
          .hypermap = {}, .classes = *now.classes, .objects = now.objects, .octree = now.octree};
      if (!save_archive(map, argv[2])) failed = true;
    });
  });
  writer.join(), objects.join(), grids.join(), saver.join();
  std::printf("%zu frames, %zu grids, at most %zu objects\n",
              std::size_t{mapper.snapshot()->num_frames},
              num_grids,
              most_objects);
  return failed ? 1 : 0;
}
