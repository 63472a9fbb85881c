// SPDX-License-Identifier: BSD-3-Clause
#include "text/flat_records.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <vector>

namespace hypermap {
namespace {

/// Also on the same lines.
bool is_same_tree(const ValueTree& a, const ValueTree& b) {
  const auto is_same_entry = [](const auto& x, const auto& y) {
    return x.first == y.first && is_same_tree(x.second, y.second);
  };
  return a == b && a.line == b.line && std::ranges::equal(a.items, b.items, is_same_tree) &&
         std::ranges::equal(a.entries, b.entries, is_same_entry);
}

/// By YAML's own parser: a comment is nothing for flat records.
Result<YamlDocument> by_parser(const std::string& text) {
  return parse_yaml(text + "\n# parsed\n", {});
}

TEST(FlatRecords, AreWhatTheParserMakesOfThem) {
  const std::string text =
      "- name: dining table\n"
      "  shape: POLYGON((-1.5 2,3e-7 2,3 4,-1.5 2))\n"
      "  tags: ~\n"
      "  confidence: 0.25\n"
      "- name: Null\n"
      "  shape: MULTIPOLYGON(((0 0, 1 0, 1 1)))\n"
      "  id: -7\n"
      "  when: 2020-01-01\n"
      "  b: yes";
  const auto records = flat_records(text, {});
  ASSERT_TRUE(records);
  EXPECT_TRUE(is_same_tree(*records, by_parser(text).value().value));
  EXPECT_EQ(records->items.at(1).entries.at(2).second.line, 7);
  EXPECT_EQ(records->items.at(1).entries.at(0).second.kind, ValueKind::kNull);
}

TEST(FlatRecords, LeaveAllElseToTheParser) {
  for (const std::string text : {"",
                                 "a: 1\n",
                                 "-\n",
                                 "- a\n",
                                 "- a:\n",
                                 "- a: 'x'\n",
                                 "- a: \"x\"\n",
                                 "- a: [1]\n",
                                 "- a: x # y\n",
                                 "- a: x: y\n",
                                 "- a: x \n",
                                 "- a: x  y\n",
                                 "- a: x\r\n",
                                 "- a: *x\n",
                                 "- a: -\n",
                                 "- a: - b\n",
                                 "- a: .5\n",
                                 "- a: 1\n  a: 2\n",
                                 "- a: 1\n   b: 2\n",
                                 "- a: 1\n b: 2\n",
                                 "- a: 1\n\n- a: 2\n",
                                 "- a: 1\n---\n",
                                 "- a: 1\n  # b\n",
                                 "- null: 1\n",
                                 "- a b: 1\n",
                                 "- a: \xC3\xA4\n",
                                 "-  a: 1\n"}) {
    EXPECT_FALSE(flat_records(text, {})) << text;
  }
}

TEST(FlatRecords, CrossNoLimit) {
  const std::string text = "- a: 1\n  b: x,y\n- a: 2\n";
  EXPECT_TRUE(flat_records(text, {.max_nodes = 6, .max_map_keys = 2}));
  EXPECT_FALSE(flat_records(text, {.max_nodes = 5}));
  EXPECT_FALSE(flat_records(text, {.max_map_keys = 1}));
  EXPECT_FALSE(flat_records(text, {.max_depth = 1}));
  EXPECT_FALSE(flat_records(text, {.max_flow_items = 2}));
}

TEST(FlatRecords, AgreeWithTheParserWhateverIsInALine) {
  constexpr std::array<const char*, 24> kPieces{
      "- ", "  ", "a", "b: ", "name: ", "1", "-1", "~",   "null", "x",   " ",    ",",
      "(",  ")",  ".", "/",   "+",      "-", "_",  "yes", "0x1F", "1e5", "true", "T"};
  std::mt19937 random(17);
  std::uniform_int_distribution<std::size_t> piece(0, kPieces.size() - 1);
  std::uniform_int_distribution<int> length(0, 4);
  int num_flat = 0;
  for (int round = 0; round < 20'000; ++round) {
    std::string text;
    const int num_lines = 1 + length(random);
    for (int line = 0; line < num_lines; ++line) {
      text += line == 0 || length(random) == 0 ? "- " : "  ";
      text += std::string(1, static_cast<char>('a' + line)) + ": ";
      for (int i = length(random); i >= 0; --i) text += kPieces.at(piece(random));
      text += "\n";
    }
    const auto records = flat_records(text, {});
    if (!records) continue;
    ++num_flat;
    const auto parsed = by_parser(text);
    ASSERT_TRUE(parsed) << text << to_string(parsed.error());
    ASSERT_TRUE(is_same_tree(*records, parsed->value)) << text;
  }
  EXPECT_GT(num_flat, 1000);
}

}  // namespace
}  // namespace hypermap
