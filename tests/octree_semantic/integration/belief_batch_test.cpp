// SPDX-License-Identifier: BSD-3-Clause
#include "integration/labels/belief_batch.hpp"

#include "integration/labels/label_evidence.hpp"
#include "octree_semantic/support/every_kernel_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

namespace hypermap {
namespace {

constexpr MilliLogOdds kLimit = 10'000;

/// A belief of up to three classes, often with equal log-odds and at the limits.
VoxelLabel random_label(std::mt19937& random, std::uint32_t num_classes) {
  std::vector<ClassWeight> kept;
  const std::size_t num_kept = std::min<std::size_t>(random() % 4, num_classes);
  while (kept.size() < num_kept) {
    const auto id = static_cast<std::uint16_t>(random() % num_classes);
    const auto has_id = [id](const ClassWeight& other) { return other.class_id == id; };
    if (std::any_of(kept.begin(), kept.end(), has_id)) continue;
    const std::array choices{
        0, int{kLimit}, -int{kLimit}, static_cast<int>(random() % 8000) - 4000};
    kept.push_back({id, static_cast<MilliLogOdds>(choices[random() % 4])});
  }
  std::stable_sort(kept.begin(), kept.end(), [](const ClassWeight& a, const ClassWeight& b) {
    return a.log_odds > b.log_odds || (a.log_odds == b.log_odds && a.class_id < b.class_id);
  });
  VoxelLabel label;
  for (std::size_t i = 0; i < std::min(kept.size(), label.classes.size()); ++i) {
    label.classes[i] = kept[i];
  }
  if (kept.size() == 3) {
    label.rest = static_cast<MilliLogOdds>(std::max(kept[2].log_odds - 5, -int{kLimit}));
  }
  return label;
}

/// Scores of some of the classes; now and then certain ones, and equal ones.
std::vector<ClassEvidence> random_scores(std::mt19937& random, std::uint32_t num_classes) {
  std::vector<ClassEvidence> scores;
  for (std::uint32_t id = 0; id < num_classes; ++id) {
    if (random() % 5 == 0) continue;
    const std::array<double, 4> choices{0.0, 1.0, 0.05, static_cast<double>(random() % 1000) / 1e3};
    scores.push_back({ClassId{id}, Probability(choices[random() % 9 < 8 ? 3 : random() % 3])});
  }
  return scores;
}

TEST(BeliefBatch, DoesToManyVoxelsWhatObserveDoesToOne) {
  std::mt19937 random(71);
  for (int round = 0; round < 200; ++round) {
    const std::uint32_t num_classes = 1 + static_cast<std::uint32_t>(random() % 90);
    const std::vector<PixelLabels> frame{{ObjectId{4}, random_scores(random, num_classes), {0}}};
    LabelEvidence evidence;
    evidence.start(frame);
    const auto scores = evidence.scores_of(0, kLimit);
    ASSERT_EQ(scores.has_value(), !frame[0].class_scores.empty());
    if (!scores) continue;
    std::vector<VoxelLabel> labels(1 + random() % 512);
    for (VoxelLabel& label : labels) label = random_label(random, num_classes);
    std::vector<VoxelLabel> expected = labels;
    BeliefBatch batch;
    for (VoxelLabel& label : labels) {
      label.vote(evidence.object_of(0));
      batch.add(label);
    }
    batch.merge(*scores);
    EXPECT_TRUE(batch.empty());
    for (VoxelLabel& label : expected) {
      const std::array<LabelVote, 1> votes{{{.label = 0, .count = 1}}};
      observe(label, evidence.of(votes, label), kLimit);
    }
    ASSERT_EQ(labels, expected) << round;
  }
}

TEST(BeliefBatch, AVoxelByHand) {
  // Two classes kept, 3: 500 and 7: -200, the rest at 0. The frame says 3: -100, 5: 600, 9: 600 and
  // 1: -50: kept are 5 and 9 at 600 (the lower id first) and 3 at 400; the rest is bounded by -50.
  const std::array<std::int32_t, 10> by_class{kernels::kNotNamed,
                                              -50,
                                              kernels::kNotNamed,
                                              -100,
                                              kernels::kNotNamed,
                                              600,
                                              kernels::kNotNamed,
                                              kernels::kNotNamed,
                                              kernels::kNotNamed,
                                              600};
  const std::array<std::int32_t, 4> best_ids{5, 9, 1, 3};
  const std::array<std::int32_t, 4> best{600, 600, -50, -100};
  VoxelLabel label;
  label.classes[0] = {3, 500};
  label.classes[1] = {7, -200};
  BeliefBatch batch;
  batch.add(label);
  batch.merge({by_class.data(), 10, best_ids.data(), best.data(), 4, kLimit});
  EXPECT_EQ(label.classes[0], (ClassWeight{5, 600}));
  EXPECT_EQ(label.classes[1], (ClassWeight{9, 600}));
  EXPECT_EQ(label.classes[2], (ClassWeight{3, 400}));
  EXPECT_EQ(label.rest, -50);
}

TEST(LabelEvidence, ClassesWithLargeIdsHaveNoTable) {
  const std::vector<PixelLabels> frame{{kNoObject, {{ClassId{4095}, Probability(0.7)}}, {0}},
                                       {kNoObject, {{ClassId{4096}, Probability(0.7)}}, {1}},
                                       {kNoObject, {}, {2}}};
  LabelEvidence evidence;
  evidence.start(frame);
  EXPECT_TRUE(evidence.scores_of(0, kLimit));
  EXPECT_FALSE(evidence.scores_of(1, kLimit));
  EXPECT_FALSE(evidence.scores_of(2, kLimit));
}

}  // namespace
}  // namespace hypermap

namespace hypermap::kernels {
namespace {

class LabelKernel : public EverySet {};
INSTANTIATE_TEST_SUITE_P(OfThisProcessor,
                         LabelKernel,
                         ::testing::ValuesIn(all_sets()),
                         [](const auto& set_info) { return std::string(set_info.param.name); });

TEST_P(LabelKernel, GivesTheBitsOfTheScalarCode) {
  for (int round = 0; round < 100; ++round) {
    std::vector<std::int32_t> by_class(1 + random_() % 100);
    for (std::int32_t& evidence : by_class) {
      evidence =
          random_() % 4 == 0 ? kNotNamed : static_cast<std::int32_t>(random_() % 9000) - 4500;
    }
    std::vector<std::int32_t> ids(random_() % 8);
    std::vector<std::int32_t> best(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) {
      ids[i] = static_cast<std::int32_t>(random_() % by_class.size());
      best[i] = 5000 - 700 * static_cast<std::int32_t>(i);
    }
    BeliefLanes ours;
    for (std::size_t i = 0; i < 512; ++i) {
      for (auto& classes : ours.classes) {
        const auto log_odds = static_cast<std::int32_t>(random_() % 6000) - 3000;
        const auto id = static_cast<std::int32_t>(random_() % 120);
        classes[i] = random_() % 3 == 0 ? kNoClass : log_odds * 65536 + 65535 - id;
      }
      ours.rest[i] = static_cast<std::int32_t>(random_() % 6000) - 3000;
    }
    BeliefLanes theirs = ours;
    const std::size_t size = 1 + random_() % 512;
    const LabelScores scores{by_class.data(),
                             static_cast<std::int32_t>(by_class.size()),
                             ids.data(),
                             best.data(),
                             ids.size(),
                             3500};
    set().merge_labels(scores, size, ours);
    scalar_.merge_labels(scores, size, theirs);
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(ours.classes[k][i], theirs.classes[k][i]) << i;
      ASSERT_EQ(ours.rest[i], theirs.rest[i]) << i;
    }
  }
}

}  // namespace
}  // namespace hypermap::kernels
