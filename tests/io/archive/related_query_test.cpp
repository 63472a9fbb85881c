// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/related_query.hpp"

#include "core/places/furniture.hpp"
#include "hypermap/io/archive/archive_info.hpp"
#include "hypermap/io/archive/object_relations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using namespace testing_support;  // NOLINT(google-build-using-namespace): builders in words

/// A table (1) with a cup (2) and a book (3) on it, a cup (4) on the floor.
MapArchive dining_corner() {
  FurnishedRoom room;
  room.add("dining table", table_at(0, 0));
  room.add("cup", standing(0.3, 0, 0.74, {0.08, 0.08, 0.1}));
  room.add("book", standing(-0.3, 0, 0.74, {0.2, 0.16, 0.04}));
  room.add("cup", standing(2, 0, 0, {0.08, 0.08, 0.1}));
  MapArchive archive;
  archive.objects = std::move(room.objects);
  archive.classes = std::move(room.classes);
  return archive;
}

Result<std::vector<std::uint64_t>> ids_related(const MapArchive& archive,
                                               const RelatedTo& related,
                                               const MapQuery& query = {}) {
  HYPERMAP_ASSIGN_OR_RETURN(const MapAnswers answers,
                            query_related(archive, archive_relations(archive), related, query));
  std::vector<std::uint64_t> ids;
  for (const MapAnswer& one : answers.found) ids.push_back(one.id);
  return ids;
}

TEST(RelatedQuery, WhatIsOnAClassOrAnObject) {
  const MapArchive archive = dining_corner();
  EXPECT_THAT(ids_related(archive, {{RelationKind::kOn, "diningtable"}}).value(),
              ElementsAre(2, 3));
  EXPECT_THAT(ids_related(archive, {{RelationKind::kOn, "1"}}).value(), ElementsAre(2, 3));
  EXPECT_THAT(ids_related(archive, {{RelationKind::kOn, "1"}}, {.text = "cup"}).value(),
              ElementsAre(2));
  EXPECT_THAT(ids_related(archive, {{RelationKind::kOn, "cup"}}).value(), IsEmpty());
  EXPECT_THAT(
      ids_related(archive, {{RelationKind::kOn, "1"}, {RelationKind::kBeside, "cup"}}).value(),
      IsEmpty());
}

TEST(RelatedQuery, WhatRestsOnTheFloorIsOnIt) {
  const MapArchive archive = dining_corner();
  EXPECT_THAT(ids_related(archive, {{RelationKind::kOn, "Floor"}}).value(), ElementsAre(1, 4));
  EXPECT_THAT(ids_related(archive, {{RelationKind::kOn, "floor"}}, {.text = "cup"}).value(),
              ElementsAre(4));
  const auto under = ids_related(archive, {{RelationKind::kUnder, "floor"}});
  ASSERT_FALSE(under);
  EXPECT_EQ(under.error().field, "under");
  EXPECT_THAT(under.error().what, HasSubstr("the floor is no object"));
}

TEST(RelatedQuery, AFloorThatIsAnObjectCountsToo) {
  FurnishedRoom room;
  room.add("floor", standing(0, 0, -0.1, {4, 4, 0.1}));
  room.add("cup", standing(0.3, 0, 0, {0.08, 0.08, 0.1}));
  MapArchive archive;
  archive.objects = std::move(room.objects);
  archive.classes = std::move(room.classes);
  EXPECT_THAT(ids_related(archive, {{RelationKind::kOn, "floor"}}).value(), ElementsAre(1, 2));
  EXPECT_THAT(ids_related(archive, {{RelationKind::kUnder, "floor"}}).value(), IsEmpty());
}

TEST(RelatedQuery, AMapWithoutObjectsSaysThatItHasNone) {
  const auto related = ids_related(MapArchive{}, {{RelationKind::kOn, "table"}});
  ASSERT_FALSE(related);
  EXPECT_EQ(related.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(related.error().field, "on");
  EXPECT_EQ(related.error().what, "relations need tracked 3D objects, and the map has none");
}

TEST(RelatedQuery, AClassThatNoNameIsNearIsToldWithThoseThatThereAre) {
  const MapArchive archive = dining_corner();
  EXPECT_THAT(ids_related(archive, {{RelationKind::kOn, "nope"}}).error().what,
              HasSubstr("is named \"nope\" (there are: book, cup, dining table, floor)"));
  EXPECT_THAT(ids_related(archive, {{RelationKind::kIn, "nope"}}).error().what,
              HasSubstr("(there are: book, cup, dining table)"));
}

TEST(RelatedQuery, WhatIsNotThereIsNamed) {
  const MapArchive archive = dining_corner();
  const auto no_class = ids_related(archive, {{RelationKind::kOn, "cap"}});
  ASSERT_FALSE(no_class);
  EXPECT_EQ(no_class.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(no_class.error().field, "on");
  EXPECT_THAT(no_class.error().what, HasSubstr("did you mean \"cup\""));
  const auto no_id = ids_related(archive, {{RelationKind::kPartOf, "9"}});
  ASSERT_FALSE(no_id);
  EXPECT_EQ(no_id.error().field, "part_of");
  EXPECT_THAT(no_id.error().what, HasSubstr("9"));
}

TEST(ArchiveRelations, GapsAreInVoxelsOfTheOctree) {
  MapArchive archive = dining_corner();
  archive.objects.modify(ObjectId{2}, [](Object& cup) {
    cup.box.min_in_map.z() += 0.2;  // 20 cm above the table
    cup.box.max_in_map.z() += 0.2;
  });
  EXPECT_THAT(ids_related(archive, {{RelationKind::kOn, "1"}}).value(), ElementsAre(3));
  archive.octree = SemanticOctree::create({.resolution_m = 0.2}).value();
  EXPECT_THAT(ids_related(archive, {{RelationKind::kOn, "1"}}).value(), ElementsAre(2, 3));
  EXPECT_EQ(called(archive, ObjectId{1}), "dining table 1");
}

TEST(ArchiveInfo, CountsRelations) {
  const ArchiveInfo info = describe(dining_corner());
  EXPECT_THAT(info.num_relations, ElementsAre(2, 0, 0, 0, 0));
  EXPECT_THAT(to_json(info), HasSubstr("\"relations\":{\"on\":2,\"in\":0,"));
}

}  // namespace
}  // namespace hypermap
