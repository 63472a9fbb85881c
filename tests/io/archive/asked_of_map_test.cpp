// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/asked_of_map.hpp"

#include "hypermap/io/archive/archive_layers.hpp"
#include "hypermap/io/archive/class_stack.hpp"
#include "hypermap/io/archive/grid_stack_layer.hpp"
#include "hypermap/io/archive/map_query.hpp"
#include "hypermap/io/archive/object_relations.hpp"
#include "hypermap/io/archive/related_query.hpp"
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

ClassVocabulary words_of_seats() {
  return ClassVocabulary::create({.aliases = {{{"sofa"}, {{"settee"}}}},
                                  .super_classes = {{{"seat"}, {{"chair"}, {"sofa"}}},
                                                    {{"furniture"}, {{"seat"}, {"table"}}},
                                                    {{"tool"}, {{"saw"}}}}})
      .value();
}

Object object_at(double x, ClassId id) {
  Object object;
  object.belief.observe(std::array{ClassEvidence{id, Probability(0.9)}}, Probability(0.5));
  object.box = {{x, 0.0, 0.0}, {x + 1.0, 1.0, 0.5}};
  object.centroid_in_map = object.box.centre();
  return object;
}

/// Objects 1 to 4 along x: a settee, a chair, a table, a cup; as objects, as shapes, as voxels, as
/// class grids and as layers of a stack.
MapArchive archive_of_seats() {
  MapArchive archive;
  archive.vocabulary = words_of_seats();
  std::vector<SemanticObject> shapes;
  std::vector<StoredLeaf> leaves;
  const GridGeometry geometry{.resolution_m = 1.0, .cols = 4, .rows = 1};
  double x = 0.0;
  for (const char* name : {"settee", "chair", "table", "cup"}) {
    const ClassId id = archive.classes.add(name).value();
    const ObjectId object = archive.objects.add(object_at(x, id));
    const Polygon square = make_polygon({{x, 0}, {x + 1, 0}, {x + 1, 1}, {x, 1}}).value();
    shapes.push_back({.id = object.value, .name = name, .parts = {square}});
    std::vector<std::int8_t> cells(4, 0);
    cells[static_cast<std::size_t>(x)] = 100;
    archive.class_grids.push_back(
        {.class_name = name, .grid = OccupancyGrid::create(geometry, cells).value()});
    StoredLeaf leaf{.key = {static_cast<std::uint16_t>(32768 + id.value), 32768, 32778},
                    .log_odds = 2000};
    leaf.label = VoxelLabel{};
    leaf.label->classes[0] = {.class_id = static_cast<std::uint16_t>(id.value), .log_odds = 1500};
    leaves.push_back(leaf);
    x += 1.0;
  }
  archive.octree = SemanticOctree::from_leaves({}, leaves).value();
  EXPECT_TRUE(archive.hypermap.add_layer(
      {{.name = "stack"},
       GridStackLayer(class_stack(leaf_source(*archive.octree), archive.classes, {}).value())}));
  EXPECT_TRUE(archive.hypermap.add_layer(
      {{.name = "semantic"}, SemanticLayer::create(std::move(shapes)).value()}));
  return archive;
}

std::vector<std::uint64_t> ids_asked(const MapArchive& archive,
                                     const std::string& layer,
                                     const std::string& text) {
  const auto answers = query_map(archive, {.layer = layer, .text = text});
  if (!answers) return {999};
  std::vector<std::uint64_t> ids;
  for (const MapAnswer& one : answers->found) ids.push_back(one.id);
  return ids;
}

TEST(AskedOfMap, LayersOfObjectsAnswerAlike) {
  const MapArchive archive = archive_of_seats();
  for (const char* layer : {"objects", "semantic"}) {
    EXPECT_THAT(ids_asked(archive, layer, "sofa"), ElementsAre(1)) << layer;
    EXPECT_THAT(ids_asked(archive, layer, "couch"), ElementsAre(1)) << layer;
    EXPECT_THAT(ids_asked(archive, layer, "Settee"), ElementsAre(1)) << layer;
    EXPECT_THAT(ids_asked(archive, layer, "seat"), ElementsAre(1, 2)) << layer;
    EXPECT_THAT(ids_asked(archive, layer, "furniture"), ElementsAre(1, 2, 3)) << layer;
    EXPECT_THAT(ids_asked(archive, layer, "furn*"), ElementsAre(1, 2, 3)) << layer;
    EXPECT_THAT(ids_asked(archive, layer, "c*"), ElementsAre(2, 4)) << layer;
    EXPECT_THAT(ids_asked(archive, layer, "/c(up|hair)/"), ElementsAre(2, 4)) << layer;
    EXPECT_THAT(ids_asked(archive, layer, "tool"), IsEmpty()) << layer;
  }
}

TEST(AskedOfMap, VoxelsAndCellsAnswerAlike) {
  const MapArchive archive = archive_of_seats();
  for (const char* layer : {"evidence", "stack"}) {
    const auto count = [&](const std::string& text) {
      return ids_asked(archive, layer, text).size();
    };
    EXPECT_EQ(count("couch"), 1U) << layer;
    EXPECT_EQ(count("seat"), 2U) << layer;
    EXPECT_EQ(count("furniture"), 3U) << layer;
    EXPECT_EQ(count("c*"), 2U) << layer;
    EXPECT_EQ(count("/.*/"), 4U) << layer;
    EXPECT_EQ(count("tool"), 0U) << layer;
  }
}

TEST(AskedOfMap, AStackIsOfWhatItsClassesAskFor) {
  const MapArchive archive = archive_of_seats();
  ClassStackRequest request{.classes = {"seat"}};
  request.vocabulary = archive.vocabulary;
  const auto stack = class_stack(leaf_source(*archive.octree), archive.classes, request);
  ASSERT_TRUE(stack) << to_string(stack.error());
  std::vector<std::string> names;
  for (const auto& [name, grid] : stack->layers()) names.push_back(name);
  EXPECT_THAT(names, ElementsAre("/ism/chair", "/ism/settee"));
  request.classes = {"tool"};
  const auto none = class_stack(leaf_source(*archive.octree), archive.classes, request);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().field, "--class");
}

TEST(AskedOfMap, AnotherVocabularyGivesOtherAnswersOfTheSameMap) {
  MapArchive archive = archive_of_seats();
  archive.vocabulary = {};
  EXPECT_THAT(ids_asked(archive, "objects", "sofa"), IsEmpty());
  EXPECT_THAT(ids_asked(archive, "objects", "seat"), IsEmpty());
  EXPECT_THAT(ids_asked(archive, "objects", "settee"), ElementsAre(1));
  archive.vocabulary =
      ClassVocabulary::create({.aliases = {{{"cup"}, {{"settee"}}}}, .super_classes = {}}).value();
  EXPECT_THAT(ids_asked(archive, "objects", "cup"), ElementsAre(1, 4));
}

TEST(AskedOfMap, AGridIsCalledByAnAliasOfItsClass) {
  const MapArchive archive = archive_of_seats();
  EXPECT_THAT(ids_asked(archive, "sofa", "Occupied"), ElementsAre(0));
  EXPECT_THAT(ids_asked(archive, "Chair", "Occ*"), ElementsAre(1));
  EXPECT_FALSE(archive_layer(archive, "seat"));
}

TEST(AskedOfMap, NearestAndRelationsAskLikewise) {
  const MapArchive archive = archive_of_seats();
  const PlanPoint far{.xy = {9.0, 0.0}};
  const auto nearest = [&](const std::string& text) {
    const auto answers = query_nearest(archive, {.text = text, .at = far});
    return answers ? answers->found.at(0).id : 0U;
  };
  EXPECT_EQ(nearest("seat"), 2U);
  EXPECT_EQ(nearest("furniture"), 3U);
  EXPECT_EQ(nearest("*"), 4U);
  const auto none = query_nearest(archive, {.text = "tool", .at = far});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().what, "no object of class 'tool': no class is of \"tool\" (saw, tool)");
  const RelationGraph graph = archive_relations(archive);
  const auto beside = query_related(archive, graph, {{RelationKind::kBeside, "seat"}}, {});
  ASSERT_TRUE(beside) << to_string(beside.error());
  const auto by_names = [&](const std::string& name) {
    std::vector<std::uint64_t> ids;
    const auto found = query_related(archive, graph, {{RelationKind::kBeside, name}}, {});
    for (const MapAnswer& one : found->found) ids.push_back(one.id);
    return ids;
  };
  // Who is beside a seat is beside the settee or the chair.
  std::vector<std::uint64_t> either = by_names("settee");
  for (const std::uint64_t id : by_names("chair")) either.push_back(id);
  std::sort(either.begin(), either.end());
  either.erase(std::unique(either.begin(), either.end()), either.end());
  EXPECT_FALSE(either.empty());
  EXPECT_EQ(by_names("seat"), either);
  const auto no_tool = query_related(archive, graph, {{RelationKind::kOn, "tool"}}, {});
  ASSERT_FALSE(no_tool);
  EXPECT_EQ(no_tool.error().field, "on");
  EXPECT_EQ(no_tool.error().what, "no class is of \"tool\" (saw, tool)");
  EXPECT_THAT(query_related(archive, graph, {{RelationKind::kOn, "/(/"}}, {}).error().what,
              HasSubstr("no regular expression"));
}

TEST(AskedOfMap, ABadExpressionIsOfTheText) {
  const auto bad = query_map(archive_of_seats(), {.layer = "objects", .text = "/[/"});
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(bad.error().field, "string");
}

TEST(AskedOfMap, NamesAreThoseThatAnythingAnswers) {
  const MapArchive archive = archive_of_seats();
  EXPECT_THAT(
      names_in(archive),
      ElementsAre(
          "Free", "Occupied", "Unknown", "chair", "cup", "path", "settee", "support", "table"));
  EXPECT_TRUE(is_class_of_map(archive, "furniture"));
  EXPECT_FALSE(is_class_of_map(archive, "tool"));
  EXPECT_FALSE(is_class_of_map(archive, "Free"));
  EXPECT_EQ(asked_classes(archive, std::vector<std::string>{"seat"}).value(),
            (std::vector<ClassId>{{0}, {1}}));
}

}  // namespace
}  // namespace hypermap
