// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/class_stack.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kEdge = 0.1;

/// Leaves along x at a height of 0.5 m, each of log-odds 2 and of the class at its place.
LeafSource row_of(std::vector<std::optional<ClassId>> classes) {
  return [classes = std::move(classes)](const auto& visit) {
    for (std::size_t i = 0; i < classes.size(); ++i) {
      LeafSample leaf;
      leaf.centre_in_map = {kEdge * (static_cast<double>(i) + 0.5), 0.05, 0.55};
      leaf.edge_m = kEdge;
      leaf.occupied = true;
      leaf.occupancy = LogOdds(2.0);
      leaf.best_class = classes[i];
      if (classes[i]) leaf.class_log_odds = LogOdds(1.5);
      visit(leaf);
    }
  };
}

ClassRegistry registry_of(const std::vector<std::string>& names) {
  ClassRegistry classes;
  for (const std::string& name : names) EXPECT_TRUE(classes.add(name));
  return classes;
}

std::vector<std::string> names_of(const GridStack& stack) {
  std::vector<std::string> names;
  for (const auto& [name, grid] : stack.layers()) names.push_back(name);
  return names;
}

TEST(ClassStack, HasALayerForEachClassInTheBand) {
  const LeafSource leaves = row_of({ClassId{0}, ClassId{2}, std::nullopt});
  const ClassRegistry classes = registry_of({"chair", "never seen", "a/b"});
  const GridStack stack = class_stack(leaves, classes, {}).value();
  EXPECT_THAT(names_of(stack), ElementsAre("/ism/a_b", "/ism/chair"));
  EXPECT_THAT(stack.layers().at("/ism/chair").cells(), ElementsAre(1500, -1500, -2000));
  EXPECT_THAT(names_of(class_stack(leaves, classes, {.classes = {"Chair"}}).value()),
              ElementsAre("/ism/chair"));
  EXPECT_THAT(names_of(class_stack(leaves, classes, {.options = {.parent = "/map"}}).value()),
              ElementsAre("/map/a_b", "/map/chair"));
}

TEST(ClassStack, OfLeavesWithoutClassesHasNoLayers) {
  EXPECT_TRUE(class_stack(row_of({std::nullopt}), {}, {})->layers().empty());
}

TEST(ClassStack, SaysWhatIsNotThere) {
  const LeafSource leaves = row_of({ClassId{0}});
  const ClassRegistry classes = registry_of({"chair"});
  const auto high = class_stack(leaves, classes, {.band = {.min_m = 2, .max_m = 3}});
  EXPECT_EQ(high.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(high.error().what, HasSubstr("heights of 2 and 3 m"));
  const auto chiar = class_stack(leaves, classes, {.classes = {"chiar"}});
  EXPECT_EQ(chiar.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(chiar.error().what, HasSubstr("chair"));
}

}  // namespace
}  // namespace hypermap
