// SPDX-License-Identifier: BSD-3-Clause
// A map is saved while it grows: one writer, eight readers and a saver, each with snapshots.
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"
#include "octree_semantic/support/detected_frame.hpp"
#include "support/sanitized.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace hypermap {
namespace {

/// Between two looks of a reader, which would else take the writer's cores; what is right does not
/// depend on it.
constexpr std::chrono::milliseconds kPause{1};

const std::vector<RgbdFrame>& seen_frames() {
  static const std::vector<RgbdFrame> kFrames =
      test::detected_room_frames(test::kThreadSanitized ? 4 : 8, 120);
  return kFrames;
}

ClassRegistry known_classes() {
  ClassRegistry classes;
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(classes.add("class " + std::to_string(i)));
  return classes;
}

SemanticMapper live_mapper(int publish_every_n_frames) {
  SemanticMapperOptions options;
  options.octree.resolution_m = 0.1;
  options.publish_every_n_frames = publish_every_n_frames;
  auto mapper = SemanticMapper::create(options).value();
  EXPECT_TRUE(mapper.set_classes(known_classes()));
  return mapper;
}

std::string saved(const SemanticOctree& octree,
                  const ObjectMap& objects,
                  const ClassRegistry& classes) {
  MapArchive archive;
  archive.octree = octree;
  archive.objects = objects;
  archive.classes = classes;
  return write_archive(archive).value();
}

/// The archives of the map after 1, 2, ... frames, of a mapper that publishes nothing.
std::vector<std::string> expected_archives() {
  SemanticMapper mapper = live_mapper(0);
  std::vector<std::string> archives;
  for (const RgbdFrame& frame : seen_frames()) {
    EXPECT_TRUE(mapper.integrate(frame));
    archives.push_back(saved(mapper.octree(), mapper.objects(), known_classes()));
  }
  return archives;
}

TEST(SnapshotSave, AnArchiveSavedDuringMappingIsTheMapBetweenTwoFrames) {
  const std::vector<std::string> expected = expected_archives();
  SemanticMapper mapper = live_mapper(1);
  std::atomic<bool> done{false};
  std::map<std::uint64_t, std::string> archives;
  std::thread saver([&] {
    do {
      const auto snapshot = mapper.snapshot();
      if (snapshot->num_frames == 0 || archives.contains(snapshot->num_frames)) continue;
      archives[snapshot->num_frames] =
          saved(snapshot->octree, snapshot->objects, *snapshot->classes);
    } while (!done);
  });
  std::vector<std::thread> readers;
  readers.reserve(8);
  for (int i = 0; i < 8; ++i) {
    readers.emplace_back([&] {
      while (!done) {
        const auto snapshot = mapper.snapshot();
        const LeafCount count = snapshot->octree.num_leaves();
        EXPECT_EQ(count.occupied == 0, snapshot->num_frames == 0);
        for (const Object& object : snapshot->objects.objects()) {
          EXPECT_FALSE(snapshot->objects.query(object.box).empty());
          snapshot->octree.for_each_leaf_of(object.id, object.box, [&](const LeafSample& leaf) {
            EXPECT_EQ(leaf.object, object.id);
          });
        }
        std::this_thread::sleep_for(kPause);
      }
    });
  }
  for (const RgbdFrame& frame : seen_frames()) EXPECT_TRUE(mapper.integrate(frame)->published);
  done = true;
  for (std::thread& reader : readers) reader.join();
  saver.join();
  const auto last = mapper.snapshot();
  archives[last->num_frames] = saved(last->octree, last->objects, *last->classes);
  for (const auto& [num_frames, archive] : archives) {
    EXPECT_TRUE(archive == expected[num_frames - 1]) << "after " << num_frames << " frames";
  }
}

}  // namespace
}  // namespace hypermap
