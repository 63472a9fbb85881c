// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/archive_changes.hpp"

#include "core/places/furniture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using namespace testing_support;  // NOLINT(google-build-using-namespace): builders in words

struct PlacedBox {
  std::string class_name;
  Box box;
};

/// A room of 3 m by 3 m of free voxels of 5 cm, of which those in the boxes are filled.
MapArchive room_with(const std::vector<PlacedBox>& placed) {
  FurnishedRoom room;
  for (const PlacedBox& one : placed) room.add(one.class_name, one.box);
  MapArchive archive;
  archive.octree = SemanticOctree::create({}).value();
  std::vector<StoredLeaf> leaves(std::size_t{60} * 60 * 12);
  for (int i = 0; i < 60 * 60 * 12; ++i) {
    const Eigen::Vector3d cell =
        Eigen::Vector3i(i % 60 - 30, i / 60 % 60 - 30, i / 3600).cast<double>();
    const Eigen::Vector3d centre = 0.05 * (cell + Eigen::Vector3d::Constant(0.5));
    const bool is_filled = std::ranges::any_of(
        placed, [&](const PlacedBox& one) { return grown(one.box, 0.04).contains(centre); });
    StoredLeaf& leaf = leaves[static_cast<std::size_t>(i)];
    leaf.key = archive.octree->grid().key(PointInMap{centre}).value();
    leaf.log_odds = static_cast<MilliLogOdds>(is_filled ? 2000 : -1000);
  }
  EXPECT_TRUE(archive.octree->set_leaves(leaves));
  archive.objects = std::move(room.objects);
  archive.classes = std::move(room.classes);
  return archive;
}

const Eigen::Vector3d kCrate(0.4, 0.4, 0.5);

std::vector<std::string> kinds_of(const ArchiveChanges& found) {
  std::vector<std::string> kinds;
  for (const ObjectChange& change : found.changes) kinds.emplace_back(name_of(change.kind));
  return kinds;
}

TEST(ArchiveChanges, AreTakenFromOctreesAndObjects) {
  const MapArchive before = room_with({{"chair", standing(0, 0, 0, kCrate)},
                                       {"sofa", standing(1, 1, 0, kCrate)},
                                       {"vase", standing(-1, 1, 0, kCrate)}});
  const MapArchive after = room_with({{"sofa", standing(1, 1, 0, kCrate)},
                                      {"chair", standing(-1, -1, 0, kCrate)},
                                      {"clock", standing(1, -1, 0, kCrate)}});
  const auto found = archive_changes(before, after).value();
  EXPECT_EQ(found.frame_id, "map");
  EXPECT_FALSE(found.goes_on);
  EXPECT_THAT(kinds_of(found), ElementsAre("moved", "gone", "added", "same"));
  EXPECT_THAT(kinds_of(archive_changes(before, before).value()),
              ElementsAre("same", "same", "same"));
}

TEST(ArchiveChanges, ClassesAreEqualWhenTheVocabularySaysSo) {
  const MapArchive before = room_with({{"sofa", standing(0, 0, 0, kCrate)}});
  MapArchive after = room_with({{"settee", standing(0, 0, 0, kCrate)}});
  EXPECT_THAT(kinds_of(archive_changes(before, after).value()), ElementsAre("re-classed"));
  after.vocabulary =
      ClassVocabulary::create({.aliases = {{{"sofa"}, {{"settee"}}}}, .super_classes = {}}).value();
  EXPECT_THAT(kinds_of(archive_changes(before, after).value()), ElementsAre("same"));
}

TEST(ArchiveChanges, AMapThatGoesOnSaysWhatItDidNotLookAtAgain) {
  MapArchive before = room_with({{"sofa", standing(0, 0, 0, kCrate)}});
  before.provenance.emplace_back();
  before.provenance.back().next_frame_index = 100;
  MapArchive after = before;
  after.provenance.emplace_back();
  after.provenance.back().next_frame_index = 200;
  const auto found = archive_changes(before, after).value();
  EXPECT_TRUE(found.goes_on);
  EXPECT_THAT(kinds_of(found), ElementsAre("not looked at"));
  after.objects.modify(ObjectId{1},
                       [](Object& object) { object.observation_log.add({.frame_index = 100}); });
  EXPECT_THAT(kinds_of(archive_changes(before, after).value()), ElementsAre("same"));
  EXPECT_FALSE(archive_changes(after, before).value().goes_on);
  after.objects.erase(ObjectId{1});
  after.objects.add(before.objects.at(ObjectId{1}));  // by a new number
  EXPECT_THAT(kinds_of(archive_changes(before, after).value()), ElementsAre("not looked at"));
}

/// A sheet of 2 cm on both sides of the border of two voxels, and one of another name beside it.
TEST(ArchiveChanges, ASurfaceAVoxelAsideFillsThePlace) {
  const Eigen::Vector3d sheet(0.02, 0.6, 0.5);
  const MapArchive before = room_with({{"tv", standing(0, 0, 0, sheet)}});
  const MapArchive beside = room_with({{"mirror", standing(0.06, 0, 0, sheet)}});
  EXPECT_THAT(kinds_of(archive_changes(before, beside).value()),
              ElementsAre("not found", "newly named"));
  const MapArchive apart = room_with({{"mirror", standing(0.3, 0, 0, sheet)}});
  EXPECT_THAT(kinds_of(archive_changes(before, apart).value()), ElementsAre("gone", "added"));
}

TEST(ArchiveChanges, AsALayerBearNamesIdsAndShapes) {
  const MapArchive before =
      room_with({{"chair", standing(0, 0, 0, kCrate)}, {"vase", standing(-1, 1, 0, kCrate)}});
  const MapArchive after = room_with({{"chair", standing(1, 0, 0, kCrate)}});
  const auto layer = changes_layer(before, after, archive_changes(before, after).value()).value();
  ASSERT_EQ(layer.objects().size(), 2U);
  const SemanticObject& moved = layer.objects().front();
  EXPECT_EQ(moved.name, "moved chair");
  EXPECT_THAT(moved.tags, ElementsAre("moved", "before 1", "after 1"));
  EXPECT_NEAR(position_of(moved).x(), 1.0, 0.05);
  EXPECT_EQ(layer.objects().back().name, "gone vase");
  EXPECT_EQ(layer.objects().back().id, 2U);
}

TEST(ArchiveChanges, MapsThatCannotTellAreRefused) {
  const MapArchive room = room_with({{"chair", standing(0, 0, 0, kCrate)}});
  MapArchive flat = room;
  flat.octree.reset();
  const auto refused = archive_changes(flat, room);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().field, "before");
  EXPECT_THAT(refused.error().what, HasSubstr("has no semantic octree"));
  MapArchive bare = room;
  bare.objects = ObjectMap();
  EXPECT_EQ(archive_changes(room, bare).error().field, "after");
  EXPECT_THAT(archive_changes(room, bare).error().what, HasSubstr("no 3D objects"));
}

}  // namespace
}  // namespace hypermap
