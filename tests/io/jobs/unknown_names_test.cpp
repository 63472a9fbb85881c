// SPDX-License-Identifier: BSD-3-Clause
#include "unknown_names.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hypermap {
namespace {

TEST(UnknownNames, SpellingsAreKnownAndOthersToldWithTheNearest) {
  const std::vector<std::string> known{"dining table", "tvmonitor", "chair"};
  const ClassRegistry classes = ClassRegistry::from_names(known).value();
  const std::vector<std::string> names{"DiningTable", "tv", "chiar", "unicorn"};
  const auto findings = unknown_names(names, "transient_classes", classes);
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(
      to_string(findings[0].error),
      "transient_classes: no class of the input is called \"chiar\", did you mean \"chair\"?");
  EXPECT_EQ(to_string(findings[1].error),
            "transient_classes: no class of the input is called \"unicorn\"");
  EXPECT_TRUE(unknown_names({}, "transient_classes", classes).empty());
}

}  // namespace
}  // namespace hypermap
