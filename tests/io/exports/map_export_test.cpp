// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/exports/map_export.hpp"

#include "hypermap/io/codec/byte_source.hpp"
#include "io/archive/sample_archive.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>

#include <set>

namespace hypermap {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

const std::string kActive = "../../etc/passwd\n- evil: true";

std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    names.insert(entry.path().lexically_relative(folder).string());
  }
  return names;
}

MapArchive archive_with_grids_of(const std::vector<std::string>& class_names) {
  MapArchive archive;
  for (const std::string& name : class_names) {
    archive.class_grids.push_back({.class_name = name, .grid = test::sample_grid(50)});
  }
  return archive;
}

Result<std::vector<std::filesystem::path>> exported(const MapArchive& archive,
                                                    ExportFormat format,
                                                    const std::filesystem::path& output) {
  ExportRequest request;
  request.format = format;
  request.output = output;
  return export_map(archive, request);
}

Result<std::vector<std::filesystem::path>> export_grids(const MapArchive& archive,
                                                        const std::filesystem::path& folder) {
  return exported(archive, ExportFormat::kClassGrids, folder);
}

TEST(ExportClassGrids, AClassNameLeadsNowhere) {
  const test::TempDir dir;
  const auto written = export_grids(archive_with_grids_of({kActive, "..", "café"}), dir / "grids");
  ASSERT_TRUE(written) << to_string(written.error());
  EXPECT_THAT(names_in(dir.path()),
              UnorderedElementsAre("grids",
                                   "grids/______etc_passwd_-_evil__true.pgm",
                                   "grids/______etc_passwd_-_evil__true.yaml",
                                   "grids/__.pgm",
                                   "grids/__.yaml",
                                   "grids/café.pgm",
                                   "grids/café.yaml"));
}

TEST(ExportClassGrids, NoGridTakesTheFileOfAnother) {
  const test::TempDir dir;
  ASSERT_TRUE(export_grids(archive_with_grids_of({"a/b", "a_b", "a:b"}), dir / "grids"));
  EXPECT_THAT(names_in(dir / "grids"),
              UnorderedElementsAre(
                  "a_b-2.pgm", "a_b-2.yaml", "a_b-3.pgm", "a_b-3.yaml", "a_b.pgm", "a_b.yaml"));
}

TEST(ExportClassGrids, ALongNameIsCutBetweenCharacters) {
  std::string name;
  for (int i = 0; i < 128; ++i) name += "é";  // 256 bytes
  const test::TempDir dir;
  ASSERT_TRUE(export_grids(archive_with_grids_of({name}), dir / "grids"));
  EXPECT_THAT(names_in(dir / "grids"),
              UnorderedElementsAre(name.substr(0, 200) + ".pgm", name.substr(0, 200) + ".yaml"));
}

TEST(ExportPly, AClassNameStaysInItsComment) {
  MapArchive archive;
  ASSERT_TRUE(archive.classes.add("chair\nend_header"));
  archive.octree = test::sample_octree();
  const test::TempDir dir;
  ASSERT_TRUE(exported(archive, ExportFormat::kPly, dir / "a.ply"));
  const std::string ply = read_file(dir / "a.ply", 1U << 20U).value();
  EXPECT_THAT(ply, HasSubstr("comment label 0 chair\\x0aend_header\n"));
  EXPECT_THAT(ply, Not(HasSubstr("chair\nend_header")));
}

TEST(ExportGeojson, ANameIsOneText) {
  MapArchive archive = test::sample_archive();
  ASSERT_TRUE(archive.hypermap.set_content(
      "semantic", SemanticLayer::create({test::sample_shape(0, kActive, 0.0)}).value()));
  const test::TempDir dir;
  const auto path = dir / "a.local.geojson";
  ASSERT_TRUE(exported(archive, ExportFormat::kGeojson, path));
  EXPECT_THAT(read_file(path, 1U << 20U).value(),
              HasSubstr(R"("name": "../../etc/passwd\n- evil: true")"));
}

}  // namespace
}  // namespace hypermap
