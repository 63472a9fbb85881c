// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_archive.hpp"

#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/zip_writer.hpp"
#include "io/archive/sample_archive.hpp"
#include "support/temp_dir.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace hypermap {
namespace {

namespace fs = std::filesystem;
using test::sample_archive;
using test::TempDir;
using testing::HasSubstr;
using testing::IsEmpty;

const SourceName kArchiveSource{.file = "a.hmap"};

using Files = std::vector<std::pair<std::string, std::string>>;

std::string zip_of(const Files& files) {
  ZipWriter writer;
  for (const auto& [name, content] : files) EXPECT_TRUE(writer.add(name, content));
  return writer.finish().value();
}

/// The members of an archive, some of them changed or left out (empty content).
std::string changed(const std::string& bytes, const Files& changes) {
  const auto zip = ZipReader::create(view_bytes(bytes));
  Files files;
  for (const ZipMember& member : zip->members()) {
    std::string content = zip->read(member.name).value();
    bool left_out = false;
    for (const auto& [name, new_content] : changes) {
      if (name != member.name) continue;
      content = new_content;
      left_out = new_content.empty();
    }
    if (!left_out) files.emplace_back(member.name, content);
  }
  return zip_of(files);
}

std::string member_of(const std::string& bytes, const std::string& name) {
  return ZipReader::create(view_bytes(bytes))->read(name).value();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from << " in " << text;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string load_error(const std::string& bytes) {
  const auto archive = parse_archive(bytes, kArchiveSource);
  return archive ? "no error" : to_string(archive.error());
}

std::string all_findings(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings) text += to_string(finding.error) + "\n";
  return text;
}

TEST(MapArchive, LoadSaveLoadIsAFixedPointByteForByte) {
  const MapArchive archive = sample_archive();
  const auto bytes = write_archive(archive);
  ASSERT_TRUE(bytes) << to_string(bytes.error());
  const auto loaded = parse_archive(*bytes, kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(all_findings(loaded->findings), "");
  EXPECT_TRUE(loaded->value == archive);
  EXPECT_EQ(write_archive(loaded->value).value(), *bytes);
}

TEST(MapArchive, AnEmptyMapIsAMap) {
  const auto bytes = write_archive(MapArchive{});
  ASSERT_TRUE(bytes) << to_string(bytes.error());
  const auto loaded = parse_archive(*bytes, kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_TRUE(loaded->value == MapArchive{});
}

TEST(MapArchive, TheStrictFormStandsFirstAndAlone) {
  const std::string bytes = write_archive(sample_archive()).value();
  const auto zip = ZipReader::create(view_bytes(bytes));
  ASSERT_TRUE(zip);
  std::vector<std::string> names;
  for (const ZipMember& member : zip->members()) names.push_back(member.name);
  EXPECT_THAT(names,
              testing::ElementsAre("hmap_config.yaml",
                                   "occupancy.yaml",
                                   "occupancy.png",
                                   "semantic",
                                   "octree.ot",
                                   "objects.jsonl",
                                   "classes.yaml",
                                   "class_grid_0.yaml",
                                   "class_grid_0.png",
                                   "provenance.yaml"));
  const std::string config = member_of(bytes, "hmap_config.yaml");
  const std::size_t extensions = config.find("extensions:");
  ASSERT_NE(extensions, std::string::npos);
  // Without our additions it is an archive of the first implementation.
  const auto strict =
      zip_of({{"hmap_config.yaml", config.substr(0, config.find("format_version:"))},
              {"occupancy.yaml", member_of(bytes, "occupancy.yaml")},
              {"occupancy.png", member_of(bytes, "occupancy.png")},
              {"semantic", member_of(bytes, "semantic")}});
  const auto loaded = parse_archive(strict, kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(all_findings(loaded->findings), "");
  EXPECT_TRUE(loaded->value.hypermap == sample_archive().hypermap);
}

TEST(MapArchive, ACutAtAnyOffsetIsAnError) {
  const std::string bytes = write_archive(sample_archive()).value();
  for (std::size_t length = 0; length < bytes.size(); ++length)
    ASSERT_FALSE(parse_archive(bytes.substr(0, length), kArchiveSource)) << length;
}

TEST(MapArchive, AFlippedBitGivesTheSameMapOrAnError) {
  const MapArchive archive = sample_archive();
  const std::string bytes = write_archive(archive).value();
  std::mt19937 engine(1);
  for (int i = 0; i < 2000; ++i) {
    std::string flipped = bytes;
    const std::size_t at = engine() % flipped.size();
    flipped[at] = static_cast<char>(flipped[at] ^ 1 << (engine() % 8));
    const auto loaded = parse_archive(flipped, kArchiveSource);
    if (loaded) {
      EXPECT_TRUE(loaded->value == archive) << "byte " << at;
    }
  }
}

TEST(MapArchive, DamageInsideAMemberNeverBecomesAnotherKindOfFailure) {
  const std::string bytes = write_archive(sample_archive()).value();
  const auto zip = ZipReader::create(view_bytes(bytes));
  std::mt19937 engine(2);
  for (const ZipMember& member : zip->members()) {
    const std::string content = zip->read(member.name).value();
    for (int i = 0; i < 60; ++i) {
      std::string damaged = content;
      damaged[engine() % damaged.size()] = static_cast<char>(engine() & 0xff);
      // Whatever is accepted can be written and read again.
      const auto loaded = parse_archive(changed(bytes, {{member.name, damaged}}), kArchiveSource);
      if (!loaded) continue;
      const auto again = write_archive(loaded->value);
      ASSERT_TRUE(again) << member.name << ": " << to_string(again.error());
      EXPECT_TRUE(parse_archive(*again, kArchiveSource)) << member.name;
    }
  }
}

TEST(MapArchive, AMissingMemberIsNamedWithItsLayer) {
  const std::string bytes = write_archive(sample_archive()).value();
  EXPECT_THAT(load_error(changed(bytes, {{"hmap_config.yaml", ""}})),
              HasSubstr("hmap_config.yaml"));
  EXPECT_THAT(load_error(changed(bytes, {{"semantic", ""}})),
              HasSubstr("layers[1].file: names 'semantic', which is not there"));
  EXPECT_THAT(load_error(changed(bytes, {{"occupancy.yaml", ""}})), HasSubstr("layers[0].file"));
  EXPECT_THAT(load_error(changed(bytes, {{"occupancy.png", ""}})), HasSubstr("occupancy.png"));
  EXPECT_THAT(load_error(changed(bytes, {{"octree.ot", ""}})), HasSubstr("extensions[0].file"));
  EXPECT_THAT(load_error(changed(bytes, {{"classes.yaml", ""}})), HasSubstr("classes.yaml"));
}

TEST(MapArchive, FilesThatLeaveTheArchiveOrAreSharedAreErrorsNamingTheField) {
  const std::string bytes = write_archive(sample_archive()).value();
  const std::string config = member_of(bytes, "hmap_config.yaml");
  EXPECT_THAT(
      load_error(changed(
          bytes, {{"hmap_config.yaml", replaced(config, "file: semantic", "file: ../semantic")}})),
      HasSubstr("layers[1].file"));
  EXPECT_THAT(load_error(changed(bytes,
                                 {{"hmap_config.yaml",
                                   replaced(config, "file: semantic", "file: occupancy.png")}})),
              HasSubstr("belongs to"));
  const std::string metadata = member_of(bytes, "occupancy.yaml");
  EXPECT_THAT(load_error(changed(
                  bytes, {{"occupancy.yaml", replaced(metadata, "occupancy.png", "/etc/passwd")}})),
              HasSubstr("image"));
}

TEST(MapArchive, NewerVersionsAreRefusedByTheirNumber) {
  const std::string bytes = write_archive(sample_archive()).value();
  const std::string config = member_of(bytes, "hmap_config.yaml");
  EXPECT_THAT(load_error(changed(bytes,
                                 {{"hmap_config.yaml",
                                   replaced(config, "format_version: 1", "format_version: 2")}})),
              HasSubstr("written by a newer version 2"));
}

TEST(MapArchive, WhatIsNotUnderstoodIsKeptAndSaid) {
  const std::string bytes =
      zip_of({{"hmap_config.yaml",
               "layers:\n"
               "  - {class: GasLayer, name: gas, frame_id: map, load_file: true, file: gas.bin,"
               " unit: ppm}\n"
               "extensions:\n"
               "  - {format: weather, version: 7, file: weather.txt}\n"
               "author: someone\n"},
              {"gas.bin", std::string("\0\1\2", 3)},
              {"weather.txt", "sunny"},
              {"notes.txt", "buy milk"}});
  const auto loaded = parse_archive(bytes, kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  const std::string findings = all_findings(loaded->findings);
  for (const char* what : {"GasLayer", "unit", "weather", "author"})
    EXPECT_THAT(findings, HasSubstr(what));
  const std::string saved = write_archive(loaded->value).value();
  for (const char* name : {"gas.bin", "weather.txt", "notes.txt"})
    EXPECT_EQ(member_of(saved, name), member_of(bytes, name));
  const auto again = parse_archive(saved, kArchiveSource);
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_TRUE(again->value == loaded->value);
  EXPECT_EQ(write_archive(again->value).value(), saved);
}

TEST(MapArchive, OctreesOfOtherProgramsAreKeptByteForByte) {
  HYPERMAP_REQUIRE_SHARED_DATA("octomap/velma/map.bt");
  const std::string tree = read_file(test::shared_data("octomap/velma/map.bt"), 1 << 30).value();
  const std::string bytes =
      zip_of({{"hmap_config.yaml",
               "layers: []\nextensions:\n"
               "  - {format: octomap, version: 1, name: room, frame_id: odom, file: room.bt}\n"},
              {"room.bt", tree}});
  const auto loaded = parse_archive(bytes, kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  ASSERT_EQ(loaded->value.octomaps.size(), 1U);
  EXPECT_FALSE(loaded->value.octree);
  EXPECT_GT(loaded->value.octomaps[0].tree.leaves.size(), 1000U);
  EXPECT_EQ(member_of(write_archive(loaded->value).value(), "room.bt"), tree);
}

TEST(MapArchive, ALabelWithoutAClassIsRefusedBothWays) {
  MapArchive archive = sample_archive();
  const std::string bytes = write_archive(archive).value();
  EXPECT_THAT(load_error(changed(bytes, {{"classes.yaml", "[chair]\n"}})), HasSubstr("class"));
  archive.classes = ClassRegistry();
  EXPECT_FALSE(write_archive(archive));
}

TEST(MapArchive, WhatTheLoaderWouldRefuseTheSaverRefuses) {
  MapArchive archive = sample_archive();
  archive.objects.modify(ObjectId{1}, [](Object& object) {
    object.existence = LogOdds(std::numeric_limits<double>::quiet_NaN());
  });
  const TempDir dir;
  const auto saved = save_archive(archive, dir / "a.hmap");
  ASSERT_FALSE(saved);
  EXPECT_THAT(to_string(saved.error()), HasSubstr("object 1"));
  EXPECT_FALSE(fs::exists(dir / "a.hmap"));
}

TEST(MapArchive, AFailedSaveLeavesTheOldArchive) {
  const TempDir dir;
  ASSERT_TRUE(save_archive(MapArchive{}, dir / "a.hmap"));
  const std::string before = read_file(dir / "a.hmap", 1 << 20).value();
  rlimit unlimited{};
  ::getrlimit(RLIMIT_FSIZE, &unlimited);
  const rlimit full_disk{.rlim_cur = 100, .rlim_max = unlimited.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &full_disk);
  const auto saved = save_archive(sample_archive(), dir / "a.hmap");
  ::setrlimit(RLIMIT_FSIZE, &unlimited);
  ASSERT_FALSE(saved);
  EXPECT_THAT(saved.error().what, HasSubstr("errno 27"));
  EXPECT_EQ(read_file(dir / "a.hmap", 1 << 20).value(), before);
}

TEST(MapArchive, LoadsWhatWasSavedFromADisk) {
  const TempDir dir;
  const MapArchive archive = sample_archive();
  const auto saved = save_archive(archive, dir / "a.hmap");
  ASSERT_TRUE(saved) << to_string(saved.error());
  const auto loaded = load_archive(dir / "a.hmap");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_TRUE(loaded->value == archive);
}

TEST(MapArchive, ABareConfigurationIsLoadedWithTheFilesBesideIt) {
  const TempDir dir;
  const std::string bytes = write_archive(sample_archive()).value();
  const auto zip = ZipReader::create(view_bytes(bytes));
  for (const ZipMember& member : zip->members())
    std::ofstream(dir / member.name, std::ios::binary) << zip->read(member.name).value();
  const auto loaded = load_archive(dir / "hmap_config.yaml");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_TRUE(loaded->value == sample_archive());
}

TEST(MapArchive, ABareConfigurationMayNameFilesAnywhereAndIsSavedWithThemInside) {
  const TempDir dir;
  fs::create_directory(dir / "maps");
  fs::create_directory(dir / "config");
  std::ofstream(dir / "maps" / "shapes.yaml") << "- name: sink\n  shape: POLYGON((0 0,1 0,1 1))\n";
  std::ofstream(dir / "config" / "map.yaml")
      << "layers:\n  - {class: SemanticLayer, name: semantic, frame_id: map, load_file: true, "
         "file: ../maps/shapes.yaml}\n";
  const auto loaded = load_archive(dir / "config" / "map.yaml");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  const auto bytes = write_archive(loaded->value);
  ASSERT_TRUE(bytes) << to_string(bytes.error());
  EXPECT_THAT(member_of(*bytes, "semantic"), HasSubstr("sink"));
}

TEST(MapArchive, FilesThatAreNoArchivesAreSaidToBeNone) {
  const TempDir dir;
  std::ofstream(dir / "a.hmap") << "";
  std::ofstream(dir / "b.hmap") << "P5 2 2 255 abcd";
  for (const char* name : {"a.hmap", "b.hmap"}) {
    const auto loaded = load_archive(dir / name);
    ASSERT_FALSE(loaded);
    EXPECT_THAT(to_string(loaded.error()), HasSubstr("not a map archive"));
    EXPECT_THAT(to_string(loaded.error()), HasSubstr(name));
  }
  EXPECT_EQ(load_archive(dir / "none.hmap").error().code, ErrorCode::kIo);
  EXPECT_EQ(load_archive(dir.path()).error().code, ErrorCode::kIo);
}

TEST(MapArchive, EveryArchiveOfTheFirstImplementationLoadsAndLosesNothing) {
  HYPERMAP_REQUIRE_SHARED_DATA("hmap");
  int num_archives = 0;
  for (const auto& file : fs::directory_iterator(test::shared_data("hmap"))) {
    if (file.path().extension() != ".hmap") continue;
    ++num_archives;
    const auto loaded = load_archive(file.path());
    ASSERT_TRUE(loaded) << to_string(loaded.error());
    const auto saved = write_archive(loaded->value);
    ASSERT_TRUE(saved) << file.path() << to_string(saved.error());
    const auto again = parse_archive(*saved, kArchiveSource);
    ASSERT_TRUE(again) << file.path() << to_string(again.error());
    EXPECT_TRUE(again->value == loaded->value) << file.path();
    EXPECT_EQ(write_archive(again->value).value(), *saved) << file.path();
  }
  EXPECT_EQ(num_archives, 8);
}

}  // namespace
}  // namespace hypermap
