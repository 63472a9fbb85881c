// SPDX-License-Identifier: BSD-3-Clause
// Walks the index of files that must load or be refused, so that a new file is checked without a
// new test.
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/octomap_file.hpp"
#include "support/hostile_index.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

/// Checks each file of a section by its name. `load` gives an error text, empty when it loads.
template <class Load>
void check_section(const std::string& kind, std::size_t min_files, const Load& load) {
  const std::vector<test::HostileFile> files = test::hostile_files(kind);
  ASSERT_GE(files.size(), min_files);
  for (const test::HostileFile& file : files) {
    const std::string name = file.path.filename();
    const std::string error = load(file.path);
    if (file.must_load) {
      EXPECT_EQ(error, "") << name;
    } else {
      EXPECT_NE(error, "") << name << " was accepted";
      EXPECT_NE(error.find(name), std::string::npos) << error << " does not name its file";
      EXPECT_LT(error.size(), 1000U) << name;
    }
  }
}

/// A file of the corpus: "zip/ok_reference.hmap".
fs::path hostile(const std::string& name) {
  return test::shared_data("hostile/" + name);
}

TEST(HostileFiles, ArchivesGiveWhatTheIndexSays) {
  HYPERMAP_REQUIRE_SHARED_DATA("hostile/INDEX.md");
  check_section("zip", 29, [](const fs::path& path) -> std::string {
    const auto archive = load_archive(path);
    if (!archive) return to_string(archive.error());
    return archive->findings.empty() ? "" : to_string(archive->findings.front().error);
  });
}

TEST(HostileFiles, GoodArchivesAreAllTheSameMapAndSurviveARoundTrip) {
  HYPERMAP_REQUIRE_SHARED_DATA("hostile/INDEX.md");
  const auto reference = load_archive(hostile("zip/ok_reference.hmap"));
  ASSERT_TRUE(reference) << to_string(reference.error());
  ASSERT_EQ(reference->value.octomaps.size(), 1U);
  for (const test::HostileFile& file : test::hostile_files("zip")) {
    if (!file.must_load) continue;
    const std::string name = file.path.filename();
    const auto archive = load_archive(file.path);
    ASSERT_TRUE(archive) << to_string(archive.error());
    EXPECT_TRUE(archive->value == reference->value) << name;
    const auto saved = write_archive(archive->value);
    ASSERT_TRUE(saved) << to_string(saved.error());
    const auto again = parse_archive(*saved, {.file = name});
    ASSERT_TRUE(again) << to_string(again.error());
    EXPECT_TRUE(again->value == reference->value) << name;
  }
}

/// A repair is told, so a file that loads with one is no clean file: INDEX offers a choice for
/// trees whose inner nodes contradict their children, and here they are computed anew and counted.
TEST(HostileFiles, OctreesGiveWhatTheIndexSays) {
  HYPERMAP_REQUIRE_SHARED_DATA("hostile/INDEX.md");
  check_section("octree", 35, [](const fs::path& path) -> std::string {
    const auto tree = read_octomap(path);
    if (!tree) return to_string(tree.error());
    return tree->findings.empty() ? "" : to_string(tree->findings.front().error);
  });
}

TEST(HostileFiles, ErrorsSayWhatTheIndexAsksFor) {
  HYPERMAP_REQUIRE_SHARED_DATA("hostile/INDEX.md");
  const auto octree_error = [](const std::string& name) {
    const auto tree = read_octomap(hostile("octree/" + name));
    return tree ? std::string("no error") : to_string(tree.error());
  };
  const std::vector<std::pair<std::string, std::string>> expected{
      {"err_truncated_half.ot", "octree: unexpected end of data at node"},
      {"err_depth_40000.ot", "tree deeper than 16"},
      {"err_res_nan.ot", "res: "},
      {"err_size_4e9.ot", "size: "},
      {"err_size_text.ot", "size: "},
      {"err_id_missing.ot", "id: "},
      {"err_logodds_nan.ot", "at node"}};
  for (const auto& [name, text] : expected)
    EXPECT_NE(octree_error(name).find(text), std::string::npos) << octree_error(name);
  const auto archive_error = [](const std::string& name) {
    const auto archive = load_archive(hostile("zip/" + name));
    return archive ? std::string("no error") : to_string(archive.error());
  };
  const std::vector<std::pair<std::string, std::string>> zip_expected{
      {"err_layer_file_traversal.hmap", "layers[1].file"},
      {"err_image_traversal.hmap", "image"},
      {"err_encrypted_flag.hmap", "encrypted entries are not supported"},
      {"err_octree_depth_1M.hmap", "the limit is"},
      {"err_bomb_64M.hmap", "the limit is"},
      {"err_bomb_yaml_32M.hmap", "the limit"},
      {"err_zipslip_backslash.hmap", "evil.yaml"},
      {"err_layer_file_missing_semantic.hmap", "semantic"}};
  for (const auto& [name, text] : zip_expected)
    EXPECT_NE(archive_error(name).find(text), std::string::npos) << archive_error(name);
}

}  // namespace
}  // namespace hypermap
