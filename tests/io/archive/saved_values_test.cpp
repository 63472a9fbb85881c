// SPDX-License-Identifier: BSD-3-Clause
// Whatever strangers wrote beside what is known, and in whichever member: what loads is saved, and
// loads again as the same map.
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/semantic_yaml.hpp"
#include "io/archive/archive_edits.hpp"
#include "io/archive/sample_archive.hpp"
#include "support/sanitized.hpp"
#include "support/temp_dir.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using test::changed;
using test::kArchiveSource;
using test::member_of;
using test::replaced;
using test::sample_archive;
using test::TempDir;

/// Values as they may stand in YAML.
std::vector<std::string> strangers_values() {
  return {"2019-04-23 12:51:46",
          "2001-12-14t21:59:43.10-05:00",
          "1:30",
          "00:1b:44:11:3a:b7",
          "50%",
          "-1E-5",
          "+12E03",
          "-.Inf",
          ".NaN",
          "-0X1F",
          "1_000",
          "1,5",
          "192.168.0.1/24",
          "12\" nails",
          "why?",
          "a?b",
          "\"why?\"",
          "... and so on",
          "'... and so on'",
          "!!str 5",
          "!!int '7'",
          "!!null '~'",
          "!!str",
          "~",
          "\"\"",
          "\"\\x01\\u2028\\x85\"",
          "[1:30, 50%, [-1E-5], {at: 12:51:46}]",
          "{1:30: 2, 2019-04-23: [a?b], \"why?\": {'': ~}}",
          "&x [1, *x]",
          "|\n      1\n      2\n",
          "? \"" + std::string(1'100, 'k') + "\"\n      : 1",
          "{? \"" + std::string(200, '\x01') + "\" : 1}"};
}

/// A sample map into each of whose YAML members an unknown key comes, `line` with its value.
std::string with_unknown(const std::string& line) {
  const std::string bytes = write_archive(sample_archive()).value();
  const auto after = [](const std::string& text,
                        const std::string& known,
                        const std::string& what) { return replaced(text, known, known + what); };
  std::string config = member_of(bytes, "hmap_config.yaml");
  config = after(config, "file: occupancy\n", "    " + line + "\n");
  config = after(config, "child_frame_id: lab\n", "    " + line + "\n");
  config = after(config, "file: classes.yaml\n", "    " + line + "\n");
  config = after(config, "file: class_grid_0\n", "    " + line + "\n");
  config = after(config, "extensions:\n", "  - format: weather\n    " + line + "\n");
  config += line + "\n";
  return changed(bytes,
                 {{"hmap_config.yaml", config},
                  {"occupancy.yaml", member_of(bytes, "occupancy.yaml") + line + "\n"},
                  {"provenance.yaml", member_of(bytes, "provenance.yaml") + line + "\n"},
                  {"semantic", member_of(bytes, "semantic") + "  " + line + "\n"}});
}

/// Whether the archive loads; if it does, it is saved and loads as the same.
bool is_saved(const std::string& bytes, const std::string& what) {
  const auto loaded = parse_archive(bytes, kArchiveSource);
  if (!loaded) return false;
  const TempDir folder;
  const auto saved = save_archive(loaded->value, folder.path() / "a.hmap");
  EXPECT_TRUE(saved) << what << "\n" << (saved ? "" : to_string(saved.error()));
  if (!saved) return true;
  const auto again = load_archive(folder.path() / "a.hmap");
  EXPECT_TRUE(again && again->value == loaded->value) << what;
  return true;
}

TEST(SavedValues, UnknownKeysOfAnyValueAreSavedInEveryMember) {
  std::size_t num_loaded = 0;
  for (const std::string& value : strangers_values())
    num_loaded += is_saved(with_unknown("recorded: " + value), value) ? 1U : 0U;
  EXPECT_GT(num_loaded, 25U);
}

TEST(SavedValues, UnknownKeysOfAnyNameAreSavedInEveryMember) {
  std::size_t num_loaded = 0;
  for (const std::string& key : strangers_values())
    num_loaded += is_saved(with_unknown(key + ": 1"), key) ? 1U : 0U;
  // Near the longest simple key, with escapes and without.
  for (const std::size_t length : {1'000U, 1'019U, 1'020U, 1'021U, 1'022U}) {
    const std::string key = "\"" + std::string(length, 'k') + "\"";
    num_loaded += is_saved(with_unknown(key + ": 1"), key) ? 1U : 0U;
    const std::string tabs = "\"" + std::string(length, '\t') + "\"";
    num_loaded += is_saved(with_unknown(tabs + ": 1"), tabs) ? 1U : 0U;
  }
  EXPECT_GT(num_loaded, 15U);
}

/// A way of whole coordinates that crosses and touches itself more often than not.
std::string random_shape(std::mt19937& random) {
  std::string text = "POLYGON((";
  const std::size_t num_points = 4 + random() % 8;
  for (std::size_t i = 0; i < num_points; ++i) {
    text += (i == 0 ? "" : ",") + std::to_string(random() % 5);
    text += " " + std::to_string(random() % 5);
  }
  return text + "))";
}

TEST(SavedValues, ShapesThatLoadAreSavedEditedOrNot) {
  std::mt19937 random(31);
  std::vector<SemanticObject> objects;
  std::vector<std::string> texts{"POLYGON((0 0,4 0,4 4,0 4,0 0,1 3,3 1,0 0))"};
  for (int i = 0; i < test::repetitions(40'000); ++i) texts.push_back(random_shape(random));
  for (const std::string& text : texts) {
    const auto read =
        parse_semantic_layer("- {name: a, shape: '" + text + "'}\n", {.file = "semantic"});
    if (!read) continue;
    for (const std::string& shape_text : {read->value.objects()[0].shape_text, std::string()}) {
      objects.push_back(read->value.objects()[0]);
      objects.back().shape_text = shape_text;
      objects.back().id = objects.size() - 1;
    }
  }
  ASSERT_GT(objects.size(), 1'000U);
  MapArchive archive;
  ASSERT_TRUE(archive.hypermap.add_layer({.info = {.name = "semantic", .file = "semantic"},
                                          .content = SemanticLayer::create(objects).value()}));
  const auto again = parse_archive(write_archive(archive).value(), kArchiveSource);
  ASSERT_TRUE(again) << to_string(again.error());
  const auto* layer = again->value.hypermap.find_as<SemanticLayer>("semantic");
  ASSERT_NE(layer, nullptr);
  ASSERT_EQ(layer->objects().size(), objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i)
    EXPECT_EQ(layer->objects()[i].parts, objects[i].parts);
}

}  // namespace
}  // namespace hypermap
