// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/value_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hypermap {
namespace {

TEST(ValueTree, KeysAreFoundInMapsOnly) {
  const ValueTree tree = make_map({{"a", make_number(1)}, {"b", make_text("x")}});
  ASSERT_NE(tree.find("b"), nullptr);
  EXPECT_EQ(tree.find("b")->text, "x");
  EXPECT_EQ(tree.find("c"), nullptr);
  EXPECT_EQ(make_text("a").find("a"), nullptr);
}

TEST(ValueTree, LinesDoNotMatterForEquality) {
  ValueTree a = make_list({make_number(1)});
  ValueTree b = a;
  b.line = 7;
  b.items.front().line = 9;
  EXPECT_EQ(a, b);
  a.items.front().text = "2";
  EXPECT_NE(a, b);
}

TEST(ValueTree, TextThatLooksLikeSomethingElseIsMarked) {
  for (const char* text : {"",
                           "~",
                           "null",
                           "true",
                           "No",
                           "on",
                           "1",
                           "-1.5",
                           "+3",
                           ".5",
                           "010",
                           "1_000",
                           "1:30",
                           "2020-01-01",
                           ".inf",
                           "-.INF",
                           ".nan",
                           "0x1F"}) {
    EXPECT_TRUE(make_text(text).quoted) << text;
  }
  for (const char* text : {"chair", "a1", "-", "nothing", ".x", "-a", "truest", "\xC3\xA9"}) {
    EXPECT_FALSE(make_text(text).quoted) << text;
  }
  EXPECT_NE(make_text("1"), make_number(1));
}

TEST(ValueTree, NumbersAreShortestAndExact) {
  EXPECT_EQ(make_number(0.05).text, "0.05");
  EXPECT_EQ(make_number(-20.8).text, "-20.8");
  EXPECT_EQ(make_number(1.0 / 3.0).text, "0.3333333333333333");
  EXPECT_EQ(make_number(100).text, "100");
  EXPECT_EQ(make_number(std::nan("")).text, ".nan");
  EXPECT_EQ(make_number(-std::numeric_limits<double>::infinity()).text, "-.inf");
}

}  // namespace
}  // namespace hypermap
