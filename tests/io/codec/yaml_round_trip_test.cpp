// SPDX-License-Identifier: BSD-3-Clause
// Whatever the reader accepts, the writer writes so that it is read again as the same tree: texts
// of few characters that YAML takes notice of, in every form and place, and the shapes of whole
// documents at the limits.
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "support/sanitized.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {
namespace {

const SourceName kAnySource{.file = "a.yaml"};

/// Texts as strangers' files have them, bare.
constexpr std::array<std::string_view, 26> kStrangersTexts{"2019-04-23 12:51:46",
                                                           "2001-12-14 21:59:43.10 -5",
                                                           "2001-12-14t21:59:43.10-05:00",
                                                           "1:30",
                                                           "00:1b:44:11:3a:b7",
                                                           "50%",
                                                           "-1E-5",
                                                           "+12E03",
                                                           "-.Inf",
                                                           "+.INF",
                                                           ".NaN",
                                                           "-0X1F",
                                                           "0b1010_0111",
                                                           "1_000",
                                                           "1,5",
                                                           "1'000",
                                                           "12\" nails",
                                                           "1#2",
                                                           "2 chairs: no",
                                                           "3\xC2\xB0",
                                                           "6:",
                                                           "7 \n\n  8",
                                                           "why?",
                                                           "a?b",
                                                           "... and so on",
                                                           "192.168.0.1/24"};

/// Where a value or a key may stand; `%` is its place.
constexpr std::array<std::string_view, 14> kPlaces{"%\n",
                                                   "- %\n",
                                                   "a: %\n",
                                                   "a:\n  b:\n    - c: %\n",
                                                   "- - %\n  - [%]\n",
                                                   "a: [%, 1]\n",
                                                   "a: [1, [%]]\n",
                                                   "{a: %}\n",
                                                   "- {a: {b: %, c: 1}}\n",
                                                   "%: 1\n",
                                                   "a:\n  - %: 1\n    b: 2\n",
                                                   "? %\n: 1\n",
                                                   "[{%: 1}]\n",
                                                   "a: {%: {%: 1}}\n"};

/// How a text may be written.
std::vector<std::string> forms_of(std::string_view text) {
  const std::string bare(text);
  return {bare,
          "'" + bare + "'",
          "\"" + bare + "\"",
          "!!str " + bare,
          "!!int " + bare,
          "!!null '" + bare + "'",
          "! " + bare};
}

std::string placed(std::string_view place, std::string_view text) {
  std::string document;
  for (const char c : place) document += c == '%' ? std::string(text) : std::string(1, c);
  return document;
}

/// What is read of `text` is written and read again as it was. Whether it is read at all.
bool holds_for(const std::string& text) {
  const auto first = parse_yaml(text, kAnySource);
  if (!first) return false;
  for (const YamlStyle style : {YamlStyle::kBlock, YamlStyle::kFlow}) {
    const std::string written = write_yaml(first->value, style);
    const auto again = parse_yaml(written, kAnySource);
    EXPECT_TRUE(again) << "read:\n"
                       << text << "written:\n"
                       << written << (again ? "" : to_string(again.error()));
    if (!again) continue;
    EXPECT_TRUE(again->value == first->value) << "read:\n" << text << "written:\n" << written;
    EXPECT_EQ(write_yaml(again->value, style), written);
  }
  return true;
}

/// In all forms and places; how many of them are read.
std::size_t num_read(std::string_view text) {
  std::size_t count = 0;
  for (const std::string& form : forms_of(text))
    for (const std::string_view place : kPlaces) count += holds_for(placed(place, form)) ? 1U : 0U;
  return count;
}

TEST(YamlRoundTrip, TextsOfStrangersAreTheSameInEveryFormAndPlace) {
  for (const std::string_view text : kStrangersTexts) EXPECT_GT(num_read(text), 10U) << text;
}

TEST(YamlRoundTrip, TextsOfTwoActiveCharactersAreTheSameInEveryFormAndPlace) {
  constexpr std::string_view kActive = "0a-+.:,;#?[{}]'\"!&*%@=~_\\|>< \t`";
  constexpr std::size_t kStep = test::kSanitized ? 4 : 1;
  std::size_t count = 0;
  for (std::size_t i = 0; i < kActive.size(); ++i) {
    count += num_read(std::string(1, kActive[i]));
    // Every fourth is another one for each first character.
    for (std::size_t j = i % kStep; j < kActive.size(); j += kStep)
      count += num_read(std::string{kActive[i], kActive[j]});
  }
  EXPECT_GT(count, test::repetitions(20'000U));
}

TEST(YamlRoundTrip, LongerTextsOfActiveCharactersAreTheSameInEveryFormAndPlace) {
  constexpr std::array<std::string_view, 34> kPieces{
      "0",  "1",     "9",     "e",  "E",    "x",    "_",       "-",       "+",    ".",   ":", ": ",
      " ",  " ",     "#",     " #", ",",    ", ",   "?",       "[",       "]",    "{",   "}", "'",
      "\"", "\\x01", "\\x85", "\n", "\n\n", "\n  ", "\\u2028", "\\uFEFF", "null", "true"};
  std::mt19937 random(5);
  std::uniform_int_distribution<std::size_t> any_piece(0, kPieces.size() - 1);
  std::uniform_int_distribution<std::size_t> any_place(0, kPlaces.size() - 1);
  std::uniform_int_distribution<int> any_length(2, 8);
  std::size_t count = 0;
  for (int i = 0; i < test::repetitions(40'000); ++i) {
    std::string text;
    for (int left = any_length(random); left > 0; --left) text += kPieces[any_piece(random)];
    const std::vector<std::string> forms = forms_of(text);
    for (const std::string& form : forms)
      count += holds_for(placed(kPlaces[any_place(random)], form)) ? 1U : 0U;
  }
  EXPECT_GT(count, 10'000U);
}

TEST(YamlRoundTrip, KeysAreTheSameAtAnyLength) {
  // Bare or quoted, a key of more than 1,024 bytes is none to YAML unless it says so with `?`.
  for (const std::string_view piece : {"k", "\\x01", "\\u2028", "\\\"", "\xC3\xA9"}) {
    for (const std::size_t length :
         {170U, 171U, 255U, 256U, 511U, 512U, 1022U, 1023U, 1024U, 1025U, 5000U}) {
      std::string key;
      for (std::size_t i = 0; i < length; ++i) key += piece;
      for (const char* value : {"1", "[1]", "{a: 1}", "[{b: 1}, [2]]"}) {
        std::string entry = "? \"";
        entry.append(key).append("\" : ").append(value);
        std::string map = "{";
        map.append(entry).append(", z: 1}\n");
        std::string list = "- 1\n- [{";
        list.append(entry).append("}]\n- z: {").append(entry).append("}\n");
        EXPECT_TRUE(holds_for(map));
        EXPECT_TRUE(holds_for(list));
      }
    }
  }
}

TEST(YamlRoundTrip, LongBlockListsAreTheSame) {
  // More items than one flow collection may have, few with many commas, and few long ones.
  std::vector<std::string> documents(3);
  for (int i = 0; i < 260'000; ++i) documents[0] += "- 1\n";
  for (int i = 0; i < 300; ++i) documents[1] += "- \"" + std::string(1'000, ',') + "\"\n";
  for (int i = 0; i < 300; ++i) documents[2] += "- \"" + std::string(1'000, '[') + "\"\n";
  for (const std::string& document : documents) {
    const auto first = parse_yaml(document, kAnySource);
    ASSERT_TRUE(first) << to_string(first.error());
    const auto again = parse_yaml(write_yaml(first->value), kAnySource);
    ASSERT_TRUE(again) << to_string(again.error());
    EXPECT_TRUE(again->value == first->value);
  }
}

TEST(YamlRoundTrip, EscapedCommasAreLimitedAsTheyAreWritten) {
  std::string commas;
  for (int i = 0; i < 250'000; ++i) commas += "\\x2C";
  EXPECT_TRUE(holds_for("\"" + commas + "\"\n"));
  EXPECT_FALSE(holds_for("\"" + commas + "\\x2C\"\n"));
}

TEST(YamlRoundTrip, CopiesOfAnchorsCountAsWhatTheyCopy) {
  // Written without anchors, so that depth and number of values are those of the copies.
  const std::string deep = std::string(40, '[') + "1" + std::string(40, ']');
  const auto nested = [&](int levels) {
    return "a: &deep " + deep + "\nb: " + std::string(static_cast<std::size_t>(levels), '[') +
           "*deep" + std::string(static_cast<std::size_t>(levels), ']') + "\n";
  };
  EXPECT_TRUE(holds_for(nested(23)));  // 1 + 23 + 40 levels
  EXPECT_FALSE(holds_for(nested(24)));
  const auto many = parse_yaml("a: &x [1, 2]\nb: [*x, *x]\n", kAnySource, {.max_nodes = 10});
  EXPECT_FALSE(many);  // the map, a and its two, b, and twice three
}

}  // namespace
}  // namespace hypermap
