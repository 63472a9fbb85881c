// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/archive_repair.hpp"

#include "archive_edits.hpp"
#include "hypermap/io/archive/archive_layers.hpp"
#include "sample_archive.hpp"
#include "support/sanitized.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>

namespace hypermap {
namespace {

using test::changed;
using test::member_of;
using test::replaced;
using ::testing::HasSubstr;

const std::string& whole_archive() {
  static const std::string kBytes = write_archive(test::sample_archive()).value();
  return kBytes;
}

class ArchiveRepair : public ::testing::Test {
 protected:
  [[nodiscard]] Result<RepairedArchive> repaired(const std::string& bytes) const {
    const auto path = folder_ / "a.hmap";
    std::ofstream(path, std::ios::binary) << bytes;
    auto result = repair_archive(path);
    if (result) {
      // Whatever is left can be saved and loaded.
      const auto saved = write_archive(result->map);
      EXPECT_TRUE(saved) << to_string(saved.error());
      if (saved) {
        const auto loaded = parse_archive(*saved, test::kArchiveSource);
        EXPECT_TRUE(loaded) << to_string(loaded.error());
      }
    }
    return result;
  }

  test::TempDir folder_;
};

/// "lost: why" of a part or member; "no note".
std::string note_of(const RepairedArchive& repaired, const std::string& subject) {
  const auto found = std::ranges::find(repaired.notes, subject, &RepairNote::subject);
  if (found == repaired.notes.end()) return "no note";
  return std::string(name_of(found->outcome)) + ": " + found->what;
}

TEST_F(ArchiveRepair, ChangesNothingOfASoundArchive) {
  const auto result = repaired(whole_archive()).value();
  EXPECT_EQ(result.map, test::sample_archive());
  EXPECT_TRUE(result.is_unchanged());
  EXPECT_EQ(note_of(result, "layer occupancy"), "kept: ");
  EXPECT_EQ(note_of(result, "member octree.ot"), "kept: ");
}

TEST_F(ArchiveRepair, LeavesOutWhatCannotBeReadAndKeepsTheRest) {
  const auto result = repaired(changed(whole_archive(), {{"occupancy.png", ""}})).value();
  EXPECT_THAT(note_of(result, "layer occupancy"), HasSubstr("lost: occupancy.yaml: image: names"));
  EXPECT_EQ(result.lost,
            std::vector<LostPart>({{.name = "occupancy", .class_name = "OccupancyGridLayer"}}));
  EXPECT_EQ(result.map.hypermap.find("occupancy"), nullptr);
  EXPECT_NE(result.map.hypermap.find("semantic"), nullptr);
  EXPECT_EQ(result.map.octree, test::sample_archive().octree);
  EXPECT_EQ(result.map.objects, test::sample_archive().objects);
  EXPECT_TRUE(result.map.opaque_files.empty()) << "half a layer is none";
}

TEST_F(ArchiveRepair, FindsMembersThoughTheDirectoryIsCut) {
  const std::string& bytes = whole_archive();
  const auto result = repaired(bytes.substr(0, bytes.find("PK\x01\x02") + 10)).value();
  EXPECT_EQ(result.map, test::sample_archive());
  EXPECT_THAT(note_of(result, "directory"), HasSubstr("rebuilt: "));
}

TEST_F(ArchiveRepair, MendsThresholdsAndModeOfAGrid) {
  const std::string yaml = member_of(whole_archive(), "occupancy.yaml");
  const auto with_line = [&](const std::string& key, const std::string& line) {
    const std::size_t begin = yaml.find(key + ":");
    const std::size_t end = yaml.find('\n', begin);
    return yaml.substr(0, begin) + line + yaml.substr(end + 1);
  };
  const auto grid = test::sample_grid(3);
  for (const auto& [key, line, what] :
       {std::tuple{"occupied_thresh", "occupied_thresh: .nan\n", "0.65 and 0.196"},
        std::tuple{"free_thresh", "", "0.65 and 0.196"},
        std::tuple{"negate", "negate: maybe\n", "it is now 0"},
        std::tuple{"image", "image: nothing.png\n", "it is now occupancy.png"}}) {
    SCOPED_TRACE(key);
    const auto result =
        repaired(changed(whole_archive(), {{"occupancy.yaml", with_line(key, line)}})).value();
    EXPECT_THAT(note_of(result, "layer occupancy"), HasSubstr("repaired: "));
    EXPECT_THAT(note_of(result, "layer occupancy"), HasSubstr(what));
    const auto* layer = result.map.hypermap.find_as<OccupancyLayer>("occupancy");
    ASSERT_NE(layer, nullptr);
    EXPECT_EQ(layer->grid.geometry().cols, grid.geometry().cols);
  }
  // 1 and 0 the other way round are exchanged, so that all cells are what they were.
  const std::string swapped = replaced(replaced(yaml, "occupied_thresh: 1", "occupied_thresh: 0"),
                                       "free_thresh: 0",
                                       "free_thresh: 1");
  const auto result = repaired(changed(whole_archive(), {{"occupancy.yaml", swapped}})).value();
  EXPECT_THAT(note_of(result, "layer occupancy"), HasSubstr("exchanged"));
  EXPECT_EQ(result.map.hypermap.find_as<OccupancyLayer>("occupancy")->grid, grid);
}

TEST_F(ArchiveRepair, NeverGuessesWhereAGridLies) {
  const std::string yaml = member_of(whole_archive(), "occupancy.yaml");
  for (const char* key : {"resolution: ", "origin: "}) {
    const auto result =
        repaired(changed(whole_archive(), {{"occupancy.yaml", replaced(yaml, key, "was_")}}));
    EXPECT_THAT(note_of(result.value(), "layer occupancy"), HasSubstr("lost: ")) << key;
  }
}

TEST_F(ArchiveRepair, LeavesOutWrongShapesAndClosesOpenRings) {
  const std::string semantic =
      "- {name: open, shape: \"POLYGON ((0 0, 1 0, 1 1))\"}\n"
      "- {name: bow-tie, shape: \"POLYGON ((0 0, 1 1, 1 0, 0 1, 0 0))\"}\n"
      "- {name: fine, shape: \"POLYGON ((2 0, 3 0, 3 1, 2 0))\"}\n";
  const auto result = repaired(changed(whole_archive(), {{"semantic", semantic}})).value();
  EXPECT_THAT(note_of(result, "layer semantic"), HasSubstr("repaired: "));
  EXPECT_THAT(note_of(result, "layer semantic"), HasSubstr("bow-tie"));
  const auto* layer = result.map.hypermap.find_as<SemanticLayer>("semantic");
  ASSERT_NE(layer, nullptr);
  ASSERT_EQ(layer->objects().size(), 2U);
  EXPECT_EQ(layer->objects()[0].name, "open");
  EXPECT_EQ(layer->objects()[1].name, "fine");
}

TEST_F(ArchiveRepair, MakesALostConfigurationAnew) {
  const auto result = repaired(changed(whole_archive(), {{"hmap_config.yaml", ""}})).value();
  EXPECT_TRUE(result.is_config_guessed);
  EXPECT_THAT(note_of(result, "member hmap_config.yaml"), HasSubstr("rebuilt: "));
  const MapArchive sample = test::sample_archive();
  EXPECT_EQ(result.map.octree, sample.octree);
  EXPECT_EQ(result.map.objects, sample.objects);
  EXPECT_EQ(result.map.classes, sample.classes);
  EXPECT_EQ(result.map.provenance, sample.provenance);
  ASSERT_NE(result.map.hypermap.find_as<OccupancyLayer>("occupancy"), nullptr);
  ASSERT_NE(result.map.hypermap.find_as<SemanticLayer>("semantic"), nullptr);
  EXPECT_EQ(result.map.hypermap.find_as<SemanticLayer>("semantic")->objects().size(), 2U);
  EXPECT_EQ(result.map.hypermap.find("semantic")->info.frame_id, "map");
}

TEST_F(ArchiveRepair, NamesClassesThatHaveLostTheirs) {
  const auto result =
      repaired(changed(whole_archive(), {{"classes.yaml", "- chair\n- 7: x"}})).value();
  EXPECT_THAT(note_of(result, "extension classes"), HasSubstr("lost: "));
  ASSERT_EQ(result.map.classes.size(), 3U);
  EXPECT_EQ(result.map.classes.name(ClassId{0}), "class_0");
  EXPECT_EQ(result.map.objects, test::sample_archive().objects);
}

TEST_F(ArchiveRepair, VoxelsForgetObjectsThatAreLost) {
  const auto result = repaired(changed(whole_archive(), {{"objects.jsonl", "damaged"}})).value();
  EXPECT_THAT(note_of(result, "extension objects"), HasSubstr("lost: "));
  EXPECT_TRUE(result.map.objects.empty());
  EXPECT_TRUE(result.map.octree);
}

TEST_F(ArchiveRepair, RefusesWhereNothingIsLeftAndNewerVersions) {
  EXPECT_EQ(repaired("no archive").error().code, ErrorCode::kMalformedFile);
  EXPECT_EQ(repaired("").error().code, ErrorCode::kMalformedFile);
  const auto empty = repaired(test::zip_of({{"notes.txt", "nothing of a map"}}));
  EXPECT_THAT(to_string(empty.error()), HasSubstr("a.hmap: no layer, octree or object is left"));
  const std::string config = member_of(whole_archive(), "hmap_config.yaml");
  const auto newer = repaired(
      changed(whole_archive(),
              {{"hmap_config.yaml", replaced(config, "format_version: 1", "format_version: 99")}}));
  EXPECT_EQ(newer.error().code, ErrorCode::kUnsupported);
}

TEST_F(ArchiveRepair, LoadsOrRefusesWhereverTheFileIsCutOrChanged) {
  const std::string& bytes = whole_archive();
  const std::size_t step = test::kSanitized ? 211 : 29;
  for (std::size_t size = 0; size < bytes.size(); size += step) {
    SCOPED_TRACE(size);
    const auto result = repaired(bytes.substr(0, size));
    if (!result) {
      EXPECT_EQ(result.error().code, ErrorCode::kMalformedFile);
    }
  }
  for (std::size_t at = 0; at < bytes.size(); at += step) {
    SCOPED_TRACE(at);
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x20);
    EXPECT_TRUE(repaired(damaged)) << "one byte does not end a map";
  }
}

}  // namespace
}  // namespace hypermap
