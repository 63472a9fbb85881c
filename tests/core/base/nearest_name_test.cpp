// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/nearest_name.hpp"

#include <gtest/gtest.h>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 4> kKnown{"chair", "table", "stable", "Dining Table"};

TEST(NearestName, IsTheOneOfTheFewestEdits) {
  EXPECT_EQ(nearest_name("chiar", kKnown), "chair") << "an exchange is one edit";
  EXPECT_EQ(nearest_name("cihar", kKnown), std::nullopt) << "two edits of five letters";
  EXPECT_EQ(nearest_name("chaire", kKnown), "chair");
  EXPECT_EQ(nearest_name("sable", kKnown), "table") << "as near as stable, which comes later";
  EXPECT_EQ(nearest_name("CHAIR", kKnown), "chair") << "case does not count";
  EXPECT_EQ(nearest_name("dinning table", kKnown), "Dining Table");
}

TEST(NearestName, NothingIsNearToWhatIsFarOrVeryLong) {
  EXPECT_EQ(nearest_name("unicorn", kKnown), std::nullopt);
  EXPECT_EQ(nearest_name(std::string(65, 'c'), kKnown), std::nullopt);
  EXPECT_EQ(nearest_name("chair", std::span<const std::string_view>()), std::nullopt);
}

TEST(NearestName, WhatIsFarMayBePartOfAName) {
  constexpr std::array<std::string_view, 3> kLonger{"kitchen table", "diningtable", "at"};
  EXPECT_EQ(nearest_name("Table", kLonger), "diningtable") << "the shorter one";
  EXPECT_EQ(nearest_name("din", kLonger), "diningtable");
  EXPECT_EQ(nearest_name("di", kLonger), std::nullopt) << "two letters are in many names";
  EXPECT_EQ(nearest_name("tabl", kKnown), "table") << "edits come first";
}

TEST(NearestName, AHintIsPutAfterWhatIsSaid) {
  const std::vector<std::string> known{"chair", "ta\nble"};
  EXPECT_EQ(did_you_mean("chairs", known), ", did you mean \"chair\"?");
  EXPECT_EQ(did_you_mean("ta\nbles", known), ", did you mean \"ta\\x0able\"?");
  EXPECT_EQ(did_you_mean("unicorn", known), "");
}

TEST(NotOneOf, NamesAllChoicesWhatWasSaidAndTheNearest) {
  EXPECT_EQ(
      not_one_of("tabel", kKnown),
      "must be one of chair, table, stable, Dining Table, is \"tabel\", did you mean \"table\"?");
  const std::vector<std::string> known{"a\tb"};
  EXPECT_EQ(not_one_of("c\nd", known), "must be one of a\\x09b, is \"c\\x0ad\"");
}

TEST(NothingNamed, TellsTheNearestAndWhatThereIs) {
  const std::vector<std::string> known{"occupancy", "semantic"};
  EXPECT_EQ(nothing_named("layer", "ocupancy", known),
            "no layer is named \"ocupancy\", did you mean \"occupancy\"? (there are: occupancy, "
            "semantic)");
  EXPECT_EQ(nothing_named("frame", "lab", {}), "no frame is named \"lab\" (there are: none)");
}

}  // namespace
}  // namespace hypermap
