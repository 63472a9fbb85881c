// SPDX-License-Identifier: BSD-3-Clause
// Limits on an archive as a whole: many small things, each within its own limit.
#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/semantic_yaml.hpp"
#include "hypermap/io/codec/image_file.hpp"
#include "hypermap/io/codec/pgm_image.hpp"
#include "io/archive/archive_edits.hpp"
#include "io/archive/sample_archive.hpp"
#include "projection/layers/layer_contract.hpp"
#include "support/temp_dir.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>

namespace hypermap {
namespace {

using test::Files;
using test::kArchiveSource;
using test::zip_of;
using testing::EndsWith;
using testing::HasSubstr;

constexpr std::size_t kGridPixels = 48;  // 8 x 6

/// Layers of 48 pixels each.
std::string archive_of_grids(int count) {
  Files files{{"hmap_config.yaml", "layers:\n"}};
  for (int i = 0; i < count; ++i) {
    const std::string name = "grid" + std::to_string(i);
    files.front().second +=
        "  - {class: OccupancyGridLayer, name: " + name + ", frame_id: map, load_file: true}\n";
    files.emplace_back(name + ".yaml",
                       "image: " + name +
                           ".pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
                           "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
    files.emplace_back(name + ".pgm", encode_pgm(Image<std::uint8_t>(8, 6, 254)).value());
  }
  return zip_of(files);
}

/// A star polygon {points/step}: it crosses itself points * (step - 1) times.
std::string star_text(int points, int step) {
  std::string text = "POLYGON((";
  for (int i = 0; i <= points; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i * step % points) / points;
    text += (i > 0 ? "," : "") + std::to_string(10.0 * std::cos(angle)) + " " +
            std::to_string(10.0 * std::sin(angle));
  }
  return text + "))";
}

/// A pentagram has 10 pairs of edges and 5 crossings of 500 tests each.
constexpr std::uint64_t kStarTests = 10 + 5 * 500;

std::string archive_of_stars(int count) {
  std::string shapes;
  for (int i = 0; i < count; ++i)
    shapes += "- {name: star" + std::to_string(i) + ", shape: \"" + star_text(5, 2) + "\"}\n";
  return zip_of(
      {{"hmap_config.yaml",
        "layers:\n  - {class: SemanticLayer, name: shapes, frame_id: map, load_file: true}\n"},
       {"shapes", shapes}});
}

std::string error_within(const std::string& bytes, const BudgetLimits& sums) {
  const auto archive = parse_archive(bytes, kArchiveSource, {.sums = sums});
  if (archive) return "no error";
  EXPECT_EQ(archive.error().code, ErrorCode::kLimit);
  return to_string(archive.error());
}

TEST(ArchiveBudget, TheImageThatCrossesTheLimitIsNamed) {
  const std::string bytes = archive_of_grids(3);
  EXPECT_EQ(error_within(bytes, {.max_pixels = 3 * kGridPixels}), "no error");
  EXPECT_EQ(error_within(bytes, {.max_pixels = 3 * kGridPixels - 1}),
            "a.hmap!grid2.pgm: brings the images to 144 pixels, the limit for all together is 143 "
            "(max_pixels)");
  EXPECT_THAT(error_within(bytes, {.max_pixels = 1}), HasSubstr("a.hmap!grid0.pgm"));
}

TEST(ArchiveBudget, ClassGridsCountAsLayersDo) {
  const std::string bytes = write_archive(test::sample_archive()).value();
  EXPECT_THAT(error_within(bytes, {.max_pixels = 1}), HasSubstr("(max_pixels)"));
}

TEST(ArchiveBudget, AnImageThatOnlyALoaderKnowsCounts) {
  LayerRegistry layers;
  ASSERT_TRUE(layers.add(test::NumberLayer(), [](LayerReader& reader) -> Result<LayerContent> {
    HYPERMAP_TRY(reader.grid(""));
    return LayerContent(test::NumberLayer(1));
  }));
  Files files{{"hmap_config.yaml",
               "format_version: 1\nlayers: []\nextensions:\n"
               "  - {format: NumberLayer, version: 1, name: a, frame_id: map, file: grid0}\n"}};
  const std::string grids = archive_of_grids(1);
  for (const char* name : {"grid0.yaml", "grid0.pgm"})
    files.emplace_back(name, test::member_of(grids, name));
  const auto archive =
      parse_archive(zip_of(files), kArchiveSource, {.sums = {.max_pixels = 1}}, layers);
  ASSERT_FALSE(archive);
  EXPECT_THAT(to_string(archive.error()), HasSubstr("a.hmap!grid0.pgm: brings the images to 48"));
}

TEST(ArchiveBudget, TheShapeThatCrossesTheLimitIsNamed) {
  const std::string bytes = archive_of_stars(4);
  EXPECT_EQ(error_within(bytes, {.max_edge_tests = 4 * kStarTests}), "no error");
  const std::string error = error_within(bytes, {.max_edge_tests = 4 * kStarTests - 1});
  EXPECT_THAT(error, HasSubstr("a.hmap!shapes:4: [3] (star3).shape: column 9: brings the shapes"));
  EXPECT_THAT(error, EndsWith("the limit for all together is 10039 (max_edge_tests)"));
}

TEST(ArchiveBudget, ASimpleShapeIsFree) {
  const std::string bytes = write_archive(test::sample_archive()).value();
  EXPECT_EQ(error_within(bytes, {.max_edge_tests = 0}), "no error");
}

TEST(ArchiveBudget, TheMemberThatCrossesTheLimitOfWhatIsKeptIsNamed) {
  const std::string bytes = zip_of({{"hmap_config.yaml", "layers: []\n"},
                                    {"c", std::string(30, 'c')},
                                    {"b", std::string(20, 'b')},
                                    {"a", std::string(10, 'a')}});
  EXPECT_EQ(error_within(bytes, {.max_opaque_bytes = 60}), "no error");
  EXPECT_EQ(error_within(bytes, {.max_opaque_bytes = 59}),
            "a.hmap!c: brings what is kept unread to 60 bytes, the limit for all together is 59 "
            "(max_opaque_bytes)");
}

TEST(ArchiveBudget, TheFileOfAnUnknownLayerIsKeptUnreadToo) {
  const std::string bytes =
      zip_of({{"hmap_config.yaml",
               "layers:\n  - {class: Foreign, name: a, frame_id: map, load_file: true}\n"},
              {"a", std::string(10, 'a')}});
  EXPECT_EQ(error_within(bytes, {.max_opaque_bytes = 10}), "no error");
  EXPECT_THAT(error_within(bytes, {.max_opaque_bytes = 9}), HasSubstr("a.hmap!a: brings"));
}

TEST(ArchiveBudget, TheOctreeThatCrossesTheLimitIsNamed) {
  const std::string tree = "# Octomap OcTree binary file\nid OcTree\nsize 2\nres 0.05\ndata\n";
  const std::string bytes =
      zip_of({{"hmap_config.yaml",
               "format_version: 1\nlayers: []\nextensions:\n"
               "  - {format: octomap, version: 1, name: a, frame_id: map, file: a.bt}\n"
               "  - {format: octomap, version: 1, name: b, frame_id: map, file: b.bt}\n"},
              {"a.bt", tree + std::string("\x01\x00", 2)},
              {"b.bt", tree + std::string("\x01\x00", 2)}});
  EXPECT_EQ(error_within(bytes, {.max_octree_nodes = 4}), "no error");
  EXPECT_EQ(error_within(bytes, {.max_octree_nodes = 3}),
            "a.hmap!b.bt: brings the octrees to 4 nodes, the limit for all together is 3 "
            "(max_octree_nodes)");
}

TEST(ArchiveBudget, WhereverALoadIsStoppedThereIsNoMap) {
  Files files{{"more", "of what nothing names"}};
  const std::string sample = write_archive(test::sample_archive()).value();
  const auto zip = ZipReader::create(view_bytes(sample));
  for (const ZipMember& member : zip->members())
    files.emplace_back(member.name, zip->read(member.name).value());
  const std::string bytes = zip_of(files);

  int num_checks = 0;
  ASSERT_TRUE(parse_archive(bytes, kArchiveSource, {}, {}, [&] {
    ++num_checks;
    return false;
  }));
  ASSERT_GT(num_checks, 20);
  for (int last = 1; last <= num_checks; ++last) {
    int checks = 0;
    const auto archive =
        parse_archive(bytes, kArchiveSource, {}, {}, [&] { return ++checks == last; });
    ASSERT_FALSE(archive) << last;
    EXPECT_EQ(archive.error().code, ErrorCode::kInterrupted) << to_string(archive.error());
    EXPECT_EQ(archive.error().file, "a.hmap");
  }
}

TEST(ArchiveBudget, WhatCouldNotBeLoadedIsNotSaved) {
  const test::TempDir folder;
  const auto path = folder.path() / "a.hmap";
  const auto saved =
      save_archive(test::sample_archive(), path, {.limits = {.sums = {.max_pixels = 1}}});
  ASSERT_FALSE(saved);
  EXPECT_EQ(saved.error().code, ErrorCode::kLimit);
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(ArchiveBudget, ASemanticLayerByItselfHasABudgetOfItsOwn) {
  const std::string shapes = "- {name: a, shape: \"" + star_text(5, 2) + "\"}\n";
  const LoadBudget budget({.max_edge_tests = 2 * kStarTests - 1});
  EXPECT_TRUE(parse_semantic_layer(shapes, kArchiveSource, {}, budget));
  EXPECT_FALSE(parse_semantic_layer(shapes, kArchiveSource, {}, budget)) << "the same account";
  EXPECT_TRUE(parse_semantic_layer(shapes, kArchiveSource));
}

TEST(ArchiveBudget, DefaultsAdmitWhatTheLimitsOfSingleThingsAdmit) {
  const BudgetLimits sums;
  EXPECT_GE(sums.max_pixels, 5 * ImageLimits().max_pixels);
  // 449 * 222 = 99,678 crossings of the 100,000 that one ring may have.
  EXPECT_TRUE(read_wkt(star_text(449, 223), {}, LoadBudget(sums)));
  // A node of our own octree has 25 bytes.
  EXPECT_GE(sums.max_octree_nodes, ArchiveLimits().max_octree_bytes / 25);
}

TEST(ArchiveBudget, RealArchivesStayBelowAThirtiethOfTheDefaults) {
  HYPERMAP_REQUIRE_SHARED_DATA("hmap");
  BudgetLimits sums;
  sums.max_pixels /= 30;
  sums.max_edge_tests /= 30;
  sums.max_opaque_bytes /= 30;
  sums.max_octree_nodes /= 30;
  int num_archives = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::shared_data("hmap"))) {
    if (entry.path().extension() != ".hmap") continue;
    const auto archive = load_archive(entry.path(), {.sums = sums});
    EXPECT_TRUE(archive) << to_string(archive.error());
    ++num_archives;
  }
  EXPECT_GE(num_archives, 8);
}

}  // namespace
}  // namespace hypermap
