// SPDX-License-Identifier: BSD-3-Clause
// Maps that are gone on from without what the run before knew.
#include "appended_input.hpp"
#include "hypermap/core/base/value_tree.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <span>
#include <vector>

namespace hypermap {
namespace {

TEST(DroppedPrior, WhatBelongsWhereIsMissedWhenTheRunBeforeKnewIt) {
  std::vector<Provenance> runs(2);
  runs[1].input = "monday";
  runs[1].options = make_map({{"prior.source", make_text("places")}});
  const auto found = find_dropped_prior({.source = ClassPriorKind::kNone}, runs);
  ASSERT_TRUE(found);
  EXPECT_THAT(to_string(found->error),
              testing::HasSubstr("prior.source: is none, was places in the run of monday"));
  EXPECT_FALSE(find_dropped_prior({.source = ClassPriorKind::kPlaces}, runs));
  EXPECT_FALSE(find_dropped_prior({.source = ClassPriorKind::kNone}, std::span(runs).first(1)));
  EXPECT_FALSE(find_dropped_prior({}, {}));
}

}  // namespace
}  // namespace hypermap
