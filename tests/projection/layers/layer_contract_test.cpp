// SPDX-License-Identifier: BSD-3-Clause
// What holds for every type of layer; the types of the strict form and one of a program's own.
#include "projection/layers/layer_contract.hpp"

#include "hypermap/projection/layers/hypermap.hpp"
#include "hypermap/projection/layers/layer_registry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <variant>

namespace hypermap {
namespace {

using test::expect_layer_contract;
using test::filtered;
using test::ids_of;
using test::NumberLayer;
using test::rectangle;

using Member = std::variant<std::string, ValueTree, OccupancyLayer, SemanticLayer>;

/// Members in memory, written and read.
class MemoryMembers final : public LayerWriter, public LayerReader {
 public:
  std::map<std::string, Member, std::less<>> members = {};

  Result<void> bytes(std::string_view suffix, std::string bytes) override {
    return put(suffix, std::move(bytes));
  }
  Result<void> yaml(std::string_view suffix, const ValueTree& tree) override {
    return put(suffix, tree);
  }
  Result<void> grid(std::string_view suffix, const OccupancyLayer& grid) override {
    return put(suffix, grid);
  }
  Result<void> shapes(std::string_view suffix, const SemanticLayer& shapes) override {
    return put(suffix, shapes);
  }
  [[nodiscard]] int version() const override { return 1; }
  Result<std::string> bytes(std::string_view suffix) override { return get<std::string>(suffix); }
  Result<ValueTree> yaml(std::string_view suffix) override { return get<ValueTree>(suffix); }
  Result<OccupancyLayer> grid(std::string_view suffix) override {
    return get<OccupancyLayer>(suffix);
  }
  Result<SemanticLayer> shapes(std::string_view suffix) override {
    return get<SemanticLayer>(suffix);
  }

 private:
  Result<void> put(std::string_view suffix, Member member) {
    members.emplace(suffix, std::move(member));
    return {};
  }
  template <class T>
  [[nodiscard]] Result<T> get(std::string_view suffix) const {
    const auto found = members.find(suffix);
    if (found == members.end()) return fail(ErrorCode::kMalformedFile, "is not there");
    return std::get<T>(found->second);
  }
};

template <class T>
struct Sample;
template <>
struct Sample<OccupancyLayer> {
  static OccupancyLayer make() {
    std::vector<std::int8_t> cells;
    cells.reserve(35);
    for (int i = 0; i < 35; ++i) cells.push_back(static_cast<std::int8_t>(i * 37 % 102 - 1));
    return OccupancyLayer(
        OccupancyGrid::create(
            {.resolution_m = 0.3, .origin = {1.0, -2.0}, .yaw_rad = 0.4, .cols = 7, .rows = 5},
            cells)
            .value());
  }
};
template <>
struct Sample<SemanticLayer> {
  static SemanticLayer make() {
    std::vector<SemanticObject> objects;
    objects.reserve(12);
    for (std::uint64_t i = 0; i < 12; ++i) {
      const std::uint64_t row = i / 4;
      const Eigen::Vector2d low(0.7 * static_cast<double>(i % 4), 0.9 * static_cast<double>(row));
      objects.push_back({.id = 3 * i,
                         .name = i % 2 == 0 ? "chair" : "cup",
                         .parts = {rectangle(low, low + Eigen::Vector2d(1.0, 0.5))}});
    }
    return SemanticLayer::create(objects).value();
  }
};
template <>
struct Sample<NumberLayer> {
  static NumberLayer make() { return NumberLayer(7); }
};

template <class T>
class LayerContract : public testing::Test {};
using LayerTypes = testing::Types<OccupancyLayer, SemanticLayer, NumberLayer>;
TYPED_TEST_SUITE(LayerContract, LayerTypes);

LayerRegistry all_types() {
  LayerRegistry types;
  EXPECT_TRUE(types.add(NumberLayer(), NumberLayer::load));
  return types;
}

TYPED_TEST(LayerContract, QueriesAreFiltersAndBoundsHoldAll) {
  expect_layer_contract(Sample<TypeParam>::make());
}

TYPED_TEST(LayerContract, AnEmptyLayerAnswersWithNothing) {
  const TypeParam empty;
  expect_layer_contract(empty);
  EXPECT_TRUE(ids_of(empty, {}).empty());
  EXPECT_TRUE(ids_of(empty, {.at = PlanPoint{}}).empty());
  EXPECT_TRUE(ids_of(empty, {.area = rectangle({-9, -9}, {9, 9})}).empty());
}

TYPED_TEST(LayerContract, SaveAndLoadIsAFixedPoint) {
  const LayerContent layer = Sample<TypeParam>::make();
  MemoryMembers members;
  ASSERT_TRUE(layer->save(members));
  const LayerRegistry types = all_types();
  const LayerType* type = types.find(layer->class_name());
  ASSERT_NE(type, nullptr);
  EXPECT_TRUE(type->empty == LayerContent(TypeParam()));
  const auto loaded = type->load(members);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_TRUE(*loaded == layer);
  EXPECT_FALSE(*loaded == type->empty);
  MemoryMembers nothing;
  EXPECT_EQ(type->load(nothing).error().code, ErrorCode::kMalformedFile);
}

TYPED_TEST(LayerContract, AnUpdateIsOfTheSameClass) {
  const TypeParam empty;
  const LayerContent layer = Sample<TypeParam>::make();
  const auto updated = empty.updated(layer);
  ASSERT_TRUE(updated) << to_string(updated.error());
  EXPECT_TRUE(*updated == layer);
  const auto refused = empty.updated(OpaqueLayer("Other"));
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().what, testing::HasSubstr("Other"));
}

TEST(LayerQueries, CellsOfAnAreaAreThoseThatItCovers) {
  const OccupancyLayer layer = Sample<OccupancyLayer>::make();
  const Polygon area = make_polygon({{1.1, -1.9}, {2.4, -1.2}, {1.5, -0.6}}).value();
  // Brute force: a cell shares area with the triangle when one of many points within it does.
  constexpr int kSteps = 40;
  const auto covered = [&](const LayerAnswer& answer) {
    const Cell cell = *cell_at(layer.grid.geometry(), answer.position);
    for (int i = 0; i < kSteps * kSteps; ++i) {
      const int row = i / kSteps;
      const Eigen::Vector2d within((i % kSteps + 0.5) / kSteps, (row + 0.5) / kSteps);
      const Eigen::Vector2d cells(cell.col + within.x(), cell.row + within.y());
      if (contains(area, from_cells(layer.grid.geometry(), cells))) return true;
    }
    return false;
  };
  EXPECT_EQ(ids_of(layer, {.area = area}), filtered(layer.query({}).value(), covered));
}

TEST(LayerQueries, ShapesOfAnAreaAreThoseThatItMeets) {
  const SemanticLayer layer = Sample<SemanticLayer>::make();
  const Polygon area = make_polygon({{0.2, 0.2}, {2.2, 0.6}, {0.9, 1.1}}).value();
  const auto meets = [&](const LayerAnswer& answer) {
    return intersects(layer.find(answer.id)->parts.front(), area);
  };
  EXPECT_EQ(ids_of(layer, {.area = area}), filtered(layer.query({}).value(), meets));
}

TEST(LayerUpdates, ShapesAreReplacedById) {
  const auto square = [](double x) { return rectangle({x, 0}, {x + 1, 1}); };
  const SemanticLayer layer =
      SemanticLayer::create({{.id = 1, .name = "cup", .parts = {square(0)}},
                             {.id = 2, .name = "sink", .parts = {square(2)}}})
          .value();
  const SemanticLayer update =
      SemanticLayer::create({{.id = 2, .name = "chair", .parts = {square(3)}},
                             {.id = 5, .name = "cup", .parts = {square(4)}}})
          .value();
  Hypermap map;
  ASSERT_TRUE(map.add_layer({.info = {.name = "a"}, .content = layer}));
  ASSERT_TRUE(map.update("a", update));
  const auto* updated = map.find_as<SemanticLayer>("a");
  EXPECT_EQ(updated->objects().size(), 3U);
  EXPECT_EQ(updated->find(1)->name, "cup");
  EXPECT_EQ(updated->find(2)->name, "chair");
  EXPECT_EQ(layer.find(2)->name, "sink");
}

TEST(LayerUpdates, ALayerThatTakesNoneStaysAsItWas) {
  Hypermap map;
  ASSERT_TRUE(
      map.add_layer({.info = {.name = "a", .enable_update = false}, .content = SemanticLayer()}));
  const auto update = Sample<SemanticLayer>::make();
  EXPECT_EQ(map.update("a", update).error().code, ErrorCode::kUnsupported);
  EXPECT_EQ(map.update("b", update).error().code, ErrorCode::kNotFound);
  EXPECT_TRUE(map.find("a")->content == SemanticLayer());
}

TEST(LayerRegistry, AClassIsRegisteredOnce) {
  LayerRegistry types = all_types();
  const auto twice = types.add(NumberLayer(), NumberLayer::load);
  ASSERT_FALSE(twice);
  EXPECT_THAT(twice.error().what, testing::HasSubstr("NumberLayer"));
  EXPECT_FALSE(types.add(SemanticLayer(), NumberLayer::load));
  EXPECT_FALSE(types.add(OpaqueLayer("../x"), NumberLayer::load));
  EXPECT_EQ(types.find("Other"), nullptr);
  EXPECT_EQ(LayerRegistry().find("NumberLayer"), nullptr);
}

TEST(Hypermap, ExtensionsStandBehindTheStrictForm) {
  Hypermap map;
  ASSERT_TRUE(map.add_layer({.info = {.name = "number"}, .content = NumberLayer(7)}));
  ASSERT_TRUE(map.add_layer({.info = {.name = "shapes"}, .content = SemanticLayer()}));
  ASSERT_TRUE(map.add_layer({.info = {.name = "odd"}, .content = OpaqueLayer("Other")}));
  const auto names = [&map] {
    std::vector<std::string> all;
    for (const Layer& layer : map.layers()) all.push_back(layer.info.name);
    return all;
  };
  EXPECT_THAT(names(), testing::ElementsAre("shapes", "odd", "number"));
  EXPECT_EQ(map.find("number")->info.file, "number");
  EXPECT_EQ(map.find("shapes")->info.file, std::nullopt);
  ASSERT_TRUE(map.set_content("number", SemanticLayer()));
  ASSERT_TRUE(map.set_content("shapes", NumberLayer(1)));
  EXPECT_THAT(names(), testing::ElementsAre("odd", "number", "shapes"));
}

}  // namespace
}  // namespace hypermap
