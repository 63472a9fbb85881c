// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/mapper/map_snapshot.hpp"

#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"
#include "octree_semantic/support/detected_frame.hpp"
#include "support/sanitized.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <thread>
#include <vector>

namespace hypermap {
namespace {

const std::vector<RgbdFrame>& frames() {
  static const std::vector<RgbdFrame> kFrames = [] {
    std::vector<RgbdFrame> made = test::detected_room_frames(12, 160);
    for (std::size_t i = 0; i < made.size(); ++i) {
      made[i].index = 10 * i;
      made[i].stamp = Stamp{static_cast<std::int64_t>(1000 * i)};
    }
    return made;
  }();
  return kFrames;
}

SemanticMapper publishing_every(int num_frames) {
  SemanticMapperOptions options;
  options.publish_every_n_frames = num_frames;
  return SemanticMapper::create(options).value();
}

/// The map after 0, 1, 2, ... frames, of a mapper that publishes nothing.
struct Moment {
  SemanticOctree octree;
  ObjectMap objects;
  TopologicalMap topological_map;
};
const std::vector<Moment>& moments() {
  static const std::vector<Moment> kMoments = [] {
    SemanticMapper mapper = publishing_every(0);
    std::vector<Moment> made{{mapper.octree(), mapper.objects(), mapper.topological_map()}};
    for (const RgbdFrame& frame : frames()) {
      EXPECT_FALSE(mapper.integrate(frame)->published);
      made.push_back({mapper.octree(), mapper.objects(), mapper.topological_map()});
    }
    return made;
  }();
  return kMoments;
}

/// Whether a snapshot is the map of one moment, whole.
void expect_moment(const MapSnapshot& snapshot) {
  ASSERT_LT(snapshot.num_frames, moments().size());
  const Moment& moment = moments()[snapshot.num_frames];
  EXPECT_TRUE(snapshot.octree == moment.octree) << "after " << snapshot.num_frames;
  EXPECT_TRUE(snapshot.objects == moment.objects) << "after " << snapshot.num_frames;
  EXPECT_TRUE(snapshot.topological_map == moment.topological_map)
      << "after " << snapshot.num_frames;
  if (snapshot.num_frames == 0) return;
  EXPECT_EQ(snapshot.frame_index, frames()[snapshot.num_frames - 1].index);
  EXPECT_EQ(snapshot.stamp, frames()[snapshot.num_frames - 1].stamp);
}

TEST(MapSnapshot, IsEmptyBeforeTheFirstAndWhenNothingIsPublished) {
  SemanticMapper mapper = publishing_every(0);
  for (const RgbdFrame& frame : frames()) EXPECT_FALSE(mapper.integrate(frame)->published);
  const auto snapshot = mapper.snapshot();
  EXPECT_TRUE(snapshot->octree.empty());
  EXPECT_EQ(snapshot->octree.options(), mapper.options().octree);
  EXPECT_TRUE(snapshot->objects.empty());
  EXPECT_EQ(snapshot->classes->size(), 0U);
  EXPECT_EQ(snapshot->num_frames, 0U);
  EXPECT_TRUE(publishing_every(1).snapshot()->octree.empty());
}

TEST(MapSnapshot, HeldOnesStayWhatTheyWere) {
  std::vector<std::shared_ptr<const MapSnapshot>> held;
  {
    SemanticMapper mapper = publishing_every(1);
    held.push_back(mapper.snapshot());
    for (const RgbdFrame& frame : frames()) {
      EXPECT_TRUE(mapper.integrate(frame)->published);
      held.push_back(mapper.snapshot());
      EXPECT_TRUE(held.back()->octree == mapper.octree());
    }
  }  // they outlive the mapper
  for (std::size_t i = 0; i < held.size(); ++i) {
    EXPECT_EQ(held[i]->num_frames, i);
    expect_moment(*held[i]);
  }
}

TEST(MapSnapshot, IsPublishedEveryNthFrame) {
  SemanticMapper mapper = publishing_every(3);
  for (std::size_t i = 1; i <= 7; ++i) {
    EXPECT_EQ(mapper.integrate(frames()[i - 1])->published, i % 3 == 0);
    EXPECT_EQ(mapper.snapshot()->num_frames, i / 3 * 3);
    expect_moment(*mapper.snapshot());
  }
}

TEST(MapSnapshot, HasThePlacesOfItsMomentThoughTheSensorWentOn) {
  SemanticMapper mapper = publishing_every(1);
  RgbdFrame frame = frames()[0];
  ASSERT_TRUE(mapper.integrate(frame));
  const auto before = mapper.snapshot();
  const Eigen::Vector3d start = frame.map_from_camera.origin().xyz;
  EXPECT_EQ(before->topological_map.walk()->position_in_map, start);
  const std::size_t num_vertices = before->topological_map.vertices().size();
  // 2.5 m on: beyond the longest edge of 0.95 m, so two more places of the way are needed.
  Eigen::Isometry3d moved = frame.map_from_camera.isometry();
  moved.translation().x() += 2.5;
  frame.map_from_camera = Transform<frame::Map, frame::Camera>(moved);
  ASSERT_TRUE(mapper.integrate(frame));
  EXPECT_GE(mapper.snapshot()->topological_map.vertices().size(), num_vertices + 2);
  EXPECT_EQ(before->topological_map.vertices().size(), num_vertices);
  EXPECT_EQ(before->topological_map.walk()->position_in_map, start);
  TopologicalMap mine = before->topological_map;
  mine.cover(start + Eigen::Vector3d(0.0, 0.0, 50.0));
  EXPECT_EQ(before->topological_map.vertices().size(), num_vertices);
  EXPECT_GT(mine.vertices().size(), num_vertices);
}

TEST(MapSnapshot, ARefusedFrameIsInNone) {
  SemanticMapper mapper = publishing_every(1);
  ASSERT_TRUE(mapper.integrate(frames()[0]));
  RgbdFrame broken = frames()[1];
  broken.depth_m = {};
  EXPECT_FALSE(mapper.integrate(broken));
  EXPECT_EQ(mapper.snapshot()->num_frames, 1U);
}

TEST(MapSnapshot, HasTheClassesThatWereKnownThen) {
  SemanticMapper mapper = publishing_every(1);
  ClassRegistry classes;
  ASSERT_TRUE(classes.add("chair"));
  ASSERT_TRUE(mapper.set_classes(classes));
  ASSERT_TRUE(mapper.integrate(frames()[0]));
  const auto first = mapper.snapshot();
  ASSERT_TRUE(classes.add("table"));
  ASSERT_TRUE(mapper.integrate(frames()[1]));
  EXPECT_EQ(mapper.snapshot()->classes->size(), 1U) << "nobody told the mapper";
  ASSERT_TRUE(mapper.set_classes(classes));
  ASSERT_TRUE(mapper.integrate(frames()[2]));
  EXPECT_EQ(*mapper.snapshot()->classes, classes);
  EXPECT_EQ(first->classes->size(), 1U);
}

TEST(MapSnapshot, TheFirstOfAResumedMapIsWhatItGoesOnFrom) {
  SemanticMapperOptions options;
  options.publish_every_n_frames = 5;
  const Moment& before = moments()[4];
  const auto mapper =
      SemanticMapper::resume(options, before.octree, before.objects, {}, before.topological_map)
          .value();
  EXPECT_TRUE(mapper.snapshot()->octree == before.octree);
  EXPECT_TRUE(mapper.snapshot()->objects == before.objects);
  EXPECT_TRUE(mapper.snapshot()->topological_map == before.topological_map);
  options.publish_every_n_frames = -1;
  EXPECT_EQ(SemanticMapper::create(options).error().field, "publish_every_n_frames");
}

TEST(MapSnapshot, ChangedRegionsCoverWhatDiffers) {
  SemanticMapper mapper = publishing_every(1);
  ASSERT_TRUE(mapper.integrate(frames()[0]));
  const auto before = mapper.snapshot();
  for (std::size_t i = 1; i < 4; ++i) ASSERT_TRUE(mapper.integrate(frames()[i]));
  const auto after = mapper.snapshot();
  const std::vector<Box> regions = after->octree.changed_regions(before->octree.revision());
  EXPECT_LT(regions.size(), after->octree.num_bricks());
  std::set<BrickKey> reported;
  for (const Box& region : regions) {
    reported.insert(BrickKey::of(*after->octree.grid().key(PointInMap{region.centre()})));
  }
  std::size_t num_different = 0;
  after->octree.for_each_stored_leaf([&](const StoredLeaf& leaf) {
    if (before->octree.stored_at(leaf.key) == leaf) return;
    ++num_different;
    EXPECT_TRUE(reported.contains(BrickKey::of(leaf.key)));
  });
  EXPECT_GT(num_different, 1000U);
}

TEST(MapSnapshot, MemoryIsFlatWhileSnapshotsComeAndGo) {
  SemanticMapper mapper = publishing_every(1);
  std::shared_ptr<const MapSnapshot> held;
  const auto see_all = [&] {
    for (const RgbdFrame& frame : frames()) {
      ASSERT_TRUE(mapper.integrate(frame));
      held = mapper.snapshot();
    }
  };
  for (int round = 0; round < test::repetitions(8); ++round) see_all();
  const std::size_t before = mapper.octree().memory_bytes();
  for (int round = 0; round < test::repetitions(8); ++round) see_all();
  EXPECT_LE(mapper.octree().memory_bytes(), before + before / 10);
}

/// Reads snapshots until `done` and once more, and holds every one of them to what a run without
/// them gave.
void read_snapshots(const SemanticMapper& mapper,
                    const std::atomic<bool>& done,
                    std::size_t reader) {
  std::uint64_t newest = 0;
  std::shared_ptr<const MapSnapshot> held;
  for (bool is_last = false; !is_last;) {
    is_last = done;  // before the look: the last one sees the whole map
    const auto snapshot = mapper.snapshot();
    EXPECT_GE(snapshot->num_frames, newest) << "time does not run backwards";
    if (snapshot->num_frames == newest && held) {
      std::this_thread::yield();
      continue;
    }
    newest = snapshot->num_frames;
    if (reader % 2 == 0) {
      expect_moment(*snapshot);
    } else {
      for (const Object& object : snapshot->objects.objects()) {
        EXPECT_FALSE(snapshot->objects.query(object.box).empty());
        (void)snapshot->octree.cast_ray({object.centroid_in_map}, {1.0, 0.2, 0.1});
      }
      ObjectMap mine = snapshot->objects;
      SemanticOctree tree = snapshot->octree;
      if (!mine.empty()) (void)mine.erase(mine.objects().begin()->id);
      EXPECT_TRUE(tree.set_leaf({.key = {32768, 32768, 32768}, .log_odds = 100}));
    }
    held = snapshot;
  }
}

TEST(MapSnapshot, EightReadersSeeWholeFramesWhileOneThreadWrites) {
  (void)moments();
  SemanticMapper mapper = publishing_every(1);
  std::atomic<bool> done{false};
  std::vector<std::thread> readers;
  readers.reserve(8);
  for (std::size_t i = 0; i < 8; ++i) {
    readers.emplace_back([&, i] { read_snapshots(mapper, done, i); });
  }
  for (const RgbdFrame& frame : frames()) EXPECT_TRUE(mapper.integrate(frame)->published);
  done = true;
  for (std::thread& reader : readers) reader.join();
  EXPECT_TRUE(mapper.octree() == moments().back().octree);
  EXPECT_TRUE(mapper.objects() == moments().back().objects);
}

}  // namespace
}  // namespace hypermap
