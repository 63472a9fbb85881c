// SPDX-License-Identifier: BSD-3-Clause
#include "match_consensus.hpp"

#include "made_rooms.hpp"

#include <gtest/gtest.h>

namespace hypermap::test {
namespace {

/// `num_right` matches of a placement, and as many wrong ones as asked for.
std::vector<FeatureMatch> matches_of(const Eigen::Matrix3d& placement,
                                     int num_right,
                                     int num_wrong) {
  CounterRng random(1, 1);
  std::vector<FeatureMatch> matches;
  for (int i = 0; i < num_right + num_wrong; ++i) {
    FeatureMatch match;
    match.feature = static_cast<std::size_t>(i);
    match.moving = {random.uniform(0.0, 100.0), random.uniform(0.0, 100.0)};
    match.fixed = i < num_right
                      ? moved(placement, match.moving)
                      : Eigen::Vector2d(random.uniform(0.0, 150.0), random.uniform(0.0, 150.0));
    matches.push_back(match);
  }
  return matches;
}

ConsensusOptions anywhere(bool has_scale = false) {
  return {.has_scale = has_scale, .is_allowed = [](const Eigen::Matrix3d&) { return true; }};
}

TEST(MatchConsensus, ThePlacementOfMostMatchesIsFoundAmongWrongOnes) {
  const Eigen::Matrix3d truth = plane_pose(12.0, 30.0, 0.4);
  const auto matches = matches_of(truth, 20, 60);
  const auto found = best_consensuses(matches, 70.0, anywhere());
  ASSERT_FALSE(found.empty());
  EXPECT_GE(found.front().num_inliers, 20U);
  EXPECT_LE(found.front().num_inliers, 22U);
  EXPECT_LT((found.front().fixed_from_moving - truth).cwiseAbs().maxCoeff(), 0.5);
  for (std::size_t i = 1; i < found.size(); ++i) {
    EXPECT_LE(found[i].num_inliers, found[i - 1].num_inliers);
  }
}

TEST(MatchConsensus, ScaleIsPartOfItOnRequest) {
  const Eigen::Matrix3d truth = plane_pose(5.0, 3.0, -0.7, 1.3);
  const auto matches = matches_of(truth, 30, 30);
  EXPECT_GE(best_consensuses(matches, 70.0, anywhere(true)).front().num_inliers, 30U);
  EXPECT_LT(best_consensuses(matches, 70.0, anywhere(false)).front().num_inliers, 15U);
}

TEST(MatchConsensus, WhatIsNotAllowedIsNotProposed) {
  const auto matches = matches_of(plane_pose(40.0, 0.0, 0.0), 30, 0);
  ConsensusOptions options = anywhere();
  options.is_allowed = [](const Eigen::Matrix3d& placement) { return placement(0, 2) < 20.0; };
  EXPECT_TRUE(best_consensuses(matches, 70.0, options).empty());
}

TEST(MatchConsensus, AFeatureCountsOnce) {
  std::vector<FeatureMatch> matches = matches_of(plane_pose(0.0, 0.0, 0.0), 4, 0);
  FeatureMatch near = matches.back();
  near.fixed.x() += 1.5;
  matches.push_back(near);
  const Consensus consensus = consensus_of(plane_pose(0.0, 0.0, 0.0), matches, 2.0);
  EXPECT_EQ(consensus.num_inliers, 4U);
  EXPECT_EQ(consensus.rms, 0.0);
}

TEST(MatchConsensus, OneMatchProposesNothing) {
  EXPECT_TRUE(best_consensuses(matches_of(plane_pose(0, 0, 0), 1, 0), 70.0, anywhere()).empty());
}

}  // namespace
}  // namespace hypermap::test
