// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/belief_changes.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using Entries = std::vector<BeliefChange>;

BeliefChange changed(std::uint32_t id, float log_odds) {
  return {.class_id = ClassId{id}, .log_odds = log_odds};
}

/// Beliefs in the classes 1, 2, ...
std::vector<ClassLogOdds> beliefs(const std::vector<double>& log_odds) {
  std::vector<ClassLogOdds> out;
  out.reserve(log_odds.size());
  for (const double l : log_odds)
    out.push_back({ClassId{static_cast<std::uint32_t>(out.size() + 1)}, LogOdds(l)});
  return out;
}

Entries entries_of(const BeliefChanges& changes) {
  return {changes.entries().begin(), changes.entries().end()};
}

Entries between(const std::vector<double>& before,
                const std::vector<double>& after,
                std::uint32_t named) {
  return entries_of(BeliefChanges::between(beliefs(before), beliefs(after), ClassId{named}));
}

BeliefChanges restored(const Entries& entries) {
  return BeliefChanges::from_entries(entries).value();
}

TEST(BeliefChanges, TheLargestStayInOrderWithoutTheNamedClass) {
  // Changes: 2, -0.4, 0.3, -0.6, 0.2, 0.5; class 1 is the named one, class 5 the fifth of the rest.
  EXPECT_EQ(between({1, 1, 1, 1, 1, 1}, {3, 0.6, 1.3, 0.4, 1.2, 1.5}, 1),
            (Entries{changed(4, -0.6F), changed(6, 0.5F), changed(2, -0.4F), changed(3, 0.3F)}));
}

TEST(BeliefChanges, AreInThousandthsAndLeftOutBelowATenth) {
  EXPECT_EQ(between({0, 0, 0}, {0.12345, 0.0994, -0.0996}, 9),
            (Entries{changed(1, 0.123F), changed(3, -0.1F)}));
  EXPECT_EQ(between({1, 2}, {1, 2}, 9), Entries{});
}

TEST(BeliefChanges, OfEqualOnesThoseStayThatWereBelievedMore) {
  // All six lose 1.6; 5 and 3 were believed most, 1 and 2 have the lowest ids of the rest.
  EXPECT_EQ(between({-2, -2, 1, -2, 4, -2}, {-3.6, -3.6, -0.6, -3.6, 2.4, -3.6}, 9),
            (Entries{changed(5, -1.6F), changed(3, -1.6F), changed(1, -1.6F), changed(2, -1.6F)}));
}

TEST(BeliefChanges, AClassThatIsNewWasBelievedByZero) {
  const std::vector<ClassLogOdds> before{{ClassId{2}, LogOdds(1.0)}};
  EXPECT_EQ(entries_of(BeliefChanges::between(before, beliefs({-0.5, 3.0, 0.7}), ClassId{2})),
            (Entries{changed(3, 0.7F), changed(1, -0.5F)}));
}

TEST(BeliefChanges, OfOneObservationAddUpByClass) {
  BeliefChanges changes =
      restored({changed(1, -1.0F), changed(2, 0.5F), changed(3, 0.3F), changed(4, 0.2F)});
  changes.add(restored({changed(2, -0.45F), changed(1, -0.4F), changed(7, 0.25F)}));
  // 2 keeps 0.05, which is too little; 7 comes before 4.
  EXPECT_EQ(entries_of(changes),
            (Entries{changed(1, -1.4F), changed(3, 0.3F), changed(7, 0.25F), changed(4, 0.2F)}));
  changes.add(restored({changed(9, 0.21F)}));
  EXPECT_EQ(changes.entries().back(), changed(9, 0.21F)) << "instead of 4, which is smaller";
  changes.add({});
  EXPECT_EQ(changes.entries().size(), BeliefChanges::kMaxClasses);
}

TEST(BeliefChanges, AreRestoredOrRefused) {
  const Entries four{changed(0, -0.6F), changed(6, 0.5F), changed(2, 0.5F), changed(3, 0.05F)};
  EXPECT_EQ(entries_of(restored(four)), four);
  EXPECT_EQ(restored({}), BeliefChanges{});
  EXPECT_TRUE(restored(four).contains(ClassId{0}));
  EXPECT_FALSE(BeliefChanges{}.contains(ClassId{0}));
  const auto refusal = [](const Entries& entries) {
    const auto result = BeliefChanges::from_entries(entries);
    return result ? std::string("none") : result.error().what;
  };
  const Entries five(5, changed(1, 1.0F));
  EXPECT_EQ(refusal(five), "must be of at most 4 classes, are of 5");
  EXPECT_EQ(refusal({changed(1, 1.0F), changed(1, 0.5F)}), "must have a class once, have 1 twice");
  EXPECT_EQ(refusal({changed(1, 0.0F)}), "must be finite and not 0, that of class 1 is not");
  EXPECT_EQ(refusal({changed(1, std::numeric_limits<float>::infinity())}),
            "must be finite and not 0, that of class 1 is not");
  EXPECT_EQ(refusal({changed(1, 0.5F), changed(2, -0.6F)}),
            "must have the larger first, that of class 2 is larger than the one before");
}

}  // namespace
}  // namespace hypermap
