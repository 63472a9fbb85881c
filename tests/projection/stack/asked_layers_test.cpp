// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/stack/asked_layers.hpp"

#include "grid_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hypermap {
namespace {

using test::pose;
using test::random_grid;
using test::sized;
using testing::ElementsAre;
using testing::HasSubstr;

GridStack stack_of_classes() {
  GridStack stack = GridStack::create(sized(3, 2)).value();
  for (const char* name : {"/ism/chair",
                           "/ism/couch",
                           "/ism/detections/chair",
                           "/ism/detections/cup",
                           "/ism/diningtable"}) {
    const LogOddsGrid grid = random_grid(sized(3, 2), 1, 500);
    EXPECT_TRUE(stack.fuse({.layer = name, .grid = grid}, pose(0, 0)));
  }
  return stack;
}

ClassVocabulary vocabulary_of_seats() {
  return ClassVocabulary::create(
             {.aliases = {{{"sofa"}, {{"settee"}}}, {{"chair"}, {{"stool"}}}},
              .super_classes = {{{"seat"}, {{"chair"}, {"sofa"}}}, {{"tool"}, {{"saw"}}}}})
      .value();
}

std::vector<std::string> layers_for(const std::string& text) {
  const auto layers = asked_layers(text, stack_of_classes(), vocabulary_of_seats());
  if (!layers) return {to_string(layers.error())};
  return *layers;
}

TEST(AskedLayers, ANameIsItsLayerAndAllBelow) {
  EXPECT_THAT(layers_for("chair"), ElementsAre("/ism/chair"));
  EXPECT_THAT(layers_for("/ism/chair"), ElementsAre("/ism/chair"));
  EXPECT_THAT(layers_for("detections"),
              ElementsAre("/ism/detections/chair", "/ism/detections/cup"));
  EXPECT_THAT(layers_for("/ism"),
              ElementsAre("/ism/chair",
                          "/ism/couch",
                          "/ism/detections/chair",
                          "/ism/detections/cup",
                          "/ism/diningtable"));
}

TEST(AskedLayers, AClassIsAskedForAsEverywhere) {
  EXPECT_THAT(layers_for("Dining-Table"), ElementsAre("/ism/diningtable"));
  EXPECT_THAT(layers_for("stool"), ElementsAre("/ism/chair"));
  EXPECT_THAT(layers_for("seat"), ElementsAre("/ism/chair", "/ism/couch"));
  EXPECT_THAT(layers_for("c*"), ElementsAre("/ism/chair", "/ism/couch"));
  EXPECT_THAT(layers_for("/chair|cou.*/"), ElementsAre("/ism/chair", "/ism/couch"));
}

TEST(AskedLayers, WhatIsNotThereIsSaidAndHow) {
  EXPECT_THAT(layers_for("chiar").at(0),
              HasSubstr("layers: no layer is named \"/ism/chiar\", did you mean \"/ism/chair\"? "
                        "(there are: /ism/chair, /ism/couch, "));
  EXPECT_THAT(layers_for("tool").at(0), HasSubstr("layers: no layer is of \"tool\" (saw, tool)"));
  EXPECT_THAT(layers_for("x*").at(0), HasSubstr("layers: no layer begins with \"x\""));
  EXPECT_THAT(layers_for("/x/").at(0), HasSubstr("layers: no layer matches /x/"));
  EXPECT_THAT(layers_for("/(/").at(0), HasSubstr("layers: "));
}

}  // namespace
}  // namespace hypermap
