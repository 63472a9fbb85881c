// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/hypermap.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace hypermap {
namespace {

Layer layer(const std::string& name) {
  return {.info = {.name = name}, .content = SemanticLayer()};
}

TEST(Hypermap, LayersKeepTheirOrderAndClass) {
  Hypermap map;
  ASSERT_TRUE(map.add_layer({.info = {.name = "b"}, .content = OccupancyLayer()}));
  ASSERT_TRUE(map.add_layer(layer("a")));
  ASSERT_TRUE(map.add_layer({.info = {.name = "c"}, .content = OpaqueLayer{"ElevationLayer"}}));
  ASSERT_EQ(map.layers().size(), 3U);
  EXPECT_EQ(class_of(map.layers()[0]), "OccupancyGridLayer");
  EXPECT_EQ(class_of(map.layers()[1]), "SemanticLayer");
  EXPECT_EQ(class_of(map.layers()[2]), "ElevationLayer");
  EXPECT_EQ(map.find("a")->info.name, "a");
  EXPECT_EQ(map.find("z"), nullptr);
  EXPECT_THAT(map.at("z").error().what, ::testing::HasSubstr("there are: b, a, c"));
}

TEST(Hypermap, NamesArePlainAndUnique) {
  Hypermap map;
  ASSERT_TRUE(map.add_layer(layer("a")));
  EXPECT_EQ(map.add_layer(layer("a")).error().field, "name");
  for (const char* bad : {"", "../x", "a/b", "a\\b", "C:x", ".", "..", " a", "a ", "a\n", "\xFF"}) {
    EXPECT_FALSE(map.add_layer(layer(bad))) << bad;
  }
  EXPECT_TRUE(map.add_layer(layer("caf\xC3\xA9 2.1")));
  EXPECT_FALSE(map.add_layer(layer(std::string(201, 'x'))));
}

TEST(Hypermap, TheNumberOfLayersIsLimited) {
  Hypermap map;
  for (std::size_t i = 0; i < Hypermap::kMaxLayers; ++i) {
    ASSERT_TRUE(map.add_layer(layer("n" + std::to_string(i))));
  }
  EXPECT_EQ(map.add_layer(layer("one more")).error().code, ErrorCode::kLimit);
}

TEST(Hypermap, ContentIsReplacedAndLayersAreRemoved) {
  Hypermap map;
  ASSERT_TRUE(map.add_layer(layer("a")));
  EXPECT_TRUE(map.set_content("a", OccupancyLayer()));
  EXPECT_EQ(class_of(*map.find("a")), kOccupancyLayerClass);
  EXPECT_FALSE(map.set_content("b", OccupancyLayer()));
  EXPECT_TRUE(map.remove_layer("a"));
  EXPECT_FALSE(map.remove_layer("a"));
}

TEST(Hypermap, ALayerHasAFrame) {
  Hypermap map;
  Layer nowhere = layer("a");
  nowhere.info.frame_id.clear();
  EXPECT_EQ(map.add_layer(nowhere).error().field, "frame_id");
}

TEST(Hypermap, APartOfAGridTakesThePlaceOfItsCells) {
  const auto cells = [](const GridGeometry& geometry, std::int8_t value) {
    return OccupancyGrid::create(geometry, value).value();
  };
  const GridGeometry whole{.resolution_m = 1.0, .cols = 3, .rows = 1};
  const GridGeometry middle{.resolution_m = 1.0, .origin = {1, 0}, .cols = 1, .rows = 1};
  Hypermap map;
  for (const bool open : {true, false}) {
    ASSERT_TRUE(map.add_layer({.info = {.name = open ? "open" : "shut", .enable_update = open},
                               .content = OccupancyLayer(cells(whole, 0))}));
  }
  ASSERT_TRUE(map.add_layer({.info = {.name = "shapes"}, .content = SemanticLayer()}));
  ASSERT_TRUE(map.update("open", cells(middle, 100)));
  const auto& grid = map.find_as<OccupancyLayer>("open")->grid;
  EXPECT_EQ(std::vector<std::int8_t>(grid.cells().begin(), grid.cells().end()),
            (std::vector<std::int8_t>{0, 100, 0}));
  EXPECT_EQ(map.update("shut", cells(middle, 100)).error().code, ErrorCode::kUnsupported);
  EXPECT_EQ(map.find_as<OccupancyLayer>("shut")->grid, cells(whole, 0));
  EXPECT_EQ(map.update("shapes", cells(middle, 100)).error().code, ErrorCode::kUnsupported);
  GridGeometry beyond = middle;
  beyond.origin.x() = 3;
  EXPECT_EQ(map.update("open", cells(beyond, 0)).error().code, ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace hypermap
