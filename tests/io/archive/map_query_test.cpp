// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_query.hpp"

#include "hypermap/io/archive/map_layers.hpp"
#include "io/archive/sample_archive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <limits>
#include <numbers>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::Field;
using testing::IsEmpty;

/// Two sofas, of which the layer `semantic` shows the second, and an object that nobody named.
MapArchive archive_with_sofas() {
  MapArchive archive;
  const ClassId sofa = archive.classes.add("couch").value();
  for (const double x : {0.0, 2.0, 4.0}) {
    Object object;
    if (x < 4.0) {
      object.belief.observe(std::array{ClassEvidence{sofa, Probability(0.9)}}, Probability(0.5));
    }
    object.box = {{x, 0.0, 0.0}, {x + 1.0, 1.0, 0.5}};
    object.centroid_in_map = object.box.centre();
    (void)archive.objects.add(object);
  }
  const Polygon square = make_polygon({{2, 0}, {3, 0}, {3, 1}, {2, 1}}).value();
  auto layer = SemanticLayer::create({{.id = 2, .name = "couch", .parts = {square}},
                                      {.id = 3, .name = "thing", .parts = {square}}});
  EXPECT_TRUE(archive.hypermap.add_layer({{.name = "semantic"}, std::move(layer).value()}));
  return archive;
}

auto ids_are(const std::vector<std::uint64_t>& ids) {
  std::vector<testing::Matcher<MapAnswer>> each;
  each.reserve(ids.size());
  for (const std::uint64_t id : ids) each.push_back(Field(&MapAnswer::id, id));
  return testing::ElementsAreArray(each);
}

TEST(MapQuery, OnlyObjectsThatTheMapShowsAnswer) {
  const MapArchive archive = archive_with_sofas();
  const auto all = query_map(archive, {.layer = "objects"}).value();
  EXPECT_EQ(all.frame_id, "map");
  EXPECT_THAT(all.found, ids_are({2, 3}));
  EXPECT_THAT(query_map(archive, {.layer = "objects", .text = "sofa"}).value().found, ids_are({2}));
  EXPECT_THAT(query_map(archive, {.layer = "objects", .value = 1}).value().found, IsEmpty());
}

TEST(MapQuery, AnObjectAnswersWithClassPlaceAndSize) {
  const MapArchive archive = archive_with_sofas();
  const auto found = query_map(archive, {.layer = "objects"}).value().found;
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].name, "couch");
  EXPECT_EQ(found[0].value, 2);
  EXPECT_EQ(found[0].position.xy, Eigen::Vector2d(2.5, 0.5));
  EXPECT_EQ(found[0].position.z, 0.25);
  EXPECT_EQ(found[0].size_m, Eigen::Vector3d(1.0, 1.0, 0.5));
  EXPECT_EQ(found[1].name, "unknown");
}

TEST(MapQuery, AnObjectAnswersWithAllThatIsBelievedOfIt) {
  MapArchive archive = archive_with_sofas();
  const ClassId bench = archive.classes.add("bench").value();
  const ClassId sofa = archive.classes.find("couch").value();
  archive.objects.modify(ObjectId{2}, [&](Object& object) {
    for (const ClassId id : {bench, sofa, sofa}) {
      object.observation_log.add({.class_id = id, .score = 0.7F, .distance_m = 2.0F});
    }
  });
  const auto found = query_map(archive, {.layer = "objects"}).value().found;
  ASSERT_EQ(found.size(), 2U);
  // One view with three detections: (2 / root 3)^2 to (1 / root 3)^2.
  ASSERT_TRUE(found[0].beliefs);
  ASSERT_EQ(found[0].beliefs->classes.size(), 2U);
  EXPECT_EQ(found[0].beliefs->classes[0].id, sofa);
  EXPECT_NEAR(found[0].beliefs->classes[0].probability.value(), 0.8, 1e-12);
  EXPECT_NEAR(found[0].beliefs->classes[1].probability.value(), 0.2, 1e-12);
  EXPECT_EQ(found[0].confidence, found[0].beliefs->confidence.value());
  ASSERT_TRUE(found[1].beliefs) << "of no class, but an object";
  EXPECT_TRUE(found[1].beliefs->classes.empty());
  EXPECT_FALSE(found[1].beliefs->class_entropy_nats);
  const auto nearest = query_nearest(archive, {.at = PlanPoint{{2.5, 0.5}}}).value().found;
  EXPECT_EQ(nearest.at(0).beliefs, found[0].beliefs);
  const MapAnswers shapes = query_map(archive, {.layer = "semantic", .value = 2}).value();
  for (const MapAnswer& shape : shapes.found) {
    EXPECT_FALSE(shape.beliefs) << "a shape is no object of the 3D map";
  }
}

// The layer `semantic` says 0.7 of the couch; of object 3 it says nothing.
TEST(MapQuery, AnObjectHasTheConfidenceOfTheSemanticLayer) {
  MapArchive archive = archive_with_sofas();
  const Polygon square = make_polygon({{2, 0}, {3, 0}, {3, 1}, {2, 1}}).value();
  auto layer =
      SemanticLayer::create({{.id = 2, .name = "couch", .parts = {square}, .confidence = {0.7}},
                             {.id = 3, .name = "thing", .parts = {square}}});
  ASSERT_TRUE(archive.hypermap.set_content("semantic", std::move(layer).value()));
  const auto found = query_map(archive, {.layer = "objects"}).value().found;
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].confidence, 0.7);
  EXPECT_EQ(found[1].confidence, object_confidence(archive.objects.at(ObjectId{3})).value());
  EXPECT_EQ(query_map(archive, {.layer = "semantic", .value = 2}).value().found.at(0).confidence,
            0.7);
}

TEST(MapQuery, CellsAndVoxelsHaveNoConfidence) {
  const MapArchive archive = test::sample_archive();
  for (const char* layer : {"occupancy", "octree"}) {
    for (const char* text : {"Free", "Occupied"}) {
      const auto found = query_map(archive, {.layer = layer, .text = text}).value().found;
      for (const MapAnswer& one : found) EXPECT_FALSE(one.confidence) << layer;
    }
  }
  EXPECT_FALSE(query_map(archive, {.layer = "occupancy", .text = "Free"}).value().found.empty());
}

TEST(MapQuery, ANumberThatIsNoIdNamesNoObject) {
  const MapArchive archive = archive_with_sofas();
  constexpr std::int64_t kTwoPlus2To32 = (std::int64_t{1} << 32) + 2;
  for (const std::int64_t value :
       {std::int64_t{0}, std::int64_t{-1}, kTwoPlus2To32, std::numeric_limits<std::int64_t>::max()})
    EXPECT_THAT(query_map(archive, {.layer = "objects", .value = value}).value().found, IsEmpty());
}

TEST(MapQuery, ALayerAnswersInTheFrameAskedFor) {
  const MapArchive archive = test::sample_archive();
  const MapQuery cup{.layer = "semantic", .text = "cup"};
  const auto own = query_map(archive, cup).value();
  EXPECT_EQ(own.frame_id, "lab");
  ASSERT_EQ(own.found.size(), 1U);
  EXPECT_EQ(own.found[0].position.z, std::nullopt);
  EXPECT_EQ(own.found[0].size_m, std::nullopt);
  MapQuery in_map = cup;
  in_map.frame_id = "map";
  const auto turned = query_map(archive, in_map).value();
  EXPECT_EQ(turned.frame_id, "map");
  EXPECT_NE(turned.found[0].position.xy, own.found[0].position.xy);
}

TEST(MapQuery, ALayerIsAskedByPointByAreaByTextAndByNumber) {
  const MapArchive archive = archive_with_sofas();
  const Polygon area = make_polygon({{0, 0}, {9, 0}, {9, 9}, {0, 9}}).value();
  const auto ask = [&](MapQuery query) {
    query.layer = "semantic";
    return query_map(archive, query).value().found;
  };
  EXPECT_THAT(ask({.at = PlanPoint{{2.5, 0.5}}}), ids_are({2, 3}));
  EXPECT_THAT(ask({.area = area}), ids_are({2, 3}));
  EXPECT_THAT(ask({.text = "thing", .area = area}), ids_are({3}));
  EXPECT_THAT(ask({.value = 2}), ids_are({2}));
}

TEST(MapQuery, ALayerRefusesWhatItCannotCombine) {
  const MapArchive archive = archive_with_sofas();
  for (const MapQuery& query : {MapQuery{.layer = "semantic"},
                                MapQuery{.layer = "semantic", .value = 1, .at = PlanPoint{}},
                                MapQuery{.layer = "semantic", .text = "couch", .value = 1}}) {
    const auto refused = query_map(archive, query);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  }
  EXPECT_EQ(query_map(archive, {.layer = "smells", .value = 1}).error().code, ErrorCode::kNotFound);
}

TEST(MapQuery, TheNearestIsOneThatTheMapShows) {
  const MapArchive archive = archive_with_sofas();
  const PlanPoint origin;
  EXPECT_THAT(query_nearest(archive, {.text = "sofa", .at = origin}).value().found, ids_are({2}));
  const auto none = query_nearest(archive, {.text = "zebra", .value = 7, .at = origin});
  EXPECT_EQ(none.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(none.error().what, "no object of class 'zebra' with id 7");
  EXPECT_EQ(query_nearest(archive, {.text = "sofa"}).error().field, "at");
}

TEST(MapQuery, TheNearestFulfilsAllOtherConditions) {
  // Objects 2 and 3 are shown, at x = 2.5 and 4.5.
  const MapArchive archive = archive_with_sofas();
  const PlanPoint origin;
  const Polygon right = make_polygon({{4, -1}, {9, -1}, {9, 2}, {4, 2}}).value();
  EXPECT_THAT(query_nearest(archive, {.at = origin}).value().found, ids_are({2}));
  EXPECT_THAT(query_nearest(archive, {.at = origin, .area = right}).value().found, ids_are({3}));
  EXPECT_THAT(query_nearest(archive, {.value = 3, .at = origin}).value().found, ids_are({3}));
  EXPECT_FALSE(query_nearest(archive, {.text = "sofa", .at = origin, .area = right}));
}

TEST(MapQuery, TheNearestIsAShapeWhereThereAreNo3dObjects) {
  MapArchive archive;
  const Polygon near = make_polygon({{2, 0}, {3, 0}, {3, 1}, {2, 1}}).value();  // about (2.5, 0.5)
  const Polygon far = make_polygon({{5, 0}, {6, 0}, {6, 1}, {5, 1}}).value();
  EXPECT_EQ(nearest_layer(archive), "objects");
  ASSERT_TRUE(archive.hypermap.add_layer({{.name = "furniture"}, SemanticLayer()}));
  EXPECT_EQ(nearest_layer(archive), "objects") << "no shapes either";
  ASSERT_TRUE(archive.hypermap.set_content(
      "furniture",
      SemanticLayer::create({{.id = 4, .name = "chair", .parts = {far}},
                             {.id = 7, .name = "chair", .parts = {near}},
                             {.id = 9, .name = "table", .parts = {near}}})
          .value()));
  EXPECT_EQ(nearest_layer(archive), "furniture");
  const PlanPoint corner{.xy = {2.5, 4.5}};
  const auto chairs = query_nearest(archive, {.text = "Chair", .at = corner}, 2).value().found;
  ASSERT_THAT(chairs, ids_are({7, 4}));
  EXPECT_NEAR(*chairs[0].distance_m, 4.0, 1e-12);
  EXPECT_NEAR(*chairs[1].distance_m, 5.0, 1e-12);  // 3 along x, 4 along y
  EXPECT_THAT(query_nearest(archive, {.at = corner}).value().found, ids_are({7})) << "or 9";
  EXPECT_THAT(query_nearest(archive, {.text = "chair", .value = 4, .at = corner}).value().found,
              ids_are({4}));
  const Polygon aside = make_polygon({{8, 8}, {9, 8}, {9, 9}, {8, 9}}).value();
  EXPECT_EQ(query_nearest(archive, {.text = "chair", .at = corner, .area = aside}).error().what,
            "no object of class 'chair' in the area");
  EXPECT_EQ(query_nearest(archive, {.text = "chiar", .at = corner}).error().what,
            "no object of class 'chiar', did you mean \"chair\"?");
  const auto high = query_nearest(archive, {.text = "chair", .at = PlanPoint{{2.5, 4.5}, 1.0}});
  EXPECT_EQ(high.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(high.error().field, "at");
  (void)archive.objects.add(Object{});
  EXPECT_EQ(nearest_layer(archive), "objects");
}

TEST(MapQuery, TheNearestIsMeasuredInTheFrameAskedFor) {
  MapArchive archive = archive_with_sofas();
  // The door's x axis is the map's -x axis: (0, 0) there is (7, 0.5) here.
  ASSERT_TRUE(archive.hypermap.frames().add({.frame_id = "map",
                                             .child_frame_id = "door",
                                             .x_m = 7.0,
                                             .y_m = 0.5,
                                             .yaw_rad = std::numbers::pi}));
  const MapQuery query{.at = PlanPoint{}, .frame_id = "door"};
  const auto answers = query_nearest(archive, query).value();
  EXPECT_EQ(answers.frame_id, "door");
  ASSERT_THAT(answers.found, ids_are({3}));
  EXPECT_NEAR(answers.found[0].position.xy.x(), 2.5, 1e-12);
  EXPECT_FALSE(query_nearest(archive, {.at = PlanPoint{}, .frame_id = "moon"}));
}

}  // namespace
}  // namespace hypermap
