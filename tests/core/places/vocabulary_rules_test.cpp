// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/vocabulary_rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>

namespace hypermap {
namespace {

using testing::ElementsAre;

ClassVocabulary kitchen_words() {
  return ClassVocabulary::create(
             {.aliases = {{{"cup"}, {{"mug"}}}, {{"sofa"}, {{"settee"}}}},
              .super_classes = {{{"goods"}, {{"tableware"}}},
                                {{"tableware"}, {{"cup"}, {"bowl"}, {"plate"}}}}})
      .value();
}

TEST(VocabularyRules, PlacesHaveTheNearestRule) {
  const std::map<std::string, double> of_goods{{"cellar", 2.0}};
  const std::map<std::string, double> of_tableware{{"kitchen", 4.0}};
  const std::map<std::string, double> of_plate{{"kitchen", 8.0}};
  PlaceRules rules{.belongings = {{"goods", of_goods},
                                  {"tableware", of_tableware},
                                  {"plate", of_plate},
                                  {"settee", {{"living room", 20.0}}}},
                   .places = {"cellar", "kitchen", "living room"},
                   .metre_costs = {}};
  const auto belongings = with_vocabulary(rules, kitchen_words()).belongings;
  EXPECT_EQ(belongings.at("plate"), of_plate);    // its own
  EXPECT_EQ(belongings.at("mug"), of_tableware);  // its class' nearest super-class
  EXPECT_EQ(belongings.at("cup"), of_tableware);
  EXPECT_EQ(belongings.at("bowl"), of_tableware);
  EXPECT_EQ(belongings.at("goods"), of_goods);
  EXPECT_EQ(belongings.at("sofa").at("living room"), 20.0);  // said of its alias
  EXPECT_FALSE(belongings.contains("chair"));
  EXPECT_EQ(belongings.size(), 8U);  // goods, tableware, cup, mug, bowl, plate, sofa, settee
  EXPECT_TRUE(validate(with_vocabulary(rules, kitchen_words())));
  EXPECT_EQ(with_vocabulary(rules, {}), rules);
}

TEST(VocabularyRules, SizesAreOfAllNamesOfAClass) {
  const ClassSize of_tableware{.height = LengthRange{0.01, 0.3}};
  const ClassSize of_plate{.height = LengthRange{0.01, 0.05}};
  PlaceRules rules;
  rules.places = {"kitchen"};
  rules.sizes = {{"plate", of_plate}, {"tableware", of_tableware}};
  const ClassSizes sizes = with_vocabulary(rules, kitchen_words()).sizes;
  EXPECT_EQ(sizes.at("plate"), of_plate);
  EXPECT_EQ(sizes.at("mug"), of_tableware);
  EXPECT_EQ(sizes.at("cup"), of_tableware);
  EXPECT_FALSE(sizes.contains("sofa"));
}

TEST(VocabularyRules, RelationsKnowWhatIsOfTheirClasses) {
  RelationOptions options;
  options.holders = {"tableware", "box"};
  options.parts = {"handle of cup"};
  const RelationOptions understood = with_vocabulary(options, kitchen_words());
  EXPECT_THAT(understood.holders, ElementsAre("bowl", "box", "cup", "mug", "plate", "tableware"));
  EXPECT_THAT(understood.parts, ElementsAre("handle of cup", "handle of mug"));
  EXPECT_TRUE(validate(understood));
  EXPECT_EQ(with_vocabulary(options, {}), options);
}

}  // namespace
}  // namespace hypermap
