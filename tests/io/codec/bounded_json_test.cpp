// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/bounded_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

JsonDocument parsed_json(std::string_view text) {
  auto document = JsonDocument::parse(text, "x.json");
  EXPECT_TRUE(document) << to_string(document.error());
  return std::move(document).value();
}

std::string refusal(std::string_view text, const JsonLimits& limits = {}) {
  const auto document = JsonDocument::parse(text, "x.json", limits);
  return document ? "was accepted" : to_string(document.error());
}

TEST(BoundedJson, ValuesComeBackInTheOrderOfTheText) {
  const JsonDocument document =
      parsed_json(R"({"b": [1, 2.5, -3e2], "a": {"t": true, "n": null}})");
  const JsonNode root = document.root();
  ASSERT_EQ(root.size(), 2U);
  EXPECT_EQ(root.at(0).key(), "b");
  EXPECT_EQ(root.at(1).key(), "a");
  EXPECT_EQ(root.at(0).at(1).number().value(), 2.5);
  EXPECT_EQ(root.at(0).at(2).number().value(), -300.0);
  EXPECT_TRUE(root.find("a")->find("t")->boolean().value());
  EXPECT_TRUE(root.find("a")->find("n")->is(JsonKind::kNull));
  EXPECT_FALSE(root.find("c").has_value());
}

TEST(BoundedJson, PathAndLineLeadToTheValue) {
  const JsonDocument document = parsed_json("{\"a\": [1,\n {\"b\": \"x\"}]}");
  const JsonNode node = *document.root().find("a")->at(1).find("b");
  EXPECT_EQ(node.path(), "$.a[1].b");
  EXPECT_EQ(node.line(), 2);
  EXPECT_THAT(to_string(node.number().error()),
              HasSubstr("x.json:2: $.a[1].b: is a string, expected a number"));
}

TEST(BoundedJson, EscapesAndSurrogatePairsBecomeUtf8) {
  const JsonDocument document = parsed_json(R"(["\"\\\/\b\f\n\r\t", "\u00e9\ud83d\ude00"])");
  EXPECT_EQ(document.root().at(0).string().value(), "\"\\/\b\f\n\r\t");
  EXPECT_EQ(document.root().at(1).string().value(), "\xC3\xA9\xF0\x9F\x98\x80");
}

TEST(BoundedJson, AByteOrderMarkIsSkipped) {
  EXPECT_EQ(parsed_json("\xEF\xBB\xBF[]").root().size(), 0U);
}

TEST(BoundedJson, NumbersKeepTheirTextAndIntegersTheirRange) {
  const JsonDocument document = parsed_json("[1403636579763555584, 1.0, 70000, -1]");
  EXPECT_EQ(document.root().at(0).number_text(), "1403636579763555584");
  EXPECT_FALSE(document.root().at(1).integer(0, 10));
  EXPECT_FALSE(document.root().at(2).integer(0, 65535));
  EXPECT_EQ(document.root().at(3).integer(-1, 1).value(), -1);
}

TEST(BoundedJson, WhatRfc8259ForbidsIsRefusedWithItsPlace) {
  EXPECT_THAT(refusal(""), HasSubstr("the end of the text"));
  EXPECT_THAT(refusal("[1] x"), HasSubstr("expected the end of the document"));
  EXPECT_THAT(refusal("[1,]"), HasSubstr("$[1]: found ']'"));
  EXPECT_THAT(refusal("{\"a\": 1 \"b\": 2}"), HasSubstr("expected ',' or '}'"));
  EXPECT_THAT(refusal("{\"s\": NaN}"), HasSubstr("$.s"));
  EXPECT_THAT(refusal("/* c */ 1"), HasSubstr("found '/'"));
  EXPECT_THAT(refusal("[01]"), HasSubstr("found '1'"));
  EXPECT_THAT(refusal("[+1]"), HasSubstr("found '+'"));
  EXPECT_THAT(refusal("[.5]"), HasSubstr("found '.'"));
  EXPECT_THAT(refusal("[1.]"), HasSubstr("expected a digit"));
  EXPECT_THAT(refusal("{a: 1}"), HasSubstr("a key in quotes"));
  EXPECT_THAT(refusal("[\"a\nb\"]"), HasSubstr("escape control characters"));
  EXPECT_THAT(refusal("[\"\\x\"]"), HasSubstr("an escape letter"));
  EXPECT_THAT(refusal("[\"abc"), HasSubstr("a closing quote"));
}

TEST(BoundedJson, StricterThanTheRfcWhereProgramsDisagree) {
  EXPECT_THAT(refusal("{\"a\": {\"k\": 1, \"k\": 2}}"), HasSubstr("duplicate key \"k\""));
  EXPECT_THAT(refusal("[1e999]"), HasSubstr("$[0]: must be a number that fits a double"));
  EXPECT_THAT(refusal("[\"\\ud800\"]"), HasSubstr("surrogate"));
  EXPECT_THAT(refusal("[\"\\udc00\"]"), HasSubstr("surrogate"));
  EXPECT_THAT(refusal("[\"\\ud800\\u0041\"]"), HasSubstr("surrogate"));
  EXPECT_THAT(refusal("[\"\xC0\xAF\"]"), HasSubstr("must be UTF-8"));
  EXPECT_THAT(refusal("[\"\xFF\"]"), HasSubstr("must be UTF-8"));
}

TEST(BoundedJson, LimitsAreNamed) {
  const std::string deep(64, '[');
  EXPECT_THAT(refusal(deep + "[" + "]" + std::string(64, ']')), HasSubstr("at most 64 levels"));
  EXPECT_TRUE(JsonDocument::parse(deep + std::string(64, ']'), "x"));
  EXPECT_THAT(refusal("[1, 2, 3]", {.max_values = 3}), HasSubstr("at most 3 values"));
  EXPECT_THAT(refusal("[1, 2, 3]", {.max_bytes = 8}), HasSubstr("at most 8 bytes"));
}

TEST(BoundedJson, QuotedTextReadsBackTheSame) {
  const std::string text = std::string("a\"b\\c\n\x01\x7F", 8) + "\xC3\xA9";
  EXPECT_EQ(parsed_json(json_quoted(text)).root().string().value(), text);
  EXPECT_EQ(json_number(0.1), "0.1");
  EXPECT_EQ(json_number(3.0), "3");
}

}  // namespace
}  // namespace hypermap
