// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/combiner/combiner_training.hpp"

#include "hypermap/core/segmentation/stacking.hpp"
#include "hypermap/io/combiner/combiner_file.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace hypermap {
namespace {

const std::vector<std::string> kClasses{"cup", "bowl", "vase"};

ClassRegistry three_classes() {
  return ClassRegistry::from_names(kClasses).value();
}

DetectorRegistry two_of_skill() {
  DetectorRegistry registry;
  EXPECT_TRUE(registry.add({.name = "eager"}));
  EXPECT_TRUE(registry.add({.name = "careful"}));
  return registry;
}

std::vector<ClassEvidence> sure_of(std::uint32_t named, double p) {
  std::vector<ClassEvidence> out;
  for (std::uint32_t c = 0; c < 3; ++c) {
    out.push_back({ClassId{c}, Probability(c == named ? p : (1.0 - p) / 2.0)});
  }
  return out;
}

/// "eager" is always sure (0.9) and calls each bowl a cup; "careful" is right, with 0.5 to 0.6.
std::vector<CombinerExample> examples_of_two(std::uint64_t seed, std::size_t count) {
  std::vector<CombinerExample> examples;
  for (std::size_t i = 0; i < count; ++i) {
    const auto truth = static_cast<std::uint32_t>((i + seed) % 3);
    const double p = 0.5 + 0.1 * static_cast<double>((7 * i + seed) % 10) / 10.0;
    examples.push_back({.likelihoods = {sure_of(truth == 1 ? 0 : truth, 0.9), sure_of(truth, p)},
                        .detectors = {DetectorId{0}, DetectorId{1}},
                        .truth = ClassId{truth}});
  }
  return examples;
}

double share_right(const std::vector<CombinerExample>& examples,
                   const StackingOptions& options,
                   const StackingModel& model) {
  double right = 0.0;
  for (const CombinerExample& example : examples) {
    const auto combined =
        combine_class_scores(example.likelihoods, example.detectors, options, model);
    EXPECT_TRUE(combined);
    if (combined && best_class(*combined)->id == example.truth) right += 1.0;
  }
  return right / static_cast<double>(examples.size());
}

// [smap] 3.5.3: what the sum gets wrong, as the eager one shouts the other down, is learnt.
TEST(CombinerTraining, LearnsWhomToTrustInWhat) {
  const auto model = train_combiner(examples_of_two(0, 300), two_of_skill(), three_classes());
  ASSERT_TRUE(model) << to_string(model.error());
  EXPECT_EQ(model->classes.size(), 3U);
  ClassRegistry classes = three_classes();
  const auto combiner = TrainedCombiner::bind(*model, two_of_skill(), classes);
  ASSERT_TRUE(combiner) << to_string(combiner.error());
  const auto unseen = examples_of_two(5, 200);
  EXPECT_LT(share_right(unseen, {.rule = StackingRule::kSum}, {}), 0.7);
  EXPECT_GT(
      share_right(unseen, {.rule = StackingRule::kTrained}, {.weights = {}, .combiner = *combiner}),
      0.99);
}

/// 200 cups, of which every fifth is called a vase with 0.4 to 0.6, and 30 vases, which are called
/// so with 0.5 to 0.9.
std::vector<CombinerExample> cups_and_few_vases() {
  std::vector<CombinerExample> examples;
  const auto add = [&](std::uint32_t truth, std::uint32_t named, double p) {
    examples.push_back({.likelihoods = {sure_of(named, p)},
                        .detectors = {DetectorId{0}},
                        .truth = ClassId{truth}});
  };
  for (int i = 0; i < 160; ++i) add(0, 0, 0.5 + 0.4 * i / 160.0);
  for (int i = 0; i < 40; ++i) add(0, 2, 0.4 + 0.2 * i / 40.0);
  for (int i = 0; i < 30; ++i) add(2, 2, 0.5 + 0.4 * i / 30.0);
  return examples;
}

TEST(CombinerTraining, ManyExamplesOfAClassMakeNothingOfAnotherOne) {
  // With 0.5 to 0.6, 20 cups are called a vase and 7 vases: most are cups. But that is a tenth of
  // the cups and a quarter of the vases.
  const auto model = train_combiner(cups_and_few_vases(), two_of_skill(), three_classes());
  ASSERT_TRUE(model) << to_string(model.error());
  ASSERT_EQ(model->classes.size(), 2U);
  EXPECT_DOUBLE_EQ(model->classes[0].share, 200.0 / 230.0);
  EXPECT_DOUBLE_EQ(model->classes[1].share, 30.0 / 230.0);
  CombinerModel by_number = *model;
  for (OneAgainstAll& rule : by_number.classes) rule.share = 1.0;
  const auto vase_of = [](const CombinerModel& learnt) {
    ClassRegistry classes = three_classes();
    const auto combiner = TrainedCombiner::bind(learnt, two_of_skill(), classes).value();
    const std::vector<std::vector<ClassEvidence>> said{sure_of(2, 0.55)};
    const std::vector<DetectorId> eager{DetectorId{0}};
    const auto combined = combiner->combine(said, eager).value();
    return combined.at(2).probability.value() / combined.at(0).probability.value();
  };
  EXPECT_GT(vase_of(*model), 1.5);
  EXPECT_LT(vase_of(by_number), 1.0 / 1.5) << "how common cups are would decide";
}

TEST(CombinerTraining, GivesTheSameBytesEachTime) {
  const auto once = train_combiner(examples_of_two(1, 90), two_of_skill(), three_classes());
  const auto again = train_combiner(examples_of_two(1, 90), two_of_skill(), three_classes());
  ASSERT_TRUE(once && again);
  EXPECT_EQ(write_combiner(*once), write_combiner(*again));
}

TEST(CombinerTraining, AClassOfFewExamplesIsNotLearnt) {
  auto examples = examples_of_two(0, 30);
  std::erase_if(examples, [](const CombinerExample& one) { return one.truth == ClassId{2}; });
  auto vase = examples_of_two(2, 1);
  examples.push_back(vase.front());
  ASSERT_EQ(vase.front().truth, ClassId{2});
  const auto model = train_combiner(examples, two_of_skill(), three_classes());
  ASSERT_TRUE(model) << to_string(model.error());
  EXPECT_EQ(model->classes.size(), 2U);
  EXPECT_EQ(model->detectors[0].classes, kClasses);
}

TEST(CombinerTraining, RefusesWhatTeachesNothing) {
  const auto field = [](const std::vector<CombinerExample>& examples,
                        const CombinerTrainingOptions& options) {
    const auto model = train_combiner(examples, two_of_skill(), three_classes(), options);
    return model ? "was accepted" : to_string(model.error());
  };
  EXPECT_EQ(field({}, {}), "examples: must be of two or more classes, are of 0");
  auto one_class = examples_of_two(0, 30);
  std::erase_if(one_class, [](const CombinerExample& one) { return one.truth != ClassId{0}; });
  EXPECT_EQ(field(one_class, {}), "examples: must be of two or more classes, are of 1");
  EXPECT_EQ(field(examples_of_two(0, 9), {}), "examples: no class has 5 of them");
  EXPECT_EQ(field(examples_of_two(0, 90), {.penalty = 0.0}),
            "penalty: must be in 0.001 .. 1000, is 0");
}

}  // namespace
}  // namespace hypermap
