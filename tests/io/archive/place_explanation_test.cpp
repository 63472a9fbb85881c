// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/place_explanation.hpp"

#include "hypermap/projection/layers/semantic_layer.hpp"
#include "support/object_builders.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace hypermap {
namespace {

using testing_support::box_at;
using testing_support::observed;
using testing_support::scores;
using testing_support::surface_of;

/// Seen so many times, with a class of ten.
Object object_seen(const Box& box, int times) {
  Object object = make_object(observed(surface_of(box), scores(ClassId{1}, 0.8)), {});
  for (int i = 1; i < times; ++i) {
    update_object(object,
                  observed(surface_of(box), scores(ClassId{1}, 0.8), static_cast<std::uint64_t>(i)),
                  {});
  }
  return object;
}

TEST(PlaceExplanation, TellsWithheldObjectsFromShownOnes) {
  MapArchive archive;
  for (const char* name : {"a", "b", "c", "d", "e", "f", "g", "h", "i", "j"}) {
    ASSERT_TRUE(archive.classes.add(name));
  }
  (void)archive.objects.add(object_seen(box_at({0, 0, 0.5}, {0.4, 0.4, 0.4}), 8));
  (void)archive.objects.add(object_seen(box_at({3, 0, 0.5}, {0.4, 0.4, 0.4}), 1));
  SemanticLayer confirmed;
  const Polygon outline{.outer = {{-0.2, -0.2}, {0.2, -0.2}, {0.2, 0.2}, {-0.2, 0.2}}, .holes = {}};
  ASSERT_TRUE(confirmed.add({.id = 1, .name = "b", .parts = {outline}}));
  ASSERT_TRUE(archive.hypermap.add_layer({{.name = "semantic"}, confirmed}));

  const auto at_first = explain_place(archive, {.xy = {0.1, 0.1}, .z = 0.6});
  ASSERT_TRUE(at_first.has_value()) << to_string(at_first.error());
  EXPECT_EQ(at_first->shown, std::vector{ObjectId{1}});
  EXPECT_TRUE(at_first->withheld.empty());
  EXPECT_EQ(at_first->space, std::nullopt) << "no octree";

  const auto at_second = explain_place(archive, {.xy = {3.0, 0.0}, .z = 0.5});
  ASSERT_TRUE(at_second.has_value());
  EXPECT_TRUE(at_second->shown.empty());
  ASSERT_EQ(at_second->withheld.size(), 1U);
  EXPECT_EQ(at_second->withheld[0].id, ObjectId{2});
  ASSERT_FALSE(at_second->withheld[0].missed_conditions.empty());
  EXPECT_EQ(at_second->withheld[0].missed_conditions[0].condition, Condition::kObservations);
  EXPECT_EQ(at_second->nearest->id, ObjectId{1});
  const double side_x = archive.objects.at(ObjectId{1}).box.max_in_map.x();
  EXPECT_NEAR(at_second->nearest->distance_m, 3.0 - side_x, 1e-12);
  EXPECT_EQ(at_second->nearest_withheld, std::nullopt) << "it is there";
  EXPECT_EQ(at_first->nearest_withheld->id, ObjectId{2}) << "the only one, however far";

  // 0.3 m over the second one's box, of which only a part may have been seen.
  const double top_z = archive.objects.at(ObjectId{2}).box.max_in_map.z();
  const auto above = explain_place(archive, {.xy = {3.0, 0.0}, .z = top_z + 0.3});
  ASSERT_TRUE(above.has_value());
  EXPECT_TRUE(above->withheld.empty());
  EXPECT_EQ(above->nearest_withheld->id, ObjectId{2});
  EXPECT_NEAR(above->nearest_withheld->distance_m, 0.3, 1e-12);
}

TEST(PlaceExplanation, TellsByTheRulesThatItIsGiven) {
  MapArchive archive;
  for (const char* name : {"a", "b"}) ASSERT_TRUE(archive.classes.add(name));
  (void)archive.objects.add(object_seen(box_at({0, 0, 0.5}, {0.4, 0.4, 0.4}), 8));
  ASSERT_TRUE(archive.hypermap.add_layer({{.name = "semantic"}, SemanticLayer()}));
  const auto place = explain_place(archive, {.xy = {0.0, 0.0}}, {.min_observations = 20});
  ASSERT_TRUE(place.has_value());
  ASSERT_EQ(place->withheld.size(), 1U);
  EXPECT_EQ(place->withheld[0].missed_conditions[0],
            (MissedCondition{.condition = Condition::kObservations, .value = 8, .limit = 20}));
}

TEST(PlaceExplanation, OfAnEmptyMapKnowsNothing) {
  const auto place = explain_place(MapArchive(), {.xy = {0.0, 0.0}});
  ASSERT_TRUE(place.has_value());
  EXPECT_TRUE(place->shown.empty());
  EXPECT_TRUE(place->withheld.empty());
  EXPECT_EQ(place->nearest, std::nullopt);
}

}  // namespace
}  // namespace hypermap
