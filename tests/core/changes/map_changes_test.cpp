// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/changes/map_changes.hpp"

#include "hypermap/core/base/option_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A cube of 0.4 m on the floor with its middle at x, y; its points are those of a grid of 5 cm.
ObjectInPlace cube_at(std::uint32_t id, const std::string& class_name, double x_m, double y_m) {
  ObjectInPlace object{.id = ObjectId{id}, .class_name = class_name};
  object.box = {{x_m - 0.2, y_m - 0.2, 0.0}, {x_m + 0.2, y_m + 0.2, 0.4}};
  object.centroid_in_map = object.box.centre();
  for (int i = 0; i < 8 * 8 * 8; ++i) {
    const Eigen::Vector3d cell = Eigen::Vector3i(i % 8, i / 8 % 8, i / 64).cast<double>();
    object.points_in_map.emplace_back(object.box.min_in_map +
                                      0.05 * (cell + Eigen::Vector3d::Constant(0.5)));
  }
  return object;
}

/// All that is in the boxes of the objects is occupied, else it is free, beyond `seen` unknown.
MapOfPlace map_of(std::vector<ObjectInPlace> objects,
                  const Box& seen = {{-10, -10, -1}, {10, 10, 3}}) {
  MapOfPlace map{.objects = objects};
  map.space = [objects = std::move(objects), seen](const PointInMap& point) {
    if (!seen.contains(point.xyz)) return SpaceState::kUnknown;
    for (const ObjectInPlace& object : objects) {
      if (object.box.contains(point.xyz)) return SpaceState::kOccupied;
    }
    return SpaceState::kFree;
  };
  return map;
}

/// The same with something in a box that has no name.
MapOfPlace filled(MapOfPlace map, const Box& box) {
  map.space = [space = std::move(map.space), box](const PointInMap& point) {
    return box.contains(point.xyz) ? SpaceState::kOccupied : space(point);
  };
  return map;
}

std::string text_of(const ObjectChange& change) {
  std::string text(name_of(change.kind));
  for (const auto& id : {change.before, change.after}) {
    text += id ? " " + std::to_string(id->value) : " -";
  }
  return text;
}

std::vector<std::string> changes(const MapOfPlace& before, const MapOfPlace& after) {
  std::vector<std::string> texts;
  for (const ObjectChange& change : find_changes(before, after)) texts.push_back(text_of(change));
  return texts;
}

TEST(MapChanges, WhatStaysIsTheSameWhateverItsNumber) {
  const auto before = map_of({cube_at(1, "chair", 0, 0), cube_at(2, "chair", 1, 0)});
  const auto after = map_of({cube_at(7, "chair", 1.05, 0), cube_at(9, "chair", 0.05, 0)});
  EXPECT_THAT(changes(before, after), ElementsAre("same 1 9", "same 2 7"));
  const ObjectChange change = find_changes(before, after).front();
  EXPECT_NEAR(change.distance_m.value(), 0.05, 1e-12);
  EXPECT_NEAR(change.old_place->free, 1.0 / 8.0, 1e-12);  // a column of eight
  EXPECT_NEAR(change.old_place->occupied, 7.0 / 8.0, 1e-12);
}

TEST(MapChanges, WhatIsMissingIsGoneWhereItsPlaceIsFree) {
  const auto before = map_of({cube_at(1, "chair", 0, 0)});
  EXPECT_THAT(changes(before, map_of({})), ElementsAre("gone 1 -"));
  EXPECT_THAT(changes(map_of({}), before), ElementsAre("added - 1"));
}

TEST(MapChanges, WhatWasNotLookedAtIsNotGone) {
  const auto before = map_of({cube_at(1, "chair", 0, 0)});
  // 0.1 m of 0.4 m are seen, then 0.3 m of it.
  EXPECT_THAT(changes(before, map_of({}, {{-0.2, -1, -1}, {-0.1, 1, 1}})),
              ElementsAre("not looked at 1 -"));
  EXPECT_THAT(changes(before, map_of({}, {{-0.2, -1, -1}, {0.1, 1, 1}})), ElementsAre("gone 1 -"));
  EXPECT_THAT(changes(map_of({}, {{-0.2, -1, -1}, {-0.1, 1, 1}}), before),
              ElementsAre("first seen - 1"));
}

TEST(MapChanges, WhatIsFilledAndHasNoNameIsNotGone) {
  const auto before = map_of({cube_at(1, "chair", 0, 0)});
  const auto after = filled(map_of({}), before.objects.front().box);
  EXPECT_THAT(changes(before, after), ElementsAre("not found 1 -"));
  EXPECT_THAT(changes(after, before), ElementsAre("newly named - 1"));
}

/// The same where rays pass through a box, as through a pane of glass.
MapOfPlace seen_through(MapOfPlace map, const Box& box) {
  map.space = [space = std::move(map.space), box](const PointInMap& point) {
    return box.contains(point.xyz) ? SpaceState::kFree : space(point);
  };
  return map;
}

TEST(MapChanges, AMapHasNoChangeAgainstItself) {
  auto map = map_of({cube_at(1, "chair", 0, 0), cube_at(2, "tvmonitor", 1, 0)});
  map = seen_through(map, map.objects.back().box);
  EXPECT_THAT(changes(map, map), ElementsAre("same 1 1", "same 2 2"));
}

// One that walked on before the end of a run left free space behind in its own map, too.
TEST(MapChanges, WhatLeftFreeSpaceInItsOwnMapIsGone) {
  auto with = map_of({cube_at(2, "person", 1, 0)});
  with = seen_through(with, with.objects.front().box);
  EXPECT_THAT(changes(with, map_of({})), ElementsAre("gone 2 -"));
  EXPECT_THAT(changes(with, map_of({cube_at(3, "person", 3, 0)})), ElementsAre("moved 2 3"));
}

TEST(MapChanges, WhatIsGoneHereAndAddedThereMoved) {
  const auto before = map_of({cube_at(1, "chair", 0, 0), cube_at(2, "sofa", 5, 5)});
  const auto after = map_of({cube_at(3, "chair", 2, 0), cube_at(4, "sofa", 5, 5)});
  EXPECT_THAT(changes(before, after), ElementsAre("moved 1 3", "same 2 4"));
  EXPECT_NEAR(find_changes(before, after).front().distance_m.value(), 2.0, 1e-12);
}

TEST(MapChanges, AThingMovesFartherThanItsClassAndSizeAllowByNone) {
  const auto before = map_of({cube_at(1, "chair", 0, 0)});
  EXPECT_THAT(changes(before, map_of({cube_at(3, "sofa", 2, 0)})),
              ElementsAre("gone 1 -", "added - 3"));
  EXPECT_THAT(changes(before, map_of({cube_at(3, "chair", 5.1, 0)})),
              ElementsAre("gone 1 -", "added - 3"));
  auto small = cube_at(3, "chair", 2, 0);
  small.box = {small.box.centre().array() - 0.05, small.box.centre().array() + 0.05};
  EXPECT_THAT(changes(before, map_of({small})), ElementsAre("gone 1 -", "added - 3"));
}

TEST(MapChanges, NothingMovesToWhereNobodyLookedBefore) {
  const auto before = map_of({cube_at(1, "chair", 0, 0)}, {{-1, -1, -1}, {1, 1, 1}});
  EXPECT_THAT(changes(before, map_of({cube_at(3, "chair", 2, 0)})),
              ElementsAre("gone 1 -", "first seen - 3"));
}

TEST(MapChanges, AThingPushedAsideByLessThanItsSizeMoved) {
  // Within the gate of 0.25 m; 0.24 of 0.4 m of its old place are free.
  const auto before = map_of({cube_at(1, "chair", 0, 0)});
  EXPECT_THAT(changes(before, map_of({cube_at(3, "chair", 0.24, 0)})), ElementsAre("moved 1 3"));
  EXPECT_THAT(changes(before, map_of({cube_at(3, "chair", 0.14, 0)})), ElementsAre("same 1 3"));
}

TEST(MapChanges, OneThingUnderTwoNamesIsReclassed) {
  const auto before = map_of({cube_at(1, "chair", 0, 0)});
  EXPECT_THAT(changes(before, map_of({cube_at(3, "sofa", 0.05, 0)})),
              ElementsAre("re-classed 1 3"));
}

TEST(MapChanges, OneThingInThePlaceOfAnotherIsNotReclassed) {
  // The sofa overlaps a third of both, but most of the chair's place is free.
  const auto before = map_of({cube_at(1, "chair", 0, 0)});
  EXPECT_THAT(changes(before, map_of({cube_at(3, "sofa", 0.21, 0)})),
              ElementsAre("gone 1 -", "added - 3"));
}

TEST(MapChanges, WhatAMapThatGoesOnDidNotLookAtAgainIsSaid) {
  const auto before = map_of({cube_at(1, "chair", 0, 0)});
  auto after = before;
  after.objects.front().was_looked_at = false;
  EXPECT_THAT(changes(before, after), ElementsAre("not looked at 1 1"));
}

TEST(MapChanges, WhatAMapThatGoesOnSawGoneIsGoneWhateverItsVoxelsSay) {
  auto before = map_of({cube_at(1, "chair", 0, 0)});
  const auto after = filled(map_of({cube_at(2, "sofa", 0.05, 0)}), before.objects.front().box);
  EXPECT_THAT(changes(before, after), ElementsAre("re-classed 1 2"));
  before.objects.front().was_seen_gone = true;
  EXPECT_THAT(changes(before, after), ElementsAre("gone 1 -", "newly named - 2"));
}

TEST(MapChanges, ThereAndBackAreEachOthersMirror) {
  const auto before = map_of({cube_at(1, "chair", 0, 0), cube_at(2, "cup", 3, 0)});
  const auto after = map_of({cube_at(3, "chair", 2, 1), cube_at(4, "sofa", -3, 0)});
  EXPECT_THAT(changes(before, after), ElementsAre("moved 1 3", "gone 2 -", "added - 4"));
  EXPECT_THAT(changes(after, before), ElementsAre("moved 3 1", "gone 4 -", "added - 2"));
}

TEST(MapChanges, EveryObjectIsThereOnceAndAnObjectWithoutPointsIsItsBox) {
  std::vector<ObjectInPlace> many;
  for (std::uint32_t i = 0; i < 60; ++i) {
    many.push_back(cube_at(i, i % 2 == 0 ? "chair" : "cup", 0.3 * i - 9, 0.0));
    if (i % 3 == 0) many.back().points_in_map.clear();
  }
  std::vector<ObjectInPlace> fewer(many.begin(), many.begin() + 37);
  const auto found = find_changes(map_of(many), map_of(fewer));
  std::vector<int> times(60, 0);
  for (const ObjectChange& change : found) ++times.at(change.before.value().value);
  EXPECT_EQ(times, std::vector<int>(60, 1));
  EXPECT_THAT(changes(map_of({}), map_of({})), IsEmpty());
}

TEST(MapChanges, OptionsOutOfRangeAreNamed) {
  EXPECT_TRUE(validate(ChangeOptions{}).has_value());
  const auto refused = validate(ChangeOptions{.min_free_share = 0.0});
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().field, "min_free_share");
}

TEST(MapChanges, EveryKindHasAName) {
  for (const ChangeKind kind : kChangeKinds) {
    EXPECT_FALSE(name_of(kind).empty());
    EXPECT_EQ(name_of(kind).size(), key_of(kind).size());
  }
  EXPECT_TRUE(is_change(ChangeKind::kReclassed));
  EXPECT_FALSE(is_change(ChangeKind::kNotFound));
}

}  // namespace
}  // namespace hypermap
