// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/relations.hpp"

#include "core/places/furniture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using namespace testing_support;  // NOLINT(google-build-using-namespace): builders in words

/// The objects that `id` is `kind` to.
std::vector<ObjectId> objects_of(const RelationGraph& graph, RelationKind kind, ObjectId id) {
  std::vector<ObjectId> others;
  for (const Relation& one : relations_of(graph, id)) {
    if (one.kind == kind) others.push_back(one.subject == id ? one.object : one.subject);
  }
  return others;
}

const Relation* find_kind(const RelationGraph& graph, RelationKind kind) {
  const auto found = std::ranges::find(graph.relations, kind, &Relation::kind);
  return found == graph.relations.end() ? nullptr : &*found;
}

TEST(On, ACupStandsOnTheTableTop) {
  FurnishedRoom room;
  const ObjectId table = room.add("table", table_at(0, 0));
  const ObjectId cup = room.add("cup", standing(0.2, 0.1, 0.74, kCup));
  const RelationGraph graph = graph_of(room);
  EXPECT_THAT(objects_of(graph, RelationKind::kOn, cup), ElementsAre(table));
  const Relation* on = find_kind(graph, RelationKind::kOn);
  ASSERT_NE(on, nullptr);
  // Points of the top at 0.73 m lie in the cell of 0.73 .. 0.74 m, whose middle is 0.735 m.
  EXPECT_NEAR(on->evidence.contact_height_m.value(), 0.735, 0.0051);
  EXPECT_NEAR(on->evidence.gap_m.value(), 0.005, 0.0051);
  EXPECT_DOUBLE_EQ(on->evidence.plan_share.value(), 1.0);
  EXPECT_DOUBLE_EQ(on->evidence.contact_share.value(), 1.0);
  EXPECT_EQ(on->evidence.source, RelationSource::kPoints);
  EXPECT_EQ(support_of(graph, cup)->kind, SupportKind::kObject);
  EXPECT_EQ(support_of(graph, cup)->by, table);
  EXPECT_EQ(support_of(graph, table)->kind, SupportKind::kFloor);
  EXPECT_THAT(subjects_of(graph, RelationKind::kOn, table), ElementsAre(cup));
}

TEST(On, TheFloorIsWhereTheMapHasIt) {
  // Voxels of 5 cm: from 7.5 cm above the floor to 15 cm below it.
  const auto support_at = [](double foot_m, std::optional<double> floor_m) {
    FurnishedRoom room;
    const ObjectId cup = room.add("cup", standing(0, 0, foot_m, {0.08, 0.08, 0.1}));
    return support_of(graph_of(room, {.floor_m = floor_m}), cup)->kind;
  };
  EXPECT_EQ(support_at(0.05, std::nullopt), SupportKind::kFloor);
  EXPECT_EQ(support_at(0.1, std::nullopt), SupportKind::kUnknown);
  EXPECT_EQ(support_at(-0.1, std::nullopt), SupportKind::kFloor);
  EXPECT_EQ(support_at(-0.2, std::nullopt), SupportKind::kUnknown);
  EXPECT_EQ(support_at(-1.3, -1.35), SupportKind::kFloor);
  EXPECT_EQ(support_at(0.0, -1.35), SupportKind::kUnknown);
}

TEST(On, ASurfaceThatTheObjectHidesIsSeenAroundIt) {
  FurnishedRoom room;
  const ObjectId table = room.add("table", only(table_at(0, 0), [](const Eigen::Vector3f& p) {
                                    return std::hypot(p.x(), p.y()) > 0.06F;
                                  }));
  const ObjectId cup = room.add("cup", standing(0, 0, 0.74, kCup));
  EXPECT_THAT(objects_of(graph_of(room), RelationKind::kOn, cup), ElementsAre(table));
}

TEST(On, AChairHoldsOnItsSeatAndNotAtItsTop) {
  FurnishedRoom room;
  const ObjectId chair = room.add("chair", chair_at(0, 0));
  const ObjectId book = room.add("book", standing(0, -0.05, 0.455, kBook));
  room.add("cup", standing(0, -0.05, 0.905, kCup));  // over the seat, at the height of the back
  const RelationGraph graph = graph_of(room);
  EXPECT_THAT(objects_of(graph, RelationKind::kOn, book), ElementsAre(chair));
  EXPECT_EQ(graph.supports.back().kind, SupportKind::kUnknown);
}

TEST(On, WithoutPointsTheTopOfTheBoxIsTheSurfaceAndThatIsSaid) {
  FurnishedRoom room;
  const ObjectId table = room.add_box("table", standing(0, 0, 0, {1.2, 0.8, 0.73}));
  const ObjectId cup = room.add_box("cup", standing(0.2, 0.1, 0.75, kCup));
  const RelationGraph graph = graph_of(room);
  const Relation* on = find_kind(graph, RelationKind::kOn);
  ASSERT_NE(on, nullptr);
  EXPECT_EQ(std::tuple(on->subject, on->object), std::tuple(cup, table));
  EXPECT_EQ(on->evidence.source, RelationSource::kBoxes);
  EXPECT_NEAR(on->evidence.gap_m.value(), 0.02, 1e-12);
}

TEST(On, AGapOfExactlyTheGreatestOneCountsAndALargerOneDoesNot) {
  // 1.5 voxels of 0.05 m are 0.075 m.
  for (const auto& [gap_m, is_on] : {std::pair(0.075, true), {0.076, false}, {0.3, false}}) {
    FurnishedRoom room;
    room.add_box("table", standing(0, 0, 0, {1.2, 0.8, 0.73}));
    const ObjectId cup = room.add_box("cup", standing(0, 0, 0.73 + gap_m, kCup));
    const RelationGraph graph = graph_of(room);
    EXPECT_EQ(find_kind(graph, RelationKind::kOn) != nullptr, is_on) << gap_m;
    EXPECT_EQ(support_of(graph, cup)->kind, is_on ? SupportKind::kObject : SupportKind::kUnknown);
    // In voxels of 0.25 m the greatest gap is 0.375 m.
    EXPECT_TRUE(find_kind(graph_of(room, {.voxel_m = 0.25}), RelationKind::kOn)) << gap_m;
  }
}

TEST(On, HalfOfTheFootprintMustLieOverTheSupport) {
  // The table ends at x = 0.6; of a box of 0.2 m around x the share over it is (0.7 - x) / 0.2.
  for (const auto& [x, is_on] : {std::pair(0.59, true), {0.61, false}}) {
    FurnishedRoom room;
    room.add_box("table", standing(0, 0, 0, {1.2, 0.8, 0.73}));
    room.add_box("box", standing(x, 0, 0.73, {0.2, 0.2, 0.2}));
    EXPECT_EQ(find_kind(graph_of(room), RelationKind::kOn) != nullptr, is_on) << x;
  }
}

TEST(On, BooksOnBooksAreAChain) {
  FurnishedRoom room;
  const ObjectId upper = room.add("book", standing(0, 0, 0.82, kBook));
  const ObjectId lower = room.add("book", standing(0.02, 0, 0.78, kBook));
  const ObjectId lowest = room.add("book", standing(0, 0.02, 0.74, kBook));
  const ObjectId table = room.add("table", table_at(0, 0));
  const RelationGraph graph = graph_of(room);
  EXPECT_THAT(objects_of(graph, RelationKind::kOn, upper), ElementsAre(lower));
  EXPECT_THAT(objects_of(graph, RelationKind::kOn, lower), ElementsAre(lowest));
  EXPECT_THAT(objects_of(graph, RelationKind::kOn, lowest), ElementsAre(table));
}

TEST(Under, AChairBelowATableTopIsUnderIt) {
  FurnishedRoom room;
  const ObjectId table = room.add("table", table_at(0, 0));
  const ObjectId bin = room.add("bin", standing(0.1, 0, 0, {0.3, 0.3, 0.4}));
  const RelationGraph graph = graph_of(room);
  EXPECT_THAT(objects_of(graph, RelationKind::kUnder, bin), ElementsAre(table));
  const Relation* under = find_kind(graph, RelationKind::kUnder);
  ASSERT_NE(under, nullptr);
  EXPECT_NEAR(under->evidence.gap_m.value(), 0.3, 0.011);  // 0.70 m - 0.40 m, within cells
  EXPECT_DOUBLE_EQ(under->evidence.plan_share.value(), 1.0);
  EXPECT_THAT(objects_of(graph, RelationKind::kOn, table), IsEmpty());
  // A chair whose back, a twentieth of its plan, stands up before the table is under it too.
  FurnishedRoom tucked;
  tucked.add("table", table_at(0, 0));
  const ObjectId chair = tucked.add("chair", chair_at(0, 0.25));
  EXPECT_THAT(objects_of(graph_of(tucked), RelationKind::kUnder, chair), ElementsAre(table));
}

TEST(Under, WhatTouchesOrIsFarBelowIsNot) {
  for (const auto& [height_m, is_under] :
       {std::pair(0.69, false), {0.55, true}, {0.3, true}, {0.2, false}}) {
    FurnishedRoom room;
    room.add_box("shelf board", standing(0, 0, 0.70, {1.2, 0.8, 0.03}));
    room.add_box("bin", standing(0, 0, 0, {0.3, 0.3, height_m}));
    const RelationGraph graph = graph_of(room, {.max_clearance_m = 0.45});
    EXPECT_EQ(find_kind(graph, RelationKind::kUnder) != nullptr, is_under) << height_m;
  }
}

TEST(In, AnAppleLiesInTheBowlAndTheBowlIsOnTheTable) {
  FurnishedRoom room;
  const ObjectId table = room.add("table", table_at(0, 0));
  const ObjectId bowl = room.add("bowl", bowl_at(0, 0, 0.74));
  const ObjectId apple = room.add("apple", standing(0, 0, 0.77, {0.07, 0.07, 0.07}));
  const RelationGraph graph = graph_of(room);
  EXPECT_THAT(objects_of(graph, RelationKind::kIn, apple), ElementsAre(bowl));
  EXPECT_THAT(objects_of(graph, RelationKind::kOn, bowl), ElementsAre(table));
  EXPECT_THAT(objects_of(graph, RelationKind::kOn, apple), ElementsAre(bowl));
  // Of a class that holds nothing it lies on it.
  const RelationGraph plate = graph_of(room, {.holders = {}});
  EXPECT_FALSE(find_kind(plate, RelationKind::kIn));
}

TEST(In, WhatStandsOnACupboardIsNotInItAlsoWhenThatHasSomeOfItsPoints) {
  FurnishedRoom room;
  Points points = surface_of(standing(0, 0, 0, {0.8, 0.5, 0.9}));
  const Points stray = surface_of(standing(0.2, 0, 0.9, kCup));
  points.insert(points.end(), stray.begin(), stray.end());
  const ObjectId cupboard = room.add("cupboard", points);
  const ObjectId bottle = room.add("bottle", standing(-0.2, 0, 0.91, kCup));
  const RelationGraph graph = graph_of(room);
  EXPECT_FALSE(find_kind(graph, RelationKind::kIn));
  EXPECT_THAT(objects_of(graph, RelationKind::kOn, bottle), ElementsAre(cupboard));
}

TEST(In, TheShareOfTheVolumeDecidesAndTheSmallestHolderIsNamed) {
  for (const auto& [foot_m, is_in] : {std::pair(0.50, true), {0.51, false}}) {
    FurnishedRoom room;
    const ObjectId shelf = room.add_box("shelf", standing(0, 0, 0, {1, 1, 0.6}));
    room.add_box("cabinet", standing(0, 0, 0, {3, 3, 0.6}));
    const ObjectId box = room.add_box("carton", standing(0, 0, foot_m, {0.2, 0.2, 0.2}));
    const RelationGraph graph = graph_of(room);
    const auto holders = objects_of(graph, RelationKind::kIn, box);
    EXPECT_EQ(holders, is_in ? std::vector{shelf} : std::vector<ObjectId>{}) << foot_m;
  }
}

TEST(Beside, NearNeighboursOnOneLevel) {
  FurnishedRoom room;
  room.add("table", table_at(0, 0));
  const ObjectId cup = room.add("cup", standing(0, 0, 0.74, kCup));
  const ObjectId bottle = room.add("bottle", standing(0.2, 0, 0.74, {0.08, 0.08, 0.25}));
  room.add("cup", standing(-0.4, 0, 0.74, kCup));              // 0.32 m away
  const ObjectId chair = room.add("chair", chair_at(0, 0.7));  // not on their level
  const RelationGraph graph = graph_of(room);
  EXPECT_THAT(objects_of(graph, RelationKind::kBeside, cup), ElementsAre(bottle));
  EXPECT_THAT(objects_of(graph, RelationKind::kBeside, bottle), ElementsAre(cup));
  const Relation beside = relations_of(graph, bottle).back();
  EXPECT_EQ(std::tuple(beside.subject, beside.object), std::tuple(cup, bottle));
  EXPECT_NEAR(beside.evidence.gap_m.value(), 0.2 - 0.08, 0.011);
  // The chair stands by the table, not by what is on it.
  EXPECT_THAT(objects_of(graph, RelationKind::kBeside, chair), ElementsAre(ObjectId{1}));
}

TEST(Beside, AWallOfAHolderStandsBetween) {
  FurnishedRoom room;
  room.add_box("cabinet", standing(0, 0, 0, {0.5, 0.5, 1}));
  room.add_box("carton", standing(0.1, 0, 0, {0.2, 0.2, 0.3}));
  room.add_box("carton", standing(0.4, 0, 0, {0.2, 0.2, 0.3}));
  const RelationGraph graph = graph_of(room);
  EXPECT_THAT(objects_of(graph, RelationKind::kBeside, ObjectId{2}), IsEmpty());
}

TEST(Beside, OnlyTheNearestOfBoth) {
  FurnishedRoom room;
  for (int i = 0; i < 12; ++i) {
    const double gap_m = 0.3 + 0.01 * i;
    const double angle = 2 * M_PI * i / 12;
    room.add_box("cup", standing(gap_m * std::cos(angle), gap_m * std::sin(angle), 0, kCup));
  }
  const ObjectId middle = room.add_box("bin", standing(0, 0, 0, {0.3, 0.3, 0.2}));
  const RelationGraph graph = graph_of(room, {.max_beside = 3});
  EXPECT_LE(objects_of(graph, RelationKind::kBeside, middle).size(), 3U);
  for (const ObjectId id : room.ids()) {
    EXPECT_LE(objects_of(graph, RelationKind::kBeside, id).size(), 3U);
  }
  EXPECT_FALSE(find_kind(graph_of(room, {.max_beside = 0}), RelationKind::kBeside));
}

TEST(PartOf, ADeclaredPartSharesTheSurfaceOfTheWhole) {
  FurnishedRoom room;
  const Points sofa =
      surfaces_of({standing(0, 0, 0, {0.8, 1.8, 0.4}), standing(-0.35, 0, 0.4, {0.1, 1.8, 0.4})});
  const ObjectId whole = room.add("sofa", sofa);
  const ObjectId part = room.add("cushion", only(sofa, [](const Eigen::Vector3f& p) {
                                   return p.z() > 0.35F && p.x() < -0.2F && p.y() > 0.3F;
                                 }));
  const RelationGraph graph = graph_of(room);
  EXPECT_THAT(objects_of(graph, RelationKind::kPartOf, part), ElementsAre(whole));
  EXPECT_EQ(support_of(graph, part)->kind, SupportKind::kWhole);
  EXPECT_GE(find_kind(graph, RelationKind::kPartOf)->evidence.contact_share.value(), 0.5);
  EXPECT_FALSE(find_kind(graph_of(room, {.parts = {}}), RelationKind::kPartOf));
  // What floats inside touches nothing.
  FurnishedRoom loose;
  loose.add("sofa", sofa);
  loose.add("cushion", standing(0.1, 0, 0.5, {0.2, 0.2, 0.2}));
  EXPECT_FALSE(find_kind(graph_of(loose), RelationKind::kPartOf));
}

}  // namespace
}  // namespace hypermap
