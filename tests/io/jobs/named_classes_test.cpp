// SPDX-License-Identifier: BSD-3-Clause
#include "named_classes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

ClassRegistry classes_of_input() {
  const std::vector<std::string> known{"dining table", "tvmonitor", "chair", "sofa"};
  return ClassRegistry::from_names(known).value();
}

TEST(NamedClasses, SpellingsAreKnownAndOthersToldWithTheNearest) {
  const std::vector<std::string> texts{"DiningTable", "tv", "chiar", "unicorn"};
  const auto named = named_classes(texts, "transient_classes", classes_of_input(), {});
  ASSERT_TRUE(named) << to_string(named.error());
  EXPECT_THAT(named->names, ElementsAre("dining table", "tvmonitor", "chiar", "unicorn"));
  ASSERT_EQ(named->findings.size(), 2U);
  EXPECT_EQ(
      to_string(named->findings[0].error),
      "transient_classes: no class of the input is called \"chiar\", did you mean \"chair\"?");
  EXPECT_EQ(to_string(named->findings[1].error),
            "transient_classes: no class of the input is called \"unicorn\"");
  EXPECT_THAT(named_classes({}, "transient_classes", classes_of_input(), {})->names, IsEmpty());
}

TEST(NamedClasses, AliasesSuperClassesAndPrefixesStandForTheClassesThatAreThere) {
  const auto vocabulary = ClassVocabulary::create(
      {.aliases = {{{"sofa"}, {{"settee"}}}},
       .super_classes = {{{"seat"}, {{"chair"}, {"sofa"}, {"bench"}}}, {{"tool"}, {{"saw"}}}}});
  ASSERT_TRUE(vocabulary) << to_string(vocabulary.error());
  const std::vector<std::string> texts{"seat", "settee", "d*", "tool"};
  const auto named = named_classes(texts, "--keep-classes", classes_of_input(), *vocabulary);
  ASSERT_TRUE(named) << to_string(named.error());
  EXPECT_THAT(named->names, ElementsAre("chair", "sofa", "dining table", "tool"));
  ASSERT_EQ(named->findings.size(), 1U);
  EXPECT_EQ(to_string(named->findings[0].error),
            "--keep-classes: no class of the input is of \"tool\" (saw, tool)");
}

TEST(NamedClasses, APatternThatNoClassFitsAndABadOneAreRefused) {
  const std::vector<std::string> nothing{"x*"};
  const auto unmatched = named_classes(nothing, "wanted_classes", classes_of_input(), {});
  ASSERT_FALSE(unmatched);
  EXPECT_EQ(to_string(unmatched.error()),
            "wanted_classes: no class of the input begins with \"x\"");
  const std::vector<std::string> bad{"/(/"};
  EXPECT_EQ(named_classes(bad, "wanted_classes", classes_of_input(), {}).error().code,
            ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace hypermap
