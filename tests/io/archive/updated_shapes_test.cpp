// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/updated_shapes.hpp"

#include "hypermap/io/archive/map_layers.hpp"
#include "io/archive/wide_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Shapes 1 to 40 stand for objects; 41 is tentative, and 42 was one.
MapArchive shown_map() {
  MapArchive map = test::wide_map();
  EXPECT_EQ(map.objects.add(test::sample_object()), ObjectId{41});
  const ObjectId forgotten = map.objects.add(test::sample_object());
  map.objects.erase(forgotten);
  return map;
}

TEST(UpdatedShapes, NewOnesStandForNoObject) {
  MapArchive map = shown_map();
  const auto done = update_shapes(
      map, kSemanticLayer, {.to_number = {test::shape_at(0, 1, 1), test::shape_at(0, 2, 1)}});
  ASSERT_TRUE(done) << to_string(done.error());
  EXPECT_THAT(done->added, ElementsAre(43, 44)) << "41 and 42 are taken by objects";
  EXPECT_EQ(confirmed_ids_of(map).size(), 40U);
}

TEST(UpdatedShapes, AnObjectThatIsNotShownIsNotShownByAShape) {
  MapArchive map = shown_map();
  const MapArchive before = map;
  const auto refused = update_shapes(map, kSemanticLayer, {.to_add = {test::shape_at(41, 1, 1)}});
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_string(refused.error()),
              HasSubstr("add[0].id: is that of an object of the map, 41"));
  EXPECT_EQ(map, before);
  const auto twice = update_shapes(map, kSemanticLayer, {.to_add = {test::shape_at(7, 1, 1)}});
  EXPECT_FALSE(twice) << "the layer has it";
  const auto free = update_shapes(map, kSemanticLayer, {.to_add = {test::shape_at(900, 1, 1)}});
  ASSERT_TRUE(free) << to_string(free.error());
  EXPECT_THAT(free->added, ElementsAre(900));
}

TEST(UpdatedShapes, OtherLayersNumberTheirOwn) {
  MapArchive map = shown_map();
  ASSERT_TRUE(map.hypermap.add_layer(
      {.info = {.name = "zones", .file = "zones"}, .content = SemanticLayer()}));
  const auto done = update_shapes(map, "zones", {.to_add = {test::shape_at(41, 1, 1)}});
  EXPECT_TRUE(done) << to_string(done.error());
}

}  // namespace
}  // namespace hypermap
