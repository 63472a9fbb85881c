// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_archive.hpp"
#include "io/archive/archive_edits.hpp"
#include "io/archive/sample_archive.hpp"
#include "support/sanitized.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <random>
#include <string>

namespace hypermap {
namespace {

using test::changed;
using test::kArchiveSource;
using test::load_error;
using test::member_of;
using test::replaced;
using test::sample_archive;
using testing::HasSubstr;

TEST(DamagedMapArchive, ACutAtAnyOffsetIsAnError) {
  const std::string bytes = write_archive(sample_archive()).value();
  for (std::size_t length = 0; length < bytes.size(); ++length)
    ASSERT_FALSE(parse_archive(bytes.substr(0, length), kArchiveSource)) << length;
}

TEST(DamagedMapArchive, AFlippedBitGivesTheSameMapOrAnError) {
  const MapArchive archive = sample_archive();
  const std::string bytes = write_archive(archive).value();
  std::mt19937 engine(1);
  for (int i = 0; i < test::repetitions(2000); ++i) {
    std::string flipped = bytes;
    const std::size_t at = engine() % flipped.size();
    flipped[at] = static_cast<char>(flipped[at] ^ 1 << (engine() % 8));
    const auto loaded = parse_archive(flipped, kArchiveSource);
    if (loaded) {
      EXPECT_TRUE(loaded->value == archive) << "byte " << at;
    }
  }
}

TEST(DamagedMapArchive, DamageInsideAMemberNeverBecomesAnotherKindOfFailure) {
  const std::string bytes = write_archive(sample_archive()).value();
  const auto zip = ZipReader::create(view_bytes(bytes));
  std::mt19937 engine(2);
  for (const ZipMember& member : zip->members()) {
    const std::string content = zip->read(member.name).value();
    for (int i = 0; i < test::repetitions(60); ++i) {
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

TEST(DamagedMapArchive, AMissingMemberIsNamedWithItsLayer) {
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

TEST(DamagedMapArchive, FilesThatLeaveTheArchiveOrAreSharedAreErrorsNamingTheField) {
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

TEST(DamagedMapArchive, NewerVersionsAreRefusedByTheirNumber) {
  const std::string bytes = write_archive(sample_archive()).value();
  const std::string config = member_of(bytes, "hmap_config.yaml");
  EXPECT_THAT(load_error(changed(bytes,
                                 {{"hmap_config.yaml",
                                   replaced(config, "format_version: 1", "format_version: 2")}})),
              HasSubstr("written by a newer version 2"));
}

}  // namespace
}  // namespace hypermap
