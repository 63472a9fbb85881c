// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/semantic_update.hpp"

#include "hypermap/projection/layers/hypermap.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Polygon square_at(double x, double y, double edge = 1.0) {
  return make_polygon({{x, y}, {x + edge, y}, {x + edge, y + edge}, {x, y + edge}}).value();
}

SemanticObject shape(std::uint64_t id, const std::string& name, double x, double y) {
  return {.id = id, .name = name, .parts = {square_at(x, y)}};
}

/// A chair, a table and a cup in a row, two metres apart.
SemanticLayer three_objects() {
  return SemanticLayer::create(
             {shape(2, "chair", 0, 0), shape(5, "table", 2, 0), shape(9, "cup", 4, 0)})
      .value();
}

TEST(SemanticUpdate, AddsModifiesAndDeletesTogether) {
  SemanticLayer layer = three_objects();
  const auto report = layer.apply(
      {.to_add = {shape(3, "sofa", 6, 0)},
       .to_number = {shape(0, "plant", 8, 0), shape(0, "lamp", 10, 0)},
       .to_modify = {{.id = 5, .name = "desk"}, {.id = 9, .parts = {{square_at(12, 0)}}}},
       .to_delete = {2}});
  ASSERT_TRUE(report) << to_string(report.error());
  // 9 was the largest id.
  EXPECT_EQ(*report,
            (SemanticUpdateReport{.added = {3, 10, 11}, .num_modified = 2, .num_deleted = 1}));
  EXPECT_EQ(layer,
            SemanticLayer::create({shape(3, "sofa", 6, 0),
                                   shape(5, "desk", 2, 0),
                                   shape(9, "cup", 12, 0),
                                   shape(10, "plant", 8, 0),
                                   shape(11, "lamp", 10, 0)})
                .value());
  EXPECT_THAT(layer.at({12.5, 0.5}), ElementsAre(9));
  EXPECT_THAT(layer.at({4.5, 0.5}), IsEmpty());
  EXPECT_THAT(layer.of_class("table"), IsEmpty());
  EXPECT_THAT(layer.of_class("desk"), ElementsAre(5));
}

TEST(SemanticUpdate, AnIdOfADeletedObjectIsNotGivenAgainByTheSameUpdate) {
  SemanticLayer layer = three_objects();
  const auto report = layer.apply({.to_number = {shape(0, "plant", 8, 0)}, .to_delete = {9}});
  EXPECT_THAT(report.value().added, ElementsAre(10));
}

TEST(SemanticUpdate, AModificationKeepsAllElse) {
  SemanticObject object = shape(4, "chair", 0, 0);
  object.tags = {"a", "b"};
  object.confidence = {0.5, 0.7};
  object.shape_text = "as it was";
  object.extra = make_map({{"colour", make_text("red")}, {"owner", make_text("me")}});
  const SemanticObject renamed = modified(object, {.id = 4, .name = "stool"});
  EXPECT_EQ(renamed.shape_text, "as it was");
  EXPECT_EQ(renamed.tags, object.tags);
  EXPECT_EQ(renamed.extra, object.extra);
  const SemanticObject more =
      modified(object,
               {.id = 4,
                .parts = {{square_at(3, 3)}},
                .confidence = {{0.9}},
                .extra = make_map({{"colour", make_text("blue")}, {"age", make_text("7")}})});
  EXPECT_EQ(more.shape_text, "");
  EXPECT_THAT(more.confidence, ElementsAre(0.9));
  EXPECT_EQ(
      more.extra,
      make_map(
          {{"colour", make_text("blue")}, {"owner", make_text("me")}, {"age", make_text("7")}}));
}

struct Refusal {
  const char* name;
  SemanticUpdate update;
  ErrorCode code;
  const char* text;
};

class RefusedUpdate : public testing::TestWithParam<Refusal> {};

TEST_P(RefusedUpdate, ChangesNothingAndNamesTheObjectAndTheRule) {
  const SemanticLayer before = three_objects();
  SemanticLayer layer = before;
  SemanticUpdate update = GetParam().update;
  update.to_number.push_back(shape(0, "plant", 8, 0));  // what else the update wants is right
  const auto report = layer.apply(update);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, GetParam().code);
  EXPECT_THAT(to_string(report.error()), HasSubstr(GetParam().text));
  EXPECT_EQ(layer, before);
  EXPECT_THAT(layer.at({8.5, 0.5}), IsEmpty());
  EXPECT_THAT(layer.of_class("plant"), IsEmpty());
}

/// A ring that no polygon has.
SemanticObject bow_tie(std::uint64_t id) {
  return {.id = id, .name = "tie", .parts = {Polygon{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, {}}}};
}

INSTANTIATE_TEST_SUITE_P(
    All,
    RefusedUpdate,
    testing::Values(
        Refusal{"AddedIdIsThere",
                {.to_add = {shape(5, "sofa", 0, 0)}},
                ErrorCode::kInvalidArgument,
                "object 5 (sofa): id: is borne by an object of the layer"},
        Refusal{"AddedTwoTimes",
                {.to_add = {shape(7, "a", 0, 0), shape(7, "b", 0, 0)}},
                ErrorCode::kInvalidArgument,
                "object 7: id: stands more than once in the update"},
        Refusal{"ModifiedAndDeleted",
                {.to_modify = {{.id = 5, .name = "a"}}, .to_delete = {5}},
                ErrorCode::kInvalidArgument,
                "object 5: id: stands more than once in the update"},
        Refusal{"AddedAndDeleted",
                {.to_add = {shape(5, "a", 0, 0)}, .to_delete = {5}},
                ErrorCode::kInvalidArgument,
                "object 5: id: stands more than once in the update"},
        Refusal{"ModifiedIsNotThere",
                {.to_modify = {{.id = 6, .name = "a"}}},
                ErrorCode::kNotFound,
                "object 6: id: is not in the layer"},
        Refusal{"DeletedIsNotThere",
                {.to_delete = {2, 8}},
                ErrorCode::kNotFound,
                "object 8: id: is not in the layer"},
        Refusal{"AddedShapeIsNone",
                {.to_add = {bow_tie(7)}},
                ErrorCode::kInvalidArgument,
                "object 7 (tie): shape: "},
        Refusal{"ModifiedShapeIsNone",
                {.to_modify = {{.id = 5, .parts = {bow_tie(5).parts}}}},
                ErrorCode::kInvalidArgument,
                "object 5 (table): shape: "},
        Refusal{"ModifiedShapeIsEmpty",
                {.to_modify = {{.id = 5, .parts = std::vector<Polygon>()}}},
                ErrorCode::kInvalidArgument,
                "object 5 (table): shape: has no polygon"},
        Refusal{"ConfidenceIsNone",
                {.to_modify = {{.id = 5, .confidence = {{1.5}}}}},
                ErrorCode::kInvalidArgument,
                "object 5 (table): confidence: must be from 0 to 1"},
        Refusal{"TagsLeaveConfidencesOver",
                {.to_modify = {{.id = 5, .tags = {{"a", "b"}}, .confidence = {{0.1, 0.2, 0.3}}}}},
                ErrorCode::kInvalidArgument,
                "object 5 (table): confidence: 3 values for 2 tags"},
        Refusal{"NameIsEmpty",
                {.to_modify = {{.id = 5, .name = ""}}},
                ErrorCode::kInvalidArgument,
                "object 5 (): name: must not be empty"}),
    [](const auto& refusal) { return refusal.param.name; });

TEST(SemanticUpdate, KeepsTheLimitOfALayer) {
  std::vector<SemanticObject> many;
  for (std::uint64_t id = 0; id < SemanticLayer::kMaxObjects; ++id)
    many.push_back({.id = id, .name = "x", .parts = {Polygon{{{0, 0}, {1, 0}, {0, 1}}, {}}}});
  SemanticLayer layer = SemanticLayer::create(std::move(many)).value();
  EXPECT_EQ(layer.apply({.to_number = {shape(0, "y", 0, 0)}}).error().code, ErrorCode::kLimit);
  EXPECT_TRUE(layer.apply({.to_number = {shape(0, "y", 0, 0)}, .to_delete = {7}}));
  EXPECT_EQ(layer.objects().size(), SemanticLayer::kMaxObjects);
}

/// Random updates of a layer, and the objects that it must hold then.
class RandomUpdates {
 public:
  SemanticUpdate next() {
    SemanticUpdate update;
    for (auto it = model_.begin(); it != model_.end();) {
      const int choice = pick(10);
      if (choice == 0) {
        update.to_delete.push_back(it->first);
        it = model_.erase(it);
        continue;
      }
      if (choice == 1) modify(update, it->second);
      ++it;
    }
    const int num_new = pick(12);
    for (int i = 0; i < num_new; ++i) add(update);
    return update;
  }
  [[nodiscard]] std::vector<SemanticObject> objects() const {
    std::vector<SemanticObject> all;
    for (const auto& [id, object] : model_) all.push_back(object);
    return all;
  }
  double place() { return std::uniform_real_distribution<double>(-10, 10)(random_); }

 private:
  int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
  std::string name() { return pick(2) == 0 ? "chair" : "table"; }

  void add(SemanticUpdate& update) {
    const auto id = static_cast<std::uint64_t>(pick(100'000));
    if (!used_.insert({id, true}).second) return;
    const SemanticObject object = shape(id, name(), place(), place());
    update.to_add.push_back(object);
    model_[id] = object;
  }
  void modify(SemanticUpdate& update, SemanticObject& object) {
    SemanticModification change{.id = object.id};
    if (pick(2) == 0) change.name = name();
    if (pick(2) == 0) change.parts = {{square_at(place(), place(), 0.5)}};
    update.to_modify.push_back(change);
    object = modified(object, change);
  }

  std::mt19937 random_{11};
  std::map<std::uint64_t, SemanticObject> model_;
  std::map<std::uint64_t, bool> used_;
};

TEST(SemanticUpdate, AnyUpdatesLeaveTheLayerThatIsMadeOfWhatIsLeft) {
  RandomUpdates updates;
  SemanticLayer layer;
  for (int round = 0; round < 200; ++round) {
    ASSERT_TRUE(layer.apply(updates.next()));
    const std::vector<SemanticObject> expected = updates.objects();
    ASSERT_EQ(layer, SemanticLayer::create(expected).value()) << round;
    const Polygon area = square_at(updates.place(), updates.place(), 4.0);
    std::vector<std::uint64_t> in;
    std::vector<std::uint64_t> chairs;
    for (const SemanticObject& object : expected) {
      if (intersects(object.parts[0], area)) in.push_back(object.id);
      if (object.name == "chair") chairs.push_back(object.id);
    }
    ASSERT_EQ(layer.in(area), in) << round;
    ASSERT_EQ(layer.of_class("chair"), chairs) << round;
  }
  EXPECT_GT(layer.objects().size(), 20U);
}

TEST(SemanticUpdate, GoesByTheMapWhoseFlagsHold) {
  Hypermap map;
  const SemanticLayer layer = three_objects();
  ASSERT_TRUE(map.add_layer({.info = {.name = "open"}, .content = layer}));
  ASSERT_TRUE(map.add_layer({.info = {.name = "shut", .enable_update = false}, .content = layer}));
  ASSERT_TRUE(map.add_layer({.info = {.name = "cells"}, .content = OccupancyLayer()}));
  const SemanticUpdate update{.to_delete = {5}};
  EXPECT_EQ(map.update("open", update).value().num_deleted, 1U);
  EXPECT_EQ(map.find_as<SemanticLayer>("open")->find(5), nullptr);
  const auto shut = map.update("shut", update);
  EXPECT_EQ(shut.error().code, ErrorCode::kUnsupported);
  EXPECT_THAT(to_string(shut.error()), HasSubstr("shut takes no updates, as its enable_update"));
  EXPECT_EQ(*map.find_as<SemanticLayer>("shut"), layer);
  EXPECT_EQ(map.update("cells", update).error().code, ErrorCode::kUnsupported);
  EXPECT_EQ(map.update("none", update).error().code, ErrorCode::kNotFound);
  // Whoever shared the layer keeps it as it was.
  EXPECT_NE(layer.find(5), nullptr);
}

}  // namespace
}  // namespace hypermap
