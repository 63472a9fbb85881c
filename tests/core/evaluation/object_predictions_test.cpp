// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/object_predictions.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

/// A cube of half a metre on the floor.
EvaluatedObject cube(const std::string& name, double x) {
  EvaluatedObject object;
  object.class_name = name;
  object.centroid = {x, 0};
  object.footprint =
      make_polygon({{x - 0.25, -0.25}, {x + 0.25, -0.25}, {x + 0.25, 0.25}, {x - 0.25, 0.25}})
          .value();
  object.box = Box{{x - 0.25, -0.25, 0}, {x + 0.25, 0.25, 0.5}};
  object.frames_named = 5;
  return object;
}

BelievedObject believed(const std::string& name, double x, bool confirmed, double real) {
  return {.shape = cube(name, x),
          .is_confirmed = confirmed,
          .real_probability = real,
          .best_class_probability = 0.5};
}

std::vector<bool> outcomes(const std::vector<Prediction>& predictions) {
  std::vector<bool> result;
  result.reserve(predictions.size());
  for (const Prediction& prediction : predictions) result.push_back(prediction.is_true);
  return result;
}

TEST(ObjectPredictions, EachTruthIsOneObjectTheConfirmedOnesFirst) {
  // Two chairs at one true one: the confirmed one is it, though the tentative one is nearer. A
  // tentative chair at the other true one is real too; one where nothing is, is not.
  const std::vector truth{cube("chair", 0), cube("chair", 5)};
  const std::vector objects{believed("chair", 0.0, false, 0.1),
                            believed("chair", 0.2, true, 0.9),
                            believed("chair", 5.0, false, 0.3),
                            believed("chair", 9.0, true, 0.8)};
  const ObjectPredictions predictions = object_predictions(objects, truth);
  EXPECT_EQ(outcomes(predictions.real), (std::vector<bool>{false, true, true, false}));
  EXPECT_EQ(predictions.real[3].probability, 0.8);
  EXPECT_EQ(outcomes(predictions.best_class), (std::vector<bool>{true}));  // confirmed and real
  EXPECT_EQ(predictions.best_class[0].probability, 0.5);
}

TEST(ObjectPredictions, AnotherClassIsRealWhereTheBoxesOverlap) {
  // Cubes of 0.5 m, 0.2 m apart: 0.3 of 0.7. 0.45 m apart: 0.05 of 0.95, not enough.
  const std::vector truth{cube("sofa", 0), cube("sofa", 5)};
  const std::vector objects{believed("chair", 0.2, true, 0.9), believed("chair", 5.45, true, 0.9)};
  const ObjectPredictions predictions = object_predictions(objects, truth);
  EXPECT_EQ(outcomes(predictions.real), (std::vector<bool>{true, false}));
  EXPECT_EQ(outcomes(predictions.best_class), (std::vector<bool>{false}));
}

TEST(ObjectPredictions, WhatCannotBeNamedSaysNothingOfClasses) {
  std::vector truth{cube("bin", 0), cube("chair", 5), cube("chair", 9)};
  truth[0].is_nameable = false;
  truth[0].excluded = true;
  truth[1].excluded = true;  // rarely seen
  truth[2].excluded = true;  // of an older truth, which does not say why
  truth[2].frames_named.reset();
  const std::vector objects{believed("chair", 0, true, 0.9),
                            believed("chair", 5, true, 0.9),
                            believed("chair", 9, true, 0.9)};
  const ObjectPredictions predictions = object_predictions(objects, truth);
  EXPECT_EQ(outcomes(predictions.real), (std::vector<bool>{true, true, true}));
  EXPECT_EQ(outcomes(predictions.best_class), (std::vector<bool>{true}));
}

}  // namespace
}  // namespace hypermap
