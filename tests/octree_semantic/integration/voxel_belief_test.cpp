// SPDX-License-Identifier: BSD-3-Clause
// How labelled measurements become the class and the object of a voxel.
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"
#include "octree_semantic/support/labelled_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace hypermap::test {
namespace {

const Eigen::Vector3d kSensor(0.05, 0.05, 0.05);
const Eigen::Vector3f kPoint(1.05F, 0.05F, 0.05F);
const IntegrationOptions kOptions{.mode = IntegrationMode::kDiscretize};

SemanticOctree tree_without_voxels() {
  return SemanticOctree::create({.resolution_m = 0.1}).value();
}

/// Integrates as many measurements of one voxel as the labels name.
void observe(SemanticOctree& tree, const std::vector<PixelLabels>& labels) {
  std::size_t num_points = 1;
  for (const PixelLabels& label : labels) {
    for (const std::uint32_t index : label.pixel_indices) {
      num_points = std::max<std::size_t>(num_points, index + 1);
    }
  }
  const std::vector<Eigen::Vector3f> points(num_points, kPoint);
  ASSERT_TRUE(FrameIntegrator().integrate_cloud(tree, {kSensor}, points, labels, kOptions));
}

VoxelLabel label_of(const SemanticOctree& tree) {
  const auto leaf = tree.stored_at(*tree.grid().key(PointInMap{kPoint.cast<double>()}));
  return leaf && leaf->label ? *leaf->label : VoxelLabel{};
}

double logit(double p) {
  return std::log(p / (1.0 - p));
}

/// The full vector that the cut to three classes stands for.
class FullBelief {
 public:
  void observe(const std::vector<ClassEvidence>& scores) {
    const double prior = logit(1.0 / static_cast<double>(scores.size()));
    for (const ClassEvidence& score : scores) {
      const double evidence = logit(score.probability.value()) - prior;
      log_odds_[score.id.value] += std::clamp(evidence, -10.0, 10.0);
    }
    const double best = *std::max_element(log_odds_.begin(), log_odds_.end());
    const double excess = std::max(best - 10.0, 0.0);
    for (double& l : log_odds_) l = std::max(l - excess, -10.0);
  }
  [[nodiscard]] double at(std::size_t id) const { return log_odds_[id]; }

 private:
  std::array<double, 20> log_odds_{};
};

/// A detector that confuses: mostly the truth, else another class, with noise everywhere.
std::vector<ClassEvidence> confused_vector(std::uint32_t truth, std::mt19937& random) {
  const auto uniform = [&random] { return static_cast<double>(random()) / 4294967296.0; };
  const auto said = uniform() < 0.7 ? truth : static_cast<std::uint32_t>(random() % 20);
  std::vector<double> weights(20);
  double sum = 0.0;
  for (std::uint32_t i = 0; i < 20; ++i) {
    weights[i] = uniform() + (i == said ? 8.0 : 0.01);
    sum += weights[i];
  }
  std::vector<ClassEvidence> scores;
  for (std::uint32_t i = 0; i < 20; ++i) {
    scores.push_back({ClassId{i}, Probability(weights[i] / sum)});
  }
  return scores;
}

TEST(VoxelBelief, OneFrameAddsTheLogitOverThatOfTheUniformVector) {
  // [smap] Eq. (3.18): logit(0.7) - logit(1/4) = 0.8473 + 1.0986 = 1.9459;
  // logit(0.1) - logit(1/4) = -2.1972 + 1.0986 = -1.0986.
  SemanticOctree tree = tree_without_voxels();
  observe(tree, {{ObjectId{3}, class_vector(ClassId{2}, 0.7, 4), {0}}});
  const VoxelLabel label = label_of(tree);
  EXPECT_EQ(label.classes[0], (ClassWeight{2, 1946}));
  EXPECT_EQ(label.classes[1], (ClassWeight{0, -1099}));
  EXPECT_EQ(label.classes[2], (ClassWeight{1, -1099}));
  EXPECT_EQ(label.rest, -1099);
  EXPECT_EQ(label.object, ObjectId{3});
  EXPECT_EQ(tree.at(PointInMap{kPoint.cast<double>()})->best_class, ClassId{2});
}

TEST(VoxelBelief, ManyMeasurementsOfOneFrameAreOneObservation) {
  SemanticOctree one = tree_without_voxels();
  SemanticOctree many = tree_without_voxels();
  observe(one, {{ObjectId{3}, class_vector(ClassId{2}, 0.7, 4), {0}}});
  observe(many, {{ObjectId{3}, class_vector(ClassId{2}, 0.7, 4), {0, 1, 2, 3, 4, 5, 6}}});
  EXPECT_EQ(one, many);
}

TEST(VoxelBelief, LabelsOfOneFrameAreAveragedByTheirMeasurements) {
  // Three measurements say (0.8, 0.2), one says (0.4, 0.6): mean (0.7, 0.3), N = 2:
  // logit(0.7) - logit(0.5) = 0.847.
  SemanticOctree tree = tree_without_voxels();
  observe(tree,
          {{ObjectId{3}, class_vector(ClassId{0}, 0.8, 2), {0, 1, 2}},
           {ObjectId{4}, class_vector(ClassId{0}, 0.4, 2), {3}}});
  const VoxelLabel label = label_of(tree);
  EXPECT_EQ(label.classes[0], (ClassWeight{0, 847}));
  EXPECT_EQ(label.classes[1], (ClassWeight{1, -847}));
  EXPECT_EQ(label.object, ObjectId{3}) << "of most measurements";
}

TEST(VoxelBelief, WhereLabelsMeetTheClassesAlreadyKeptAreObservedToo) {
  // Class 17 is kept from the first frame and is among the weakest of the next ones, which two
  // detections share.
  std::mt19937 random(31);
  SemanticOctree tree = tree_without_voxels();
  const std::vector<ClassEvidence> first = class_vector(ClassId{17}, 0.9, 20);
  observe(tree, {{kNoObject, first, {0}}});
  FullBelief full;
  full.observe(first);
  for (int frame = 0; frame < 4; ++frame) {
    const auto a = confused_vector(3, random);
    const auto b = confused_vector(5, random);
    observe(tree, {{kNoObject, a, {0, 1, 2}}, {kNoObject, b, {3}}});
    std::vector<ClassEvidence> mean;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double p = 0.75 * a[i].probability.value() + 0.25 * b[i].probability.value();
      mean.push_back({a[i].id, Probability(p)});
    }
    full.observe(mean);
    const VoxelLabel label = label_of(tree);
    for (const ClassWeight& kept : label.classes) {
      if (kept.class_id != 17) continue;
      EXPECT_NEAR(0.001 * kept.log_odds, full.at(17), 0.001 * (frame + 2)) << frame;
    }
    EXPECT_LE(full.at(17), 0.001 * std::max(label.classes[0].log_odds, label.rest) + 0.01);
    if (frame == 0) {
      EXPECT_TRUE(std::any_of(label.classes.begin(), label.classes.end(), [](const ClassWeight& w) {
        return w.class_id == 17;
      })) << "one frame does not drive it out";
    }
  }
}

TEST(VoxelBelief, ThreeThingsMayMeetInAVoxel) {
  SemanticOctree tree = tree_without_voxels();
  observe(tree,
          {{ObjectId{9}, class_vector(ClassId{0}, 0.9, 3), {0, 1}},
           {ObjectId{5}, class_vector(ClassId{1}, 0.9, 3), {2}},
           {ObjectId{7}, class_vector(ClassId{2}, 0.9, 3), {3, 4}},
           {ObjectId{5}, {}, {5}}});
  // Objects 5, 7 and 9 have two measurements each: the lowest id of equals.
  EXPECT_EQ(label_of(tree).object, ObjectId{5});
  // Class 0: (2 * 0.9 + 3 * 0.05) / 5 = 0.39; logit(0.39) + ln 2 = -0.4473 + 0.6931 = 0.246.
  EXPECT_EQ(label_of(tree).classes[0], (ClassWeight{0, 246}));
  EXPECT_EQ(label_of(tree).classes[1], (ClassWeight{2, 246}));
}

TEST(VoxelBelief, ALabelWithoutAnObjectOrWithoutScoresSaysOnlyTheOther) {
  SemanticOctree tree = tree_without_voxels();
  observe(tree, {{kNoObject, class_vector(ClassId{1}, 0.9, 3), {0}}});
  EXPECT_EQ(label_of(tree).object, kNoObject);
  EXPECT_EQ(label_of(tree).best_class(), ClassId{1});
  observe(tree, {{ObjectId{8}, {}, {0}}});
  EXPECT_EQ(label_of(tree).object, ObjectId{8});
  EXPECT_EQ(label_of(tree).best_class(), ClassId{1});
}

TEST(VoxelBelief, CertaintyIsClampedAndCanBeOverturned) {
  SemanticOctree tree = tree_without_voxels();
  const std::vector<ClassEvidence> sure{{ClassId{0}, Probability(1.0)},
                                        {ClassId{1}, Probability(0.0)}};
  for (int i = 0; i < 5; ++i) observe(tree, {{kNoObject, sure, {0}}});
  EXPECT_EQ(label_of(tree).classes[0], (ClassWeight{0, 10000}));
  EXPECT_EQ(label_of(tree).classes[1], (ClassWeight{1, -10000}));
  int num_frames = 0;
  while (label_of(tree).best_class() != ClassId{1} && num_frames < 100) {
    observe(tree, {{kNoObject, class_vector(ClassId{1}, 0.9, 2), {0}}});
    ++num_frames;
  }
  EXPECT_EQ(num_frames, 5);  // 10 / logit(0.9) = 10 / 2.197 = 4.55
}

TEST(VoxelBelief, SimilarClassesKeepTheirDifferenceAtTheBound) {
  // logit(0.5) + ln 9 = 2.197 and logit(0.4) + ln 9 = 1.792: clamped one by one, both would be at
  // 10 after six frames and the lower id first. The difference grows by 0.405 a frame.
  std::vector<ClassEvidence> scores;
  for (std::uint32_t id = 0; id < 10; ++id) {
    scores.push_back({ClassId{id}, Probability(id == 7 ? 0.5 : id == 2 ? 0.4 : 0.0125)});
  }
  SemanticOctree tree = tree_without_voxels();
  for (int frame = 0; frame < 20; ++frame) observe(tree, {{kNoObject, scores, {0}}});
  const VoxelLabel label = label_of(tree);
  EXPECT_EQ(label.best_class(), ClassId{7});
  EXPECT_EQ(label.classes[0], (ClassWeight{7, 10'000}));
  EXPECT_EQ(label.classes[1].class_id, 2);
  EXPECT_NEAR(label.classes[1].log_odds, 10'000 - 20 * 405.5, 20);
  EXPECT_EQ(label.rest, -10'000);
}

TEST(VoxelBelief, ASingleKnownClassIsEvidenceAgainstAPriorOfOneHalf) {
  // [smap] Eq. (3.19): the prior 0.5 of a yes-or-no question: logit(0.8) = 1.386.
  SemanticOctree tree = tree_without_voxels();
  observe(tree, {{kNoObject, {{ClassId{7}, Probability(0.8)}}, {0}}});
  EXPECT_EQ(label_of(tree).classes[0], (ClassWeight{7, 1386}));
}

TEST(VoxelBelief, TheCutToThreeClassesOverratesByNoMoreThanTheRestSays) {
  std::mt19937 random(31);
  constexpr double kRounding = 0.001;  // per frame
  int num_same_best = 0;
  int num_compared = 0;
  constexpr int kNumVoxels = 60;
  for (int voxel = 0; voxel < kNumVoxels; ++voxel) {
    SemanticOctree tree = tree_without_voxels();
    FullBelief full;
    bool was_at_bound = false;
    const auto truth = static_cast<std::uint32_t>(random() % 20);
    for (int frame = 1; frame <= 25; ++frame) {
      const auto scores = confused_vector(truth, random);
      observe(tree, {{kNoObject, scores, {0}}});
      full.observe(scores);
      const VoxelLabel label = label_of(tree);
      // From there on all are lowered by what the best is overrated, too.
      was_at_bound = was_at_bound || label.classes[0].log_odds == 10'000;
      if (was_at_bound) continue;
      ++num_compared;
      for (std::uint16_t id = 0; id < 20; ++id) {
        const auto kept = std::find_if(label.classes.begin(),
                                       label.classes.end(),
                                       [id](const ClassWeight& w) { return w.class_id == id; });
        const double bound = 0.001 * (kept != label.classes.end() ? kept->log_odds : label.rest);
        ASSERT_LE(full.at(id), bound + kRounding * frame) << "never underrated";
      }
    }
    std::uint32_t best = 0;
    for (std::uint32_t id = 1; id < 20; ++id) {
      if (full.at(id) > full.at(best)) best = id;
    }
    num_same_best += label_of(tree).best_class() == ClassId{best} ? 1 : 0;
  }
  EXPECT_GE(num_same_best, kNumVoxels - 1);
  EXPECT_GT(num_compared, 5 * kNumVoxels);
}

TEST(VoxelBelief, WithThreeClassesNothingIsCut) {
  std::mt19937 random(37);
  SemanticOctree tree = tree_without_voxels();
  std::array<double, 3> full{};
  for (int frame = 0; frame < 40; ++frame) {
    const double p = 0.2 + 0.6 * static_cast<double>(random()) / 4294967296.0;
    const std::vector<ClassEvidence> scores = class_vector(ClassId{1}, p, 3);
    observe(tree, {{kNoObject, scores, {0}}});
    for (std::size_t id = 0; id < 3; ++id) {
      full[id] += logit(scores[id].probability.value()) - logit(1.0 / 3.0);
    }
    const double excess = std::max(*std::max_element(full.begin(), full.end()) - 10.0, 0.0);
    for (double& l : full) l = std::max(l - excess, -10.0);
    for (const ClassWeight& weight : label_of(tree).classes) {
      EXPECT_NEAR(0.001 * weight.log_odds, full[weight.class_id], 0.0005 * (frame + 1));
    }
  }
}

TEST(VoxelBelief, AVoxelForgetsItsLabelWhenItIsFreeBeyondDoubt) {
  SemanticOctree tree = tree_without_voxels();
  observe(tree, {{ObjectId{3}, class_vector(ClassId{2}, 0.7, 4), {0}}});
  const std::vector<Eigen::Vector3f> behind{{2.05F, 0.05F, 0.05F}};
  FrameIntegrator integrator;
  // 0.847 - 7 x 0.405 = -1.988; the eighth miss reaches the clamp at -2.
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(label_of(tree).object, ObjectId{3}) << i;
    ASSERT_TRUE(integrator.integrate_cloud(tree, {kSensor}, behind, {}, kOptions));
  }
  EXPECT_EQ(label_of(tree), VoxelLabel{});
}

TEST(VoxelBelief, LabelledMeasurementsThatEndNowhereAreLeftOut) {
  SemanticOctree tree = tree_without_voxels();
  const std::vector<Eigen::Vector3f> points{
      kPoint, {9.0F, 0.0F, 0.0F}, {std::nanf(""), 0.0F, 0.0F}};
  const std::vector<PixelLabels> labels{{ObjectId{1}, class_vector(ClassId{0}, 0.9, 3), {0, 1, 2}}};
  const auto report =
      FrameIntegrator().integrate_cloud(tree, {kSensor}, points, labels, kOptions).value();
  EXPECT_EQ(report.num_labelled_hits, 1U);
  EXPECT_EQ(report.num_labelled_voxels, 1U);
  EXPECT_EQ(report.num_beyond_range, 1U);
  EXPECT_EQ(report.num_not_finite, 1U);
}

}  // namespace
}  // namespace hypermap::test
