// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/import_job.hpp"

#include "hypermap/io/archive/map_sessions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

constexpr const char* kGridYaml =
    "image: grid.pgm\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n";
constexpr const char* kShapesYaml =
    "- {name: table, shape: \"POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))\"}\n";

class ImportFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder());
    write("grid.pgm", std::string("P5 2 1 255\n") + '\0' + '\xfe');
    write("grid.yaml", kGridYaml);
    write("things.yaml", kShapesYaml);
  }
  void TearDown() override { std::filesystem::remove_all(folder()); }

  [[nodiscard]] static std::filesystem::path folder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    return std::filesystem::path(testing::TempDir()) / (std::string("import_") + test->name());
  }
  static std::filesystem::path write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder() / name, std::ios::binary) << bytes;
    return folder() / name;
  }
  [[nodiscard]] static ImportedFile file(const std::string& name) {
    return {.path = folder() / name};
  }
};

std::vector<std::string> layer_names(const MapArchive& archive) {
  std::vector<std::string> names;
  for (const Layer& layer : archive.hypermap.layers()) {
    names.push_back(layer.info.name + " in " + layer.info.frame_id);
  }
  return names;
}

/// Of each imported file: its name, the layers that it became, its frame.
std::vector<std::string> import_texts(const MapArchive& archive) {
  std::vector<std::string> texts;
  for (const Provenance& one : archive.provenance) {
    if (!is_import(one)) continue;
    const ValueTree& import = *one.options.find("import");
    std::string text = one.input + ":";
    for (const ValueTree& layer : import.find("layers")->items) text += " " + layer.text;
    texts.push_back(text + " in " + import.find("frame")->text);
  }
  return texts;
}

std::string why_refused(const ImportJob& job) {
  const auto imported = run_import(job);
  return imported ? std::string("imported") : to_string(imported.error());
}

TEST_F(ImportFiles, BecomeLayersOfTheirNamesAndFrames) {
  ImportedFile grid = file("grid.yaml");
  grid.name = "ground";
  grid.frame_id = "yard";
  const auto imported =
      run_import({.files = {grid, file("things.yaml")},
                  .transforms = {{.frame_id = "map", .child_frame_id = "yard", .x_m = 3.0}}})
          .value();
  EXPECT_THAT(layer_names(imported.value), ElementsAre("ground in yard", "things in map"));
  const auto* occupancy = imported.value.hypermap.find_as<OccupancyLayer>("ground");
  ASSERT_NE(occupancy, nullptr);
  EXPECT_EQ(imported.value.hypermap.frames().to_from("map", "yard").value().translation().x(), 3.0);
  ASSERT_EQ(imported.value.provenance.size(), 2U);
  EXPECT_THAT(imported.value.provenance.front().input_hash, HasSubstr("xxh3-128:"));
  EXPECT_TRUE(imported.findings.empty());
}

TEST_F(ImportFiles, OfOneArchiveAreThatArchive) {
  const auto first = run_import({.files = {file("grid.yaml"), file("things.yaml")}}).value();
  ASSERT_TRUE(save_archive(first.value, folder() / "a.hmap"));
  const auto again = run_import({.files = {file("a.hmap")}}).value();
  EXPECT_TRUE(again.value == load_archive(folder() / "a.hmap").value().value);
}

TEST_F(ImportFiles, EachTellsWhichLayersItBecame) {
  const auto flat = run_import({.files = {file("grid.yaml"), file("things.yaml")}}).value();
  ASSERT_TRUE(save_archive(flat.value, folder() / "a.hmap"));
  write("bare.yaml",
        "layers:\n- {class: SemanticLayer, name: chairs, frame_id: map, load_file: true, "
        "file: things.yaml}\n");
  MapArchive solid;
  solid.octree = SemanticOctree::create({}).value();
  solid.provenance.push_back(
      {.tool = "hypermap", .input = "kitchen", .input_hash = "x", .map_from_input = {}});
  ASSERT_TRUE(save_archive(solid, folder() / "solid.hmap"));
  ImportedFile upper = file("a.hmap");
  upper.name = "upper";
  upper.frame_id = "second";
  EXPECT_THAT(import_texts(run_import({.files = {upper}}).value().value),
              UnorderedElementsAre("a.hmap: upper_grid upper_things in second",
                                   "grid.yaml: grid in map",
                                   "things.yaml: things in map"));
  const auto all = run_import({.files = {upper, file("bare.yaml"), file("solid.hmap")}}).value();
  ASSERT_TRUE(save_archive(all.value, folder() / "all.hmap"));
  const auto loaded = load_archive(folder() / "all.hmap").value().value;
  EXPECT_THAT(import_texts(loaded),
              UnorderedElementsAre("a.hmap: upper_grid upper_things in second",
                                   "grid.yaml: grid in map",
                                   "things.yaml: things in map",
                                   "bare.yaml: chairs in map",
                                   "solid.hmap: octree in map"));
  EXPECT_EQ(loaded.provenance.back().input, "kitchen") << "runs stay the newest";
  // The run is the only session, and as before all frames are its own.
  const auto sessions = sessions_of(loaded.provenance);
  ASSERT_EQ(sessions.size(), 1U);
  EXPECT_EQ(sessions[0].input, "kitchen");
  EXPECT_EQ(sessions[0].number, 1U);
  EXPECT_EQ(sessions[0].frames, FrameRange{});
}

TEST_F(ImportFiles, OfAConfigurationHaveTheHashOfWhatItNames) {
  const std::string entry = ", frame_id: map, load_file: true, file: ";
  write("bare.yaml",
        "layers:\n- {class: SemanticLayer, name: a" + entry +
            "things.yaml}\n- {class: OccupancyGridLayer, name: b" + entry + "grid}\n");
  const auto hash = [] {
    return run_import({.files = {file("bare.yaml")}}).value().value.provenance.front().input_hash;
  };
  const std::string before = hash();
  EXPECT_EQ(hash(), before);
  write("things.yaml", std::string(kShapesYaml) + "# changed\n");
  const std::string other_shapes = hash();
  EXPECT_NE(other_shapes, before);
  write("grid.pgm", std::string("P5 2 1 255\n") + '\0' + '\0');
  EXPECT_NE(hash(), other_shapes);
}

TEST_F(ImportFiles, OfArchivesUnderANameKeepTheirLayersApart) {
  const auto first = run_import({.files = {file("grid.yaml"), file("things.yaml")}}).value();
  ASSERT_TRUE(save_archive(first.value, folder() / "a.hmap"));
  ImportedFile other = file("a.hmap");
  other.name = "other";
  other.frame_id = "yard";
  const auto both = run_import({.files = {file("a.hmap"), other}}).value();
  EXPECT_THAT(
      layer_names(both.value),
      ElementsAre("grid in map", "things in map", "other_grid in yard", "other_things in yard"));
  ASSERT_TRUE(save_archive(both.value, folder() / "both.hmap"));  // nothing of one name
}

TEST_F(ImportFiles, WithVoxelsOrObjectsAreOneMapAtMost) {
  MapArchive solid;
  solid.octree = SemanticOctree::create({}).value();
  ASSERT_TRUE(save_archive(solid, folder() / "solid.hmap"));
  const auto imported = run_import({.files = {file("grid.yaml"), file("solid.hmap")}}).value();
  EXPECT_TRUE(imported.value.octree.has_value());
  EXPECT_THAT(layer_names(imported.value), ElementsAre("grid in map"));
  EXPECT_THAT(why_refused({.files = {file("solid.hmap"), file("solid.hmap")}}),
              HasSubstr("only one map can bring them"));
  ImportedFile named = file("solid.hmap");
  named.name = "other";
  EXPECT_THAT(why_refused({.files = {named}}), HasSubstr("keeps its names and its frame"));
}

TEST_F(ImportFiles, OfAMapHaveTheHashOfBothItsFiles) {
  const auto hash = [] {
    return run_import({.files = {file("grid.yaml")}}).value().value.provenance.front().input_hash;
  };
  const std::string before = hash();
  EXPECT_EQ(hash(), before);
  write("grid.pgm", std::string("P5 2 1 255\n") + '\0' + '\0');
  EXPECT_NE(hash(), before);
}

TEST_F(ImportFiles, TogetherAreWithinTheLimits) {
  ImportedFile other = file("grid.yaml");
  other.name = "other";
  ImportJob job{.files = {file("grid.yaml"), other}};
  job.limits.sums.max_pixels = 4;  // two images of two pixels
  EXPECT_EQ(why_refused(job), "imported");
  job.limits.sums.max_pixels = 3;
  EXPECT_THAT(why_refused(job), HasSubstr("grid.pgm: "));
}

TEST_F(ImportFiles, ThatAreNoPartOfAMapAreRefusedByTheirKind) {
  EXPECT_THAT(why_refused({.files = {file("grid.pgm")}}),
              HasSubstr("grid.pgm: is a file of kind image, which is no part of a map"));
  EXPECT_THAT(why_refused({.files = {file("grid.yaml"), file("grid.yaml")}}),
              HasSubstr("has a layer grid, as another file has: NAME=FILE"));
  EXPECT_THAT(why_refused({.files = {file("none.yaml")}}), HasSubstr("none.yaml"));
  EXPECT_THAT(why_refused({.files = {}}), HasSubstr("no files"));
  EXPECT_THAT(why_refused({.files = {file("grid.yaml")},
                           .transforms = {{.frame_id = "map", .child_frame_id = "map"}}}),
              HasSubstr("map"));
}

}  // namespace
}  // namespace hypermap
