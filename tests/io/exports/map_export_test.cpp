// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/exports/map_export.hpp"

#include "hypermap/io/archive/map_server.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "io/archive/sample_archive.hpp"
#include "io/codec/system_faults.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

const std::string kActive = "../../etc/passwd\n- evil: true";

/// Images are named after their content: hashes are shown as <hash>.
std::set<std::string> names_in(const std::filesystem::path& folder) {
  const std::regex hash("-[0-9a-f]{16}\\.pg([mw])$");
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    names.insert(std::regex_replace(name, hash, "-<hash>.pg$1"));
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
                                   "grids/______etc_passwd_-_evil__true-<hash>.pgm",
                                   "grids/______etc_passwd_-_evil__true-<hash>.pgw",
                                   "grids/______etc_passwd_-_evil__true.yaml",
                                   "grids/__-<hash>.pgm",
                                   "grids/__-<hash>.pgw",
                                   "grids/__.yaml",
                                   "grids/café-<hash>.pgm",
                                   "grids/café-<hash>.pgw",
                                   "grids/café.yaml"));
}

TEST(ExportClassGrids, NoGridTakesTheFileOfAnother) {
  const test::TempDir dir;
  ASSERT_TRUE(export_grids(archive_with_grids_of({"a/b", "a_b", "a:b"}), dir / "grids"));
  EXPECT_THAT(names_in(dir / "grids"),
              UnorderedElementsAre("a_b-2-<hash>.pgm",
                                   "a_b-2-<hash>.pgw",
                                   "a_b-2.yaml",
                                   "a_b-3-<hash>.pgm",
                                   "a_b-3-<hash>.pgw",
                                   "a_b-3.yaml",
                                   "a_b-<hash>.pgm",
                                   "a_b-<hash>.pgw",
                                   "a_b.yaml"));
}

TEST(ExportClassGrids, ALongNameIsCutBetweenCharacters) {
  std::string name;
  for (int i = 0; i < 128; ++i) name += "é";  // 256 bytes
  const test::TempDir dir;
  ASSERT_TRUE(export_grids(archive_with_grids_of({name}), dir / "grids"));
  EXPECT_THAT(names_in(dir / "grids"),
              UnorderedElementsAre(name.substr(0, 200) + "-<hash>.pgm",
                                   name.substr(0, 200) + "-<hash>.pgw",
                                   name.substr(0, 200) + ".yaml"));
}

TEST(ExportClassGrids, WithoutClassGridsTheyComeFromFootprints) {
  MapArchive archive = test::sample_archive();
  archive.class_grids.clear();
  const test::TempDir dir;
  ASSERT_TRUE(export_grids(archive, dir / "grids"));
  EXPECT_THAT(names_in(dir / "grids"),
              UnorderedElementsAre("sink-<hash>.pgm",
                                   "sink-<hash>.pgw",
                                   "sink.yaml",
                                   "cup-<hash>.pgm",
                                   "cup-<hash>.pgw",
                                   "cup.yaml"));
  ExportRequest request;
  request.format = ExportFormat::kClassGrids;
  request.output = dir / "one";
  request.classes = {"Sink"};
  EXPECT_EQ(export_map(archive, request).value().size(), 3U);
  request.classes = {"chair"};
  EXPECT_THAT(export_map(archive, request).value(), IsEmpty()) << "known, and not there";
  request.classes = {"sinks"};
  EXPECT_THAT(export_map(archive, request).error().what, HasSubstr("sink"));
}

/// A map of one cell.
MapArchive map_of(std::int8_t occupancy) {
  GridGeometry geometry;
  geometry.cols = 1;
  geometry.rows = 1;
  geometry.resolution_m = 0.05;
  MapArchive archive;
  EXPECT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "map", .file = "map"},
       .content = OccupancyLayer(OccupancyGrid::create(geometry, occupancy).value())}));
  return archive;
}

/// What map_server finds there: the occupancy of the one cell, or the error.
std::string loaded_cell(const std::filesystem::path& yaml) {
  const auto map = read_map(yaml);
  return map ? std::to_string(map->value.grid.at({0, 0})) : to_string(map.error());
}

TEST(ExportRosMap, WithoutObjectsTheFloorUnderThemIsFree) {
  MapArchive archive = map_of(100);
  SemanticObject rug = test::sample_shape(1, "rug", 0.0);
  rug.parts = {make_polygon({{0, 0}, {0.05, 0}, {0.05, 0.05}, {0, 0.05}}).value()};
  ASSERT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "semantic"}, .content = SemanticLayer::create({rug}).value()}));
  const test::TempDir dir;
  ExportRequest request;
  request.format = ExportFormat::kRosMap;
  request.output = dir / "floor";
  request.without_objects = true;
  ASSERT_TRUE(export_map(archive, request));
  EXPECT_EQ(loaded_cell(dir / "floor.yaml"), "0");
  request.format = ExportFormat::kClassGrids;
  EXPECT_EQ(export_map(archive, request).error().field, "--without-objects");
}

TEST(ExportRosMap, IsAYamlAndAnImageNamedAfterItsContent) {
  const test::TempDir dir;
  const auto written = exported(map_of(100), ExportFormat::kRosMap, dir / "lab.yaml");
  ASSERT_TRUE(written) << to_string(written.error());
  EXPECT_THAT(names_in(dir.path()),
              UnorderedElementsAre("lab.yaml", "lab-<hash>.pgm", "lab-<hash>.pgw"));
  EXPECT_EQ(written->size(), 3U);
  for (const auto& path : *written) EXPECT_TRUE(std::filesystem::exists(path)) << path;
  EXPECT_EQ(loaded_cell(dir / "lab.yaml"), "100");
}

TEST(ExportRosMap, AnImageThatIsNotTheOneItsNameSaysIsNamed) {
  const test::TempDir dir;
  const auto written = exported(map_of(100), ExportFormat::kRosMap, dir / "lab");
  ASSERT_TRUE(written);
  EXPECT_THAT(read_map(dir / "lab.yaml")->findings, IsEmpty());
  const std::filesystem::path& image_path = written->at(1);
  std::fstream image(image_path, std::ios::in | std::ios::out | std::ios::binary);
  image.seekp(-1, std::ios::end);
  image.put('\xfe');
  image.close();
  const auto map = read_map(dir / "lab.yaml");
  ASSERT_TRUE(map) << to_string(map.error());
  ASSERT_EQ(map->findings.size(), 1U);
  EXPECT_EQ(map->findings[0].error.file, image_path.string());
  EXPECT_THAT(map->findings[0].error.what, HasSubstr("is not the image that its name says"));
}

TEST(ExportRosMap, TheImageThatIsNoLongerNamedGoesOthersStay) {
  const test::TempDir dir;
  std::ofstream(dir / "lab.pgm") << "of an earlier version, or of somebody";
  std::ofstream(dir / "lab-0123456789abcdef.pgm") << "of another YAML";
  const auto old = exported(map_of(100), ExportFormat::kRosMap, dir / "lab");
  ASSERT_TRUE(old);
  const auto same = exported(map_of(100), ExportFormat::kRosMap, dir / "lab");
  EXPECT_EQ(old.value(), same.value());
  EXPECT_EQ(loaded_cell(dir / "lab.yaml"), "100");
  const auto next = exported(map_of(0), ExportFormat::kRosMap, dir / "lab");
  ASSERT_TRUE(next);
  EXPECT_EQ(loaded_cell(dir / "lab.yaml"), "0");
  EXPECT_FALSE(std::filesystem::exists(old->at(1)));
  EXPECT_FALSE(std::filesystem::exists(old->at(2)));
  EXPECT_TRUE(std::filesystem::exists(dir / "lab.pgm"));
  EXPECT_TRUE(std::filesystem::exists(dir / "lab-0123456789abcdef.pgm"));
}

TEST(ExportRosMap, AnImageThatSomebodysYamlNamesStays) {
  const test::TempDir dir;
  std::ofstream(dir / "holiday.pgm") << "precious";
  std::ofstream(dir / "lab.yaml") << "image: holiday.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n"
                                     "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  ASSERT_TRUE(exported(map_of(0), ExportFormat::kRosMap, dir / "lab"));
  EXPECT_TRUE(std::filesystem::exists(dir / "holiday.pgm"));
}

TEST(ExportRosMap, WhicheverCallFailsTheYamlFindsItsOwnImage) {
  for (int failing_call = 1;; ++failing_call) {
    const test::TempDir dir;
    ASSERT_TRUE(exported(map_of(100), ExportFormat::kRosMap, dir / "lab"));
    int num_calls = 0;
    bool is_exported = false;
    {
      const test::SystemFaults faults(
          [&](std::string_view, int) { return ++num_calls == failing_call ? ENOSPC : 0; });
      is_exported = exported(map_of(0), ExportFormat::kRosMap, dir / "lab").has_value();
    }
    if (num_calls < failing_call) break;  // more than there are
    const std::string found = loaded_cell(dir / "lab.yaml");
    if (is_exported) {
      EXPECT_EQ(found, "0");
    } else {
      EXPECT_THAT(found, ::testing::AnyOf("0", "100")) << failing_call;
    }
  }
}

TEST(ExportRosMap, AKillBetweenTheFilesLeavesTheOldPair) {
  const test::TempDir dir;
  ASSERT_TRUE(exported(map_of(100), ExportFormat::kRosMap, dir / "lab"));
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    int num_renames = 0;
    const test::SystemFaults faults([&](std::string_view call, int) {
      return call == "rename" && ++num_renames == 2 ? ::kill(::getpid(), SIGKILL) : 0;
    });
    static_cast<void>(exported(map_of(0), ExportFormat::kRosMap, dir / "lab"));
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(loaded_cell(dir / "lab.yaml"), "100");
}

// 3 x 2 cells of 0.5 m, turned by 90 degrees: columns run along +y, rows along -x. The first pixel
// is cell (0, 1): from the corner (10, 20) half a cell up y, one and a half down x.
TEST(ExportRosMap, AWorldFileLeadsFromPixelsToTheMap) {
  MapArchive archive;
  const GridGeometry geometry{.resolution_m = 0.5,
                              .origin = {10.0, 20.0},
                              .yaw_rad = std::numbers::pi / 2.0,
                              .cols = 3,
                              .rows = 2};
  ASSERT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "map", .file = "map"},
       .content = OccupancyLayer(OccupancyGrid::create(geometry, {0, 0, 0, 0, 0, 100}).value())}));
  const test::TempDir dir;
  const auto written = export_map(archive,
                                  {.format = ExportFormat::kRosMap,
                                   .output = dir / "lab",
                                   .layer = {},
                                   .classes = {},
                                   .keep_rotation = true});
  ASSERT_TRUE(written) << to_string(written.error());
  std::ifstream file(written->at(2));
  std::vector<double> numbers;
  for (double number = 0.0; file >> number;) numbers.push_back(number);
  ASSERT_EQ(numbers.size(), 6U);
  const std::vector<double> expected{0.0, 0.5, 0.5, 0.0, 9.25, 20.25};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(numbers[i], expected[i], 1e-12) << i;
}

}  // namespace
}  // namespace hypermap
