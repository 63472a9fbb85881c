// SPDX-License-Identifier: BSD-3-Clause
// Maps, configurations and semantic layers as `check` reports them: found by content, then by their
// reader.
#include "hypermap/io/check/file_check.hpp"
#include "hypermap/io/codec/pgm_image.hpp"
#include "support/hostile_index.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <tuple>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

std::string said_by(const FileCheckResult& result) {
  std::string out = result.summary;
  for (const Finding& finding : result.findings) out += "\n" + to_string(finding.error);
  return out;
}

/// Folder of the corpus and kind that all its files are.
using Section = std::tuple<const char*, std::optional<FileKind>>;

class HostileMapFiles : public ::testing::TestWithParam<Section> {};

TEST_P(HostileMapFiles, AreJudgedAsTheIndexSays) {
  HYPERMAP_REQUIRE_SHARED_DATA("hostile/INDEX.md");
  const auto& [folder, kind] = GetParam();
  const auto files = test::hostile_files(folder);
  ASSERT_FALSE(files.empty());
  for (const test::HostileFile& file : files) {
    const FileCheckResult result = check_file(file.path, {.as = kind});
    if (file.must_load) {
      EXPECT_LE(result.exit_code(), 1) << file.path << said_by(result);
    } else {
      EXPECT_EQ(result.exit_code(), 2) << file.path << said_by(result);
      EXPECT_THAT(said_by(result), HasSubstr(file.path.filename().string()));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(ByContent,
                         HostileMapFiles,
                         ::testing::Values(Section{"yaml", std::nullopt},
                                           Section{"wkt", std::nullopt}));
INSTANTIATE_TEST_SUITE_P(InsistedOn,
                         HostileMapFiles,
                         ::testing::Values(Section{"wkt", FileKind::kSemantic}));

TEST(MapFilesCheck, AMapIsJudgedWithItsImage) {
  const test::TempDir dir;
  std::ofstream(dir / "map.yaml") << "image: a.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n"
                                     "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  const FileCheckResult alone = check_file(dir / "map.yaml");
  EXPECT_EQ(alone.exit_code(), 1);
  EXPECT_THAT(said_by(alone), HasSubstr("a.pgm, which is not there"));
  EXPECT_EQ(check_file(dir / "map.yaml", {.as = std::nullopt, .strict = true}).exit_code(), 2);
  std::ofstream(dir / "a.pgm") << *encode_pgm(Image<std::uint8_t>(2, 3, 254));
  const FileCheckResult whole = check_file(dir / "map.yaml");
  EXPECT_EQ(whole.exit_code(), 0) << said_by(whole);
  EXPECT_EQ(whole.summary, "map of 2 x 3 cells");
  std::ofstream(dir / "a.pgm") << "P5 2 3 255\nabc";
  EXPECT_EQ(check_file(dir / "map.yaml").exit_code(), 2);
}

TEST(MapFilesCheck, AnObjectFarFromAllPlacesIsAFinding) {
  // [smap] 3.5.1, rule 2: nearer than V_d, 1 m.
  const test::TempDir dir;
  MapArchive archive;
  archive.topological_map.emplace();
  archive.topological_map->observe({0, 0, 1});
  Object object;
  object.centroid_in_map = {0.5, 0, 1};
  archive.objects.add(object);
  ASSERT_TRUE(save_archive(archive, dir / "a.hmap"));
  EXPECT_EQ(check_file(dir / "a.hmap").exit_code(), 0);
  object.centroid_in_map = {1, 0, 1};
  archive.objects.add(object);
  ASSERT_TRUE(save_archive(archive, dir / "b.hmap"));
  const FileCheckResult result = check_file(dir / "b.hmap");
  EXPECT_EQ(result.exit_code(), 1);
  EXPECT_THAT(said_by(result), HasSubstr("object 2 is not nearer than V_d to a vertex"));
}

TEST(MapFilesCheck, ASemanticLayerIsCounted) {
  const test::TempDir dir;
  std::ofstream(dir / "semantic") << "- name: a\n  shape: POLYGON((0 0,1 0,1 1,0 0))\n";
  EXPECT_EQ(check_file(dir / "semantic").summary, "1 object(s)");
  EXPECT_EQ(check_file(dir / "semantic").exit_code(), 0);
}

}  // namespace
}  // namespace hypermap
