// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/vocabulary/class_vocabulary.hpp"

#include "hypermap/core/base/class_registry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

VocabularyGroup group_of(const std::string& name, const std::vector<std::string>& members) {
  VocabularyGroup group{.name = {name}, .members = {}};
  for (const std::string& member : members) group.members.push_back({member});
  return group;
}

/// A settee is a sofa, sofas and chairs are seats, seats and tables furniture; a stool is a seat
/// and a tool.
VocabularyGroups homely_groups() {
  return {.aliases = {group_of("sofa", {"settee", "Love Seat"}), group_of("seat", {"sitting"})},
          .super_classes = {group_of("furniture", {"seat", "dining table"}),
                            group_of("seat", {"chair", "sofa", "stool"}),
                            group_of("tool", {"stool", "saw"})}};
}

ClassVocabulary homely() {
  return ClassVocabulary::create(homely_groups()).value();
}

std::string vocabulary_refusal(VocabularyGroups groups) {
  const auto vocabulary = ClassVocabulary::create(std::move(groups));
  return vocabulary ? "was accepted" : to_string(vocabulary.error());
}

TEST(ClassVocabulary, AliasesMeanTheirClassInAnySpelling) {
  const ClassVocabulary vocabulary = homely();
  EXPECT_EQ(vocabulary.class_of("SETTEE"), "sofa");
  EXPECT_EQ(vocabulary.class_of("love-seat"), "sofa");
  EXPECT_EQ(vocabulary.class_of("couch"), "sofa");  // a spelling of the class, as before
  EXPECT_EQ(vocabulary.class_of("zebra crossing"), "zebracrossing");
  EXPECT_EQ(vocabulary.shown_class("settee"), "sofa");
  EXPECT_EQ(vocabulary.shown_class("diningtable"), "dining table");
  EXPECT_EQ(vocabulary.shown_class("Zebra"), "Zebra");
  EXPECT_THAT(vocabulary.same_names("settee"), ElementsAre("loveseat", "settee", "sofa"));
  EXPECT_THAT(vocabulary.same_names("Zebra"), ElementsAre("zebra"));
}

TEST(ClassVocabulary, SuperClassesHoldAllBelowThem) {
  const ClassVocabulary vocabulary = homely();
  EXPECT_THAT(vocabulary.names_of("sitting"),
              ElementsAre("chair", "loveseat", "seat", "settee", "sitting", "sofa", "stool"));
  EXPECT_THAT(vocabulary.names_of("furniture"),
              ElementsAre("chair",
                          "diningtable",
                          "furniture",
                          "loveseat",
                          "seat",
                          "settee",
                          "sitting",
                          "sofa",
                          "stool"));
  EXPECT_THAT(vocabulary.names_of("chair"), ElementsAre("chair"));
  EXPECT_THAT(vocabulary.super_classes_of("stool"), ElementsAre("seat", "tool", "furniture"));
  EXPECT_THAT(vocabulary.super_classes_of("settee"), ElementsAre("seat", "furniture"));
  EXPECT_THAT(vocabulary.super_classes_of("furniture"), IsEmpty());
  EXPECT_TRUE(vocabulary.is_super_class("sitting"));
  EXPECT_FALSE(vocabulary.is_super_class("sofa"));
  EXPECT_TRUE(vocabulary.knows("Saw"));
  EXPECT_FALSE(vocabulary.knows("zebra"));
}

TEST(ClassVocabulary, AnEmptyOneChangesNothing) {
  const ClassVocabulary none;
  EXPECT_TRUE(none.empty());
  EXPECT_THAT(none.names_of("TV"), ElementsAre("tvmonitor"));
  EXPECT_EQ(none.shown_class("TV"), "TV");
  EXPECT_THAT(none.all_names(), IsEmpty());
  EXPECT_EQ(ClassVocabulary::create({}).value(), none);
}

TEST(ClassVocabulary, CirclesAreToldWhole) {
  EXPECT_EQ(
      vocabulary_refusal({.aliases = {},
                          .super_classes = {group_of("seat", {"chair"}),
                                            group_of("chair", {"arm chair"}),
                                            group_of("Arm-Chair", {"seat"})}}),
      "super_classes.arm chair: super-classes form a circle: seat > chair > arm chair > seat");
  EXPECT_THAT(vocabulary_refusal({.aliases = {}, .super_classes = {group_of("a", {"a"})}}),
              HasSubstr("circle: a > a"));
  // A circle below the first super-class is told without what leads there.
  EXPECT_THAT(
      vocabulary_refusal(
          {.aliases = {},
           .super_classes = {group_of("a", {"b"}), group_of("b", {"c"}), group_of("c", {"b"})}}),
      HasSubstr("circle: b > c > b"));
}

TEST(ClassVocabulary, ANameMeansOneThing) {
  const auto aliases = [](std::vector<VocabularyGroup> groups) {
    return vocabulary_refusal({.aliases = std::move(groups), .super_classes = {}});
  };
  EXPECT_EQ(aliases({group_of("sofa", {"settee"}), group_of("bench", {"Settee"})}),
            "aliases.bench: \"Settee\" is an alias of \"sofa\" already");
  EXPECT_EQ(aliases({group_of("sofa", {"settee", "SETTEE"})}),
            "aliases.sofa: \"SETTEE\" stands there twice");
  EXPECT_EQ(aliases({group_of("sofa", {"settee"}), group_of("settee", {"divan"})}),
            "aliases.settee: is an alias of \"sofa\", and has aliases of its own");
  EXPECT_EQ(aliases({group_of("sofa", {}), group_of("Couch", {})}),
            "aliases.Couch: stands there twice, in another spelling");
  EXPECT_EQ(aliases({group_of("sofa", {"couch"})}), "was accepted");  // says nothing new
  const auto with_sofa = [](std::vector<VocabularyGroup> super_classes) {
    return vocabulary_refusal(
        {.aliases = {group_of("sofa", {"settee"})}, .super_classes = std::move(super_classes)});
  };
  EXPECT_EQ(with_sofa({group_of("seat", {"settee"})}),
            "super_classes.seat: \"settee\" is an alias of \"sofa\": that class must stand here");
  EXPECT_EQ(with_sofa({group_of("settee", {"chair"})}),
            "super_classes.settee: \"settee\" is an alias of \"sofa\": that class must stand here");
  EXPECT_EQ(with_sofa({group_of("seat", {"chair", "Chair"})}),
            "super_classes.seat: \"Chair\" stands there twice");
}

TEST(ClassVocabulary, NamesAreThoseOfClasses) {
  const auto alias = [](const std::string& name) {
    return vocabulary_refusal({.aliases = {group_of("sofa", {name})}, .super_classes = {}});
  };
  EXPECT_THAT(alias(""), HasSubstr("must not be empty"));
  EXPECT_THAT(alias("a\xFF"), HasSubstr("must be UTF-8 without NUL"));
  EXPECT_THAT(alias(std::string("a\0b", 3)), HasSubstr("must be UTF-8 without NUL"));
  EXPECT_THAT(alias(std::string(257, 'x')), HasSubstr("at most 256 bytes"));
  EXPECT_EQ(alias(std::string(256, 'x')), "was accepted");
  EXPECT_EQ(alias("k\xC3\xBC"
                  "che"),
            "was accepted");
}

TEST(ClassVocabulary, StopsAtItsLimits) {
  VocabularyGroups tower;
  for (int i = 0; i < 16; ++i) {
    tower.super_classes.push_back(group_of("c" + std::to_string(i), {"c" + std::to_string(i + 1)}));
  }
  EXPECT_EQ(vocabulary_refusal(tower), "was accepted");
  // The order in which they stand makes no difference.
  tower.super_classes.insert(tower.super_classes.begin(), group_of("c16", {"c17"}));
  const auto too_high = ClassVocabulary::create(tower);
  ASSERT_FALSE(too_high);
  EXPECT_EQ(too_high.error().code, ErrorCode::kLimit);
  EXPECT_THAT(too_high.error().what, HasSubstr("at most 16 super-classes"));
  VocabularyGroups many{.aliases = {group_of("sofa", {})}, .super_classes = {}};
  for (int i = 0; i < 19'999; ++i) many.aliases[0].members.push_back({"a" + std::to_string(i)});
  EXPECT_EQ(vocabulary_refusal(many), "was accepted");
  many.aliases[0].members.push_back({"one more"});
  EXPECT_THAT(vocabulary_refusal(many), HasSubstr("at most 20000 names are kept, has 20001"));
}

TEST(ClassVocabulary, ErrorsHaveTheLineOfTheName) {
  VocabularyGroups groups;
  groups.aliases = {{{"sofa", 2}, {{"settee", 3}, {"Settee", 4}}}};
  EXPECT_EQ(ClassVocabulary::create(groups).error().line, 4);
  groups.aliases = {};
  groups.super_classes = {{{"a", 6}, {{"b", 7}}}, {{"b", 8}, {{"c", 9}, {"a", 10}}}};
  EXPECT_EQ(ClassVocabulary::create(groups).error().line, 10);
}

/// Which classes each class of a random graph without circles holds, found by trying all ways.
std::set<std::string> reached_by_trying(std::size_t from,
                                        const std::vector<std::vector<std::size_t>>& below) {
  std::set<std::string> reached;
  const std::function<void(std::size_t)> walk = [&](std::size_t one) {
    reached.insert("c" + std::to_string(one));
    for (const std::size_t next : below[one]) walk(next);
  };
  walk(from);
  return reached;
}

TEST(ClassVocabulary, WhatASuperClassHoldsIsWhatAllWaysDownReach) {
  std::mt19937 random(7);
  for (int round = 0; round < 50; ++round) {
    constexpr std::size_t kNum = 12;
    std::vector<std::vector<std::size_t>> below(kNum);
    VocabularyGroups groups;
    for (std::size_t i = 0; i < kNum; ++i) {
      std::vector<std::string> members;
      for (std::size_t k = i + 1; k < kNum; ++k) {
        if (random() % 4 != 0) continue;
        below[i].push_back(k);
        members.push_back("C " + std::to_string(k));
      }
      if (!members.empty())
        groups.super_classes.push_back(group_of("c" + std::to_string(i), members));
    }
    std::shuffle(groups.super_classes.begin(), groups.super_classes.end(), random);
    const auto vocabulary = ClassVocabulary::create(groups);
    ASSERT_TRUE(vocabulary) << to_string(vocabulary.error());
    for (std::size_t i = 0; i < kNum; ++i) {
      const std::string name = "c" + std::to_string(i);
      const auto expected = reached_by_trying(i, below);
      EXPECT_THAT(vocabulary->names_of(name), testing::ElementsAreArray(expected));
      // The other direction: who holds it is a super-class of it.
      for (std::size_t k = 0; k < kNum; ++k) {
        const auto above = vocabulary->super_classes_of("c" + std::to_string(k));
        const bool is_above = std::find(above.begin(), above.end(), name) != above.end();
        EXPECT_EQ(is_above, k != i && expected.contains("c" + std::to_string(k)));
      }
    }
  }
}

TEST(ClassVocabulary, ARandomGraphWithAWayBackIsRefused) {
  std::mt19937 random(11);
  for (int round = 0; round < 50; ++round) {
    const int length = 2 + static_cast<int>(random() % 9);
    VocabularyGroups groups;
    for (int i = 0; i < length; ++i) {
      groups.super_classes.push_back(
          group_of("c" + std::to_string(i),
                   {"leaf " + std::to_string(i), "c" + std::to_string((i + 1) % length)}));
    }
    std::shuffle(groups.super_classes.begin(), groups.super_classes.end(), random);
    EXPECT_THAT(vocabulary_refusal(groups), HasSubstr("form a circle"));
  }
}

}  // namespace
}  // namespace hypermap
