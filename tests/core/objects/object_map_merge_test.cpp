// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_map_merge.hpp"

#include "core/objects/association_cases.hpp"

#include <gtest/gtest.h>

#include <map>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using testing_support::box_at;
using testing_support::kChairBox;
using testing_support::kChairClass;
using testing_support::kCupClass;
using testing_support::kOvenClass;
using testing_support::observed;
using testing_support::only;
using testing_support::scores;
using testing_support::seen;
using testing_support::surface_of;

const AssociationOptions kMergeOptions;

/// A map, or one that goes on from `objects`, whose frames `first_frame`, ... each show these
/// observations.
ObjectMap map_of(const std::vector<Observation>& frame,
                 int num_frames,
                 std::uint64_t first_frame,
                 ObjectMap objects = {}) {
  for (int i = 0; i < num_frames; ++i) {
    std::vector<Observation> shown = frame;
    for (Observation& one : shown) {
      one.frame_index = first_frame + static_cast<std::uint64_t>(i);
      one.stamp = Stamp{1000 * static_cast<std::int64_t>(one.frame_index)};
    }
    associate(objects, shown, kMergeOptions);
  }
  return objects;
}

Observation cup_at(double x_m) {
  return seen(box_at({x_m, 0, 0.8}, {0.1, 0.1, 0.1}), kCupClass);
}

TEST(ObjectMapMerge, WhatBothMapsHaveIsOneObjectWithBothHistories) {
  const ObjectMap a = map_of({cup_at(2.0), seen(kChairBox, kChairClass)}, 3, 0);
  const ObjectMap b = map_of({seen(kChairBox, kChairClass)}, 4, 10);
  const ObjectMapMerge both = merged(a, b, kMergeOptions).value();
  EXPECT_EQ(both.objects.size(), 2U);
  EXPECT_EQ(both.num_joined, 1U);
  EXPECT_EQ(both.num_new, 0U);
  EXPECT_EQ(both.id_of_added.at(ObjectId{1}), ObjectId{2});
  const Object& chair = both.objects.at(ObjectId{2});
  EXPECT_EQ(chair.num_observations, 7U);
  EXPECT_EQ(chair.first_seen, Stamp{0});
  EXPECT_EQ(chair.last_seen, Stamp{13'000});
  EXPECT_EQ(chair.observation_log.state().newest.size(), 7U);
  EXPECT_EQ(chair.observation_log.num_detections(kChairClass), 7U);
  EXPECT_EQ(chair.points.state().num_observations, 7U);
  EXPECT_LT((chair.centroid_in_map - kChairBox.centre()).norm(), 0.01);
  EXPECT_EQ(both.objects.at(ObjectId{1}), a.at(ObjectId{1}));
}

TEST(ObjectMapMerge, WhatTheOtherMapAloneHasGetsANewId) {
  const ObjectMap a = map_of({seen(kChairBox, kChairClass)}, 2, 0);
  const ObjectMap b = map_of({cup_at(2.0), cup_at(3.0)}, 2, 10);
  const ObjectMapMerge both = merged(a, b, kMergeOptions).value();
  EXPECT_EQ(both.num_joined, 0U);
  EXPECT_EQ(both.num_new, 2U);
  EXPECT_EQ(both.id_of_added.at(ObjectId{1}), ObjectId{2});
  EXPECT_EQ(both.id_of_added.at(ObjectId{2}), ObjectId{3});
  EXPECT_EQ(both.objects.next_id(), ObjectId{4});
  EXPECT_EQ(both.objects.at(ObjectId{3}).box.centre(), b.at(ObjectId{2}).box.centre());
}

TEST(ObjectMapMerge, TwoSidesOfOneThingAreJoined) {
  const auto points = surface_of(kChairBox);
  const auto side = [&](double sign) {
    return observed(
        only(points,
             [&](const Eigen::Vector3f& p) { return sign * static_cast<double>(p.x()) > -0.1; }),
        scores(kChairClass, 0.8),
        0);
  };
  const ObjectMapMerge both =
      merged(map_of({side(1.0)}, 3, 0), map_of({side(-1.0)}, 3, 10), kMergeOptions).value();
  ASSERT_EQ(both.objects.size(), 1U);
  EXPECT_LT((both.objects.at(ObjectId{1}).box.extent() - kChairBox.extent()).cwiseAbs().maxCoeff(),
            0.03);
}

TEST(ObjectMapMerge, PartsOfWhatTheOtherMapSawWholeAreJoined) {
  // One map saw the ends of a bench, one after the other, and never both in one frame.
  const Observation left = seen(box_at({-0.5, 0, 0.4}, {0.6, 0.4, 0.4}), kChairClass);
  const Observation right = seen(box_at({0.5, 0, 0.4}, {0.6, 0.4, 0.4}), kChairClass);
  const ObjectMap parts = map_of({right}, 3, 3, map_of({left}, 3, 0));
  const ObjectMap whole = map_of({seen(box_at({0, 0, 0.4}, {1.6, 0.4, 0.4}), kChairClass)}, 3, 10);
  ASSERT_EQ(parts.size(), 2U);
  const ObjectMapMerge both = merged(parts, whole, kMergeOptions).value();
  ASSERT_EQ(both.objects.size(), 1U);
  EXPECT_EQ(both.objects.at(ObjectId{1}).num_observations, 9U);
  EXPECT_EQ(both.id_of_absorbed, (std::map<ObjectId, ObjectId>{{ObjectId{2}, ObjectId{1}}}));
  EXPECT_EQ(both.id_of_added.at(ObjectId{1}), ObjectId{1});
  EXPECT_EQ(both.num_joined, 1U);
  const ObjectMapMerge reversed = merged(whole, parts, kMergeOptions).value();
  ASSERT_EQ(reversed.objects.size(), 1U);
  EXPECT_TRUE(reversed.id_of_absorbed.empty());
  EXPECT_EQ(reversed.id_of_added.at(ObjectId{1}), ObjectId{1});
  EXPECT_EQ(reversed.id_of_added.at(ObjectId{2}), ObjectId{1});
  EXPECT_EQ(reversed.num_joined, 2U);
  EXPECT_EQ(reversed.num_new, 0U);
}

TEST(ObjectMapMerge, TwoThatFramesShowedBesideEachOtherStayTwo) {
  // One map has two halves of a bench, seen beside each other; the other took it for one.
  const Box bench = box_at({0, 0, 0.4}, {1.6, 0.4, 0.4});
  const Box left = box_at({-0.4, 0, 0.4}, {0.78, 0.4, 0.4});
  const Box right = box_at({0.4, 0, 0.4}, {0.78, 0.4, 0.4});
  const ObjectMap halves = map_of({seen(left, kChairClass), seen(right, kChairClass)}, 3, 0);
  const ObjectMap whole = map_of({seen(bench, kChairClass)}, 3, 10);
  ASSERT_EQ(halves.size(), 2U);
  for (const auto& both : {merged(halves, whole, kMergeOptions).value(),
                           merged(whole, halves, kMergeOptions).value()}) {
    EXPECT_EQ(both.objects.size(), 2U);
    EXPECT_EQ(both.num_joined, 1U);
  }
}

TEST(ObjectMapMerge, ThePairsAreThoseOfTheLargestSumOfAffinities) {
  // Each cup of the one map is nearest to the first of the other; both keep a partner.
  const ObjectMap a = map_of({cup_at(0.00), cup_at(0.12)}, 3, 0);
  const ObjectMap b = map_of({cup_at(0.01), cup_at(0.13)}, 3, 10);
  const ObjectMapMerge both = merged(a, b, kMergeOptions).value();
  EXPECT_EQ(both.num_joined, 2U);
  for (const auto& [added, into] : both.id_of_added) {
    EXPECT_NEAR(b.at(added).centroid_in_map.x(), a.at(into).centroid_in_map.x(), 0.03);
  }
}

TEST(ObjectMapMerge, TheOrderOfTwoMapsChangesIdsAlone) {
  const ObjectMap a = map_of({seen(kChairBox, kChairClass), cup_at(2.0)}, 5, 0);
  const ObjectMap b =
      map_of({seen(box_at({0.02, 0.01, 0.45}, {0.5, 0.5, 0.9}), kChairClass), cup_at(4.0)}, 3, 10);
  const ObjectMap ab = merged(a, b, kMergeOptions).value().objects;
  const ObjectMap ba = merged(b, a, kMergeOptions).value().objects;
  ASSERT_EQ(ab.size(), 3U);
  ASSERT_EQ(ba.size(), 3U);
  for (const Object& object : ab.objects()) {
    const auto best = best_class(object);
    const auto other = ba.nearest(PointInMap{object.centroid_in_map}, best->id);
    ASSERT_TRUE(other);
    EXPECT_EQ(ba.at(*other).centroid_in_map, object.centroid_in_map);
    EXPECT_EQ(ba.at(*other).num_observations, object.num_observations);
  }
}

TEST(ObjectMapMerge, AnEmptyMapChangesNothing) {
  const ObjectMap a = map_of({seen(kChairBox, kChairClass), cup_at(2.0)}, 5, 0);
  EXPECT_EQ(merged(a, ObjectMap{}, kMergeOptions).value().objects, a);
  EXPECT_EQ(merged(ObjectMap{}, a, kMergeOptions).value().objects, a);
}

TEST(ObjectMapMerge, ObjectsOfOtherOptionsAreRefused) {
  ObjectMap coarse;
  AssociationOptions options = kMergeOptions;
  options.points.edge_m = 0.02;
  associate(coarse, std::vector{seen(kChairBox, kChairClass)}, options);
  const ObjectMap fine = map_of({seen(kChairBox, kChairClass)}, 2, 0);
  const Error error = merged(fine, coarse, kMergeOptions).error();
  EXPECT_EQ(error.code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(error.entry, "object 1");
  EXPECT_EQ(error.field, "points");
}

TEST(ObjectMapMerge, EmbeddingsOfAnotherDimensionAreRefused) {
  Observation two = seen(kChairBox, kChairClass);
  two.embeddings = {{.model = "net", .vector = {1.0F, 0.0F}}};
  Observation three = cup_at(3.0);
  three.embeddings = {{.model = "net", .vector = {1.0F, 0.0F, 0.0F}}};
  EXPECT_EQ(merged(map_of({two}, 1, 0), map_of({three}, 1, 5), kMergeOptions).error().code,
            ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace hypermap
