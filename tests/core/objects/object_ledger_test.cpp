// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_ledger.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hypermap {
namespace {

LedgerEntry seen(std::uint64_t frame, ClassId id = ClassId{1}, float bearing_rad = 0.1F) {
  return {.frame_index = frame,
          .stamp = Stamp{static_cast<std::int64_t>(frame)},
          .class_id = id,
          .score = 0.5F,
          .bearing_rad = bearing_rad,
          .distance_m = 2.0F,
          .effect = 1.0F};
}

TEST(ObjectLedger, TheFirstAndTheNewestStay) {
  ObjectLedger ledger;
  for (std::uint64_t frame = 0; frame < 100; ++frame) ledger.add(seen(frame));
  EXPECT_EQ(ledger.state().first->frame_index, 0U);
  EXPECT_EQ(ledger.state().newest.size(), 64U);
  EXPECT_EQ(ledger.state().newest.front().frame_index, 36U);
  EXPECT_EQ(ledger.state().newest.back().frame_index, 99U);
}

TEST(ObjectLedger, SumsAreKeptPerClassAndDirection) {
  ObjectLedger ledger;
  for (int i = 0; i < 3; ++i) ledger.add(seen(5));
  ledger.add(seen(6, ClassId{2}));
  ledger.add(seen(7, ClassId{1}, 3.0F));
  ASSERT_EQ(ledger.state().summaries.size(), 3U);
  EXPECT_EQ(ledger.state().summaries[0].count, 3U);
  EXPECT_FLOAT_EQ(ledger.state().summaries[0].score_sum, 1.5F);
  EXPECT_EQ(ledger.num_detections(), 5U);
  EXPECT_EQ(ledger.num_detections(ClassId{1}), 4U);
}

TEST(ObjectLedger, ItNeverTakesMoreThanSixteenKilobytes) {
  ObjectLedger ledger;
  for (std::uint32_t i = 0; i < 10'000; ++i) {
    ledger.add(seen(i, ClassId{i % 80}, 0.37F * static_cast<float>(i)));
  }
  const auto& state = ledger.state();
  const std::size_t bytes = sizeof(ObjectLedger) + state.newest.size() * sizeof(LedgerEntry) +
                            state.summaries.size() * sizeof(LedgerSummary);
  EXPECT_LE(bytes, 16U * 1024U);
  EXPECT_EQ(ledger.num_detections() + state.num_unsummarised, 10'000U);
}

TEST(ObjectLedger, MergingKeepsTheOrderOfFrames) {
  ObjectLedger a;
  ObjectLedger b;
  for (std::uint64_t frame = 1; frame < 80; frame += 2) a.add(seen(frame));
  for (std::uint64_t frame = 0; frame < 80; frame += 2) b.add(seen(frame));
  a.merge(b);
  EXPECT_EQ(a.state().first->frame_index, 0U);
  EXPECT_EQ(a.state().newest.front().frame_index, 16U);
  EXPECT_EQ(a.state().newest.back().frame_index, 79U);
  EXPECT_EQ(a.num_detections(), 80U);
}

TEST(ObjectLedger, BearingBinsAreTwentyDegrees) {
  EXPECT_EQ(ledger_bearing_bin(0.0), 0);
  EXPECT_EQ(ledger_bearing_bin(0.35), 1);
  EXPECT_EQ(ledger_bearing_bin(-0.01), 17);
  EXPECT_EQ(ledger_bearing_bin(-1e-18), 17);
}

TEST(ObjectLedger, WhatIsStoredComesBackAndNonsenseIsRefused) {
  ObjectLedger ledger;
  ledger.add(seen(1));
  ledger.add(seen(2, ClassId{9}));
  EXPECT_EQ(ObjectLedger::from_state(ledger.state()).value(), ledger);
  auto no_first = ledger.state();
  no_first.first.reset();
  EXPECT_FALSE(ObjectLedger::from_state(no_first).has_value());
  auto disordered = ledger.state();
  std::swap(disordered.summaries[0], disordered.summaries[1]);
  EXPECT_FALSE(ObjectLedger::from_state(disordered).has_value());
  auto nan = ledger.state();
  nan.newest[0].score = NAN;
  EXPECT_FALSE(ObjectLedger::from_state(nan).has_value());
}

}  // namespace
}  // namespace hypermap
