// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/bounded_yaml.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace hypermap {
namespace {

TEST(YamlWriter, WhatIsWrittenReadsAsTheSameTree) {
  const ValueTree tree =
      make_map({{"name", make_text("- x: y\n# z")},
                {"numbers", make_list({make_number(0.1), make_number(-1e-300), make_number(3)})},
                {"texts",
                 make_list({make_text("0.1"),
                            make_text("true"),
                            make_text(""),
                            make_text("~"),
                            make_text("010"),
                            make_text("plain"),
                            make_text(" a "),
                            make_text("a: b"),
                            make_text("a #b"),
                            make_text("caf\xC3\xA9 \xE6\x9C\xBA"),
                            make_text("\"\\\t\x01\x7F"),
                            make_text("-"),
                            make_text("--- x"),
                            make_text("<<"),
                            make_text("it's"),
                            make_text("C:\\x"),
                            make_text("..."),
                            make_text("[a]"),
                            make_text("a,b"),
                            make_text("? x"),
                            make_text("nel \xC2\x85 csi \xC2\x9B space \xC2\xA0"),
                            make_text("lines \xE2\x80\xA8 \xE2\x80\xA9 mark \xEF\xBB\xBF"),
                            make_text("=")})},
                {"truth", make_bool(true)},
                {"nothing", {}},
                {"<<", make_text("a key in quotes")},
                {"list",
                 make_list({make_map({{"a", make_number(1)}, {"b", make_list({})}}),
                            make_list({make_list({make_text("deep"), make_map({})}), {}}),
                            make_map({{"m", make_map({{"n", make_text("x")}})}})})},
                {"empty", make_map({})}});
  for (const YamlStyle style : {YamlStyle::kBlock, YamlStyle::kFlow}) {
    const std::string text = write_yaml(tree, style);
    const auto again = parse_yaml(text, SourceName{.file = "a.yaml"});
    ASSERT_TRUE(again) << text << to_string(again.error());
    ValueTree back = again->value;
    // An empty collection keeps its kind: [] is no {}.
    EXPECT_EQ(back, tree) << text << write_yaml(back, style);
    EXPECT_EQ(write_yaml(back, style), text);
  }
}

TEST(YamlWriter, CharactersThatEndLinesElsewhereAreEscaped) {
  EXPECT_EQ(write_yaml(make_text("a\xC2\x85"
                                 "b\xE2\x80\xA8"
                                 "c\xEF\xBB\xBF"
                                 "d\xC2\xA0")),
            "\"a\\x85b\\u2028c\\uFEFFd\xC2\xA0\"\n");
}

TEST(YamlWriter, BlocksAreWrittenWithTwoBlanksOfIndent) {
  const ValueTree tree =
      make_map({{"layers",
                 make_list({make_map({{"name", make_text("a")}, {"load_file", make_bool(true)}})})},
                {"origin", make_list({make_number(-0.4), make_number(0), make_number(1e-7)})}});
  EXPECT_EQ(write_yaml(tree),
            "layers:\n"
            "  - name: a\n"
            "    load_file: true\n"
            "origin: [-0.4, 0, 1e-07]\n");
}

TEST(YamlWriter, NumbersAreWrittenWithFullPrecision) {
  for (const double number :
       {0.1, 1.0 / 3.0, 6.02214076e23, -0.0, 5e-324, std::numeric_limits<double>::max()}) {
    const auto document =
        parse_yaml(write_yaml(make_list({make_number(number)})), SourceName{.file = "a.yaml"});
    ASSERT_TRUE(document);
    EXPECT_EQ(*document->root().as_list()->front().as_double(), number);
  }
}

}  // namespace
}  // namespace hypermap
