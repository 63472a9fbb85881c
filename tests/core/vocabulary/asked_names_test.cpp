// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/vocabulary/asked_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// What some map has.
const std::vector<std::string>& names_of_a_map() {
  static const std::vector<std::string> kNames{
      "chair", "office chair", "couch", "dining table", "tv", "odd*", "/ism/", "K\u00FCche"};
  return kNames;
}

ClassVocabulary vocabulary_of_a_map() {
  return ClassVocabulary::create(
             {.aliases = {{{"sofa"}, {{"settee"}}}, {{"chair"}, {{"stool"}}}},
              .super_classes = {{{"seat"}, {{"chair"}, {"sofa"}, {"office chair"}}},
                                {{"tableware"}, {{"cup"}, {"bowl"}}}}})
      .value();
}

std::vector<std::string> asked(const std::string& text,
                               const ClassVocabulary& vocabulary = vocabulary_of_a_map()) {
  const auto names = asked_names(text, names_of_a_map(), vocabulary);
  if (!names) return {to_string(names.error())};
  return {names->canonical_names().begin(), names->canonical_names().end()};
}

TEST(AskedNames, ANameIsItsClassWithAliasesAndAllBelow) {
  EXPECT_THAT(asked("Dining-Table"), ElementsAre("diningtable"));
  EXPECT_THAT(asked("settee"), ElementsAre("settee", "sofa"));
  EXPECT_THAT(asked("couch"), ElementsAre("settee", "sofa"));
  EXPECT_THAT(asked("seat"),
              ElementsAre("chair", "officechair", "seat", "settee", "sofa", "stool"));
  EXPECT_THAT(asked("unicorn"), ElementsAre("unicorn"));
  EXPECT_THAT(asked("tv", {}), ElementsAre("tvmonitor"));
}

TEST(AskedNames, APrefixIsAllThatBeginsSoInAnySpelling) {
  EXPECT_THAT(asked("d*"), ElementsAre("diningtable"));
  EXPECT_THAT(asked("Dining T*"), ElementsAre("diningtable"));
  EXPECT_THAT(asked("tv*"), ElementsAre("tvmonitor"));
  EXPECT_THAT(asked("cou*"), ElementsAre("settee", "sofa"));  // the map's word for it
  EXPECT_THAT(asked("set*"), ElementsAre("settee", "sofa"));  // an alias
  EXPECT_THAT(asked("table*"), ElementsAre("bowl", "cup", "tableware"));
  EXPECT_THAT(asked("x*"), IsEmpty());
  EXPECT_THAT(asked("*", {}).size(), names_of_a_map().size());
}

TEST(AskedNames, AnExpressionMatchesTheWholeName) {
  EXPECT_THAT(asked("/chair|tv/", {}), ElementsAre("chair", "tvmonitor"));
  EXPECT_THAT(asked("/.*CHAIR/", {}), ElementsAre("chair", "officechair"));
  EXPECT_THAT(asked("/hair/", {}), IsEmpty());
  EXPECT_THAT(asked("/k.che/", {}),
              ElementsAre("k\xC3\xBC"
                          "che"));  // a character, not a byte
  EXPECT_THAT(asked("/.*ware/"), ElementsAre("bowl", "cup", "tableware"));
}

TEST(AskedNames, WhatANameHoldsHasNoOtherMeaning) {
  EXPECT_THAT(asked("odd*"), ElementsAre("odd*"));
  EXPECT_THAT(asked("/ism/"), ElementsAre("/ism/"));
  EXPECT_THAT(asked("/"), ElementsAre("/"));
  EXPECT_THAT(asked("//"), ElementsAre("//"));
}

std::string refused(const std::string& text) {
  const auto names = asked_names(text, names_of_a_map(), vocabulary_of_a_map());
  return names ? "was accepted" : to_string(names.error());
}

TEST(AskedNames, ExpressionsAreRefusedWithThePlaceAndBounded) {
  EXPECT_THAT(refused("/cha(ir/"), HasSubstr("is no regular expression"));
  EXPECT_THAT(refused("/cha(ir/"), HasSubstr("at byte 6"));
  EXPECT_THAT(refused("/[z-a]/"), HasSubstr("is no regular expression"));
  EXPECT_THAT(refused("/" + std::string(257, 'a') + "/"), HasSubstr("at most 256 bytes"));
  EXPECT_THAT(refused("/" + std::string(60, '(') + "/"), HasSubstr("is no regular expression"));
  EXPECT_THAT(refused("/((ab){1000}){1000}/"), HasSubstr("is no regular expression"));
  EXPECT_THAT(refused("/a\xFF/"), HasSubstr("is no regular expression"));
  // 2^n ways to split n letters: the limit on steps ends them.
  const std::vector<std::string> long_name{std::string(200, 'a')};
  const auto slow = asked_names("/(a+)+[bc]/", long_name, {});
  ASSERT_FALSE(slow);
  EXPECT_EQ(slow.error().code, ErrorCode::kLimit);
  EXPECT_THAT(slow.error().what, HasSubstr("takes too long"));
  const auto recursive = asked_names("/((?R)|a)*/", long_name, {});
  EXPECT_TRUE(!recursive || recursive->canonical_names().size() <= 1);
}

TEST(AskedNames, NothingAskedSaysWhatWasMeant) {
  const ClassVocabulary vocabulary = vocabulary_of_a_map();
  const auto said = [&](const std::string& text) {
    return nothing_asked(text, names_of_a_map(), vocabulary);
  };
  EXPECT_EQ(said("chiar"), "no class is called \"chiar\", did you mean \"chair\"?");
  EXPECT_EQ(said("setee"), "no class is called \"setee\", did you mean \"settee\"?");
  EXPECT_EQ(said("tableware"), "no class is of \"tableware\" (bowl, cup, tableware)");
  EXPECT_EQ(said("cup"), "no class is called \"cup\"");
  EXPECT_EQ(said("x*"), "no class begins with \"x\"");
  EXPECT_EQ(said("/x.*/"), "no class matches /x.*/");
  EXPECT_EQ(nothing_asked("cup", {}, {}, "no class of this map"),
            "no class of this map is called \"cup\"");
}

TEST(AskedClasses, AreThoseOfAllTexts) {
  const std::vector<std::string> names{"cup", "chair", "settee"};
  const ClassRegistry registry = ClassRegistry::from_names(names).value();
  const auto ids = [&](const std::vector<std::string>& texts) {
    return asked_classes(registry, vocabulary_of_a_map(), texts);
  };
  EXPECT_EQ(ids({"Chair", "cup", "chair"}).value(), (std::vector<ClassId>{{0}, {1}}));
  EXPECT_EQ(ids({"seat"}).value(), (std::vector<ClassId>{{1}, {2}}));
  EXPECT_EQ(ids({"sofa", "c*"}).value(), (std::vector<ClassId>{{0}, {1}, {2}}));
  EXPECT_TRUE(ids({}).value().empty());
  EXPECT_EQ(ids({"/(/"}).error().code, ErrorCode::kInvalidArgument);
  const Error unknown = ids({"cup", "dog"}).error();
  EXPECT_EQ(unknown.code, ErrorCode::kNotFound);
  EXPECT_EQ(unknown.what, "no class is called \"dog\" (3 are known: cup, chair, settee)");
  EXPECT_EQ(
      asked_classes(registry, {}, std::vector<std::string>{"hai"}).error().what,
      "no class is called \"hai\", did you mean \"chair\"? (3 are known: cup, chair, settee)");
  ClassRegistry many;
  for (int i = 0; i < 101; ++i) ASSERT_TRUE(many.add("c" + std::to_string(i)));
  EXPECT_EQ(asked_classes(many, {}, std::vector<std::string>{"cup"}).error().what,
            "no class is called \"cup\" (101 are known)");
}

TEST(NameSelection, HoldsNamesInAnySpelling) {
  const NameSelection tv = "TV";
  EXPECT_TRUE(tv.contains("tvmonitor"));
  EXPECT_FALSE(tv.contains("tv monitors"));
  const auto two = NameSelection::of_canonical({"cup", "diningtable"});
  EXPECT_TRUE(two.contains("Dining table"));
  EXPECT_FALSE(two.contains("table"));
  EXPECT_FALSE(NameSelection::of_canonical({}).contains(""));
}

}  // namespace
}  // namespace hypermap
