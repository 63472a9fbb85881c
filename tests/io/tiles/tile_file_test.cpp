// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/tiles/tile_file.hpp"

#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/zip_reader.hpp"
#include "hypermap/io/codec/zip_writer.hpp"
#include "support/temp_dir.hpp"
#include "tile_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <map>
#include <string>

namespace hypermap {
namespace {

using test::sample_tile;
using test::small_tiles;
using testing::HasSubstr;

std::string encoded(const StackTile& tile) {
  return encode_tile(tile, small_tiles()).value();
}

std::string refusal_of(std::string_view bytes) {
  const auto decoded = decode_tile(bytes, {"a.tile"});
  return decoded ? std::string() : to_string(decoded.error());
}

/// Members of a sound file, some with other content; empty: left out.
std::string with_members(const std::map<std::string, std::string>& changes) {
  const std::string bytes = encoded(sample_tile({-2, 6}, 1));
  const auto zip = ZipReader::create(view_bytes(bytes)).value();
  ZipWriter writer;
  std::map<std::string, std::string> members;
  for (const ZipMember& member : zip.members()) {
    members[member.name] = zip.read(member.name).value();
  }
  for (const auto& [name, content] : changes) members[name] = content;
  for (const auto& [name, content] : members) {
    if (content.empty()) continue;
    EXPECT_TRUE(writer.add(name, content));
  }
  return writer.finish().value();
}

/// The head of a sound file with one text in the place of another.
std::string with_head(const std::string& old_text, const std::string& new_text) {
  const std::string bytes = encoded(sample_tile({-2, 6}, 1));
  std::string head = ZipReader::create(view_bytes(bytes)).value().read("tile.json").value();
  const std::size_t at = head.find(old_text);
  EXPECT_NE(at, std::string::npos) << old_text << " in " << head;
  head.replace(at, old_text.size(), new_text);
  return with_members({{"tile.json", head}});
}

TEST(TileFile, ATileIsReadAsItWasWritten) {
  for (const StackTile& tile : {sample_tile({-2, 6}, 1), StackTile{.index = {3, 0}}}) {
    const std::string bytes = encoded(tile);
    EXPECT_EQ(encoded(tile), bytes);
    const FiledTile read = decode_tile(bytes, {"a.tile"}).value();
    EXPECT_EQ(read.tile, tile);
    EXPECT_EQ(read.lattice, small_tiles());
    EXPECT_EQ(encode_tile(read.tile, read.lattice).value(), bytes);
  }
}

TEST(TileFile, AFileIsNamedInItsErrors) {
  const test::TempDir dir;
  std::ofstream(dir / "a.tile", std::ios::binary) << encoded(sample_tile({1, 2}, 3));
  EXPECT_EQ(read_tile_file(dir / "a.tile").value().tile, sample_tile({1, 2}, 3));
  std::ofstream(dir / "b.tile") << "text";
  EXPECT_THAT(to_string(read_tile_file(dir / "b.tile").error()), HasSubstr("b.tile: "));
  EXPECT_EQ(read_tile_file(dir / "none").error().code, ErrorCode::kIo);
}

TEST(TileFile, ItsNameTellsContentResolutionAndLocation) {
  // At full precision: 48 * 0.1 is not 4.8.
  EXPECT_EQ(tile_file_name(small_tiles(), {-2, 6}).value(),
            "tile_-2_6_logodds_0.1m_at_-1.6m_4.800000000000001m.tile");
  EXPECT_EQ(tile_file_name({.resolution_m = 0.1, .tile_cells = 1}, {3, 0}).value(),
            "tile_3_0_logodds_0.1m_at_0.30000000000000004m_0m.tile");
}

TEST(TileFile, TheHeadIsForPeopleToo) {
  const std::string bytes = encoded(sample_tile({-2, 6}, 1));
  const auto zip = ZipReader::create(view_bytes(bytes)).value();
  const std::string head = zip.read("tile.json").value();
  for (const char* text : {"\"content\":\"log-odds\"",
                           "\"resolution_m\":0.1",
                           "\"x_m\":-1.6",
                           "\"latitude_deg\":52.028421",
                           "/ism/laser",
                           "\"frame_id\":\"odom\""}) {
    EXPECT_THAT(head, HasSubstr(text));
  }
  // Cell 0 of the first layer by name, little-endian.
  const LogOddsGrid first = sample_tile({-2, 6}, 1).layers.at("/ism/camera/Tür");
  const std::string cells = zip.read("layer-0").value();
  EXPECT_EQ(cells.size(), 128U);
  const int low = static_cast<unsigned char>(cells[0]);
  const int high = static_cast<unsigned char>(cells[1]);
  EXPECT_EQ(static_cast<std::int16_t>(high * 256 + low), first.at({0, 0}));
}

TEST(TileFile, ItIsCutOrFlippedNowhereUnnoticed) {
  const std::string bytes = encoded(sample_tile({1, 1}, 2));
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    EXPECT_NE(refusal_of(bytes.substr(0, i)), "") << i;
    std::string flipped = bytes;
    flipped[i] = static_cast<char>(flipped[i] ^ 0x10);
    const auto read = decode_tile(flipped, {"a.tile"});
    EXPECT_TRUE(!read || read->tile == sample_tile({1, 1}, 2)) << i;
  }
  EXPECT_NE(refusal_of(""), "");
  EXPECT_NE(refusal_of("PK"), "");
}

TEST(TileFile, WhatIsWrongIsNamed) {
  EXPECT_THAT(refusal_of(with_members({{"tile.json", ""}})), HasSubstr("tile.json"));
  EXPECT_THAT(refusal_of(with_members({{"layer-1", ""}})), HasSubstr("2 members"));
  EXPECT_THAT(refusal_of(with_members({{"layer-1", ""}, {"layer-2", std::string(128, 'a')}})),
              HasSubstr("a.tile!layer-1: must have 2 x 8 x 8 bytes, is missing"));
  EXPECT_THAT(refusal_of(with_members({{"more", "x"}})), HasSubstr("4 members"));
  EXPECT_THAT(refusal_of(with_members({{"layer-0", std::string(126, '\0')}})),
              HasSubstr("a.tile!layer-0: must have 2 x 8 x 8 bytes, has 126"));
  // 0x7F7F is 32.639, beyond what a cell can say.
  EXPECT_THAT(refusal_of(with_members({{"layer-0", std::string(128, '\x7F')}})),
              HasSubstr("a.tile!layer-0: cells: log-odds must be from"));
  const auto head_refused = [](const char* old_text, const char* new_text) {
    return refusal_of(with_head(old_text, new_text));
  };
  EXPECT_THAT(head_refused("hypermap tile", "other"), HasSubstr("a.tile!tile.json:1"));
  EXPECT_THAT(head_refused("\"version\":1", "\"version\":2"),
              HasSubstr("written by a newer version 2"));
  EXPECT_THAT(head_refused("log-odds", "heights"), HasSubstr("content"));
  EXPECT_THAT(head_refused("\"frame_id\":\"odom\"", "\"frame_id\":\"\""), HasSubstr("frame_id"));
  EXPECT_THAT(head_refused("\"resolution_m\":0.1", "\"resolution_m\":0"), HasSubstr("resolution"));
  EXPECT_THAT(head_refused("\"resolution_m\":0.1", "\"resolution_m\":1e999"),
              HasSubstr("tile.json"));
  EXPECT_THAT(head_refused("\"tile_cells\":8", "\"tile_cells\":4097"), HasSubstr("4096"));
  EXPECT_THAT(head_refused("\"tile_cells\":8", "\"tile_cells\":-8"), HasSubstr("4096"));
  EXPECT_THAT(head_refused("\"col\":-2", "\"col\":2147483647"), HasSubstr("1e6"));
  EXPECT_THAT(head_refused("\"col\":-2", "\"col\":-2.5"), HasSubstr("col"));
  EXPECT_THAT(head_refused("\"x_m\":-1.6", "\"x_m\":-1.61"), HasSubstr("must be -1.6"));
  EXPECT_THAT(head_refused("\"latitude_deg\":52", "\"latitude_deg\":152"), HasSubstr("latitude"));
  EXPECT_THAT(head_refused("\"version\":1", "\"version\":1,\"more\":1"), HasSubstr("more"));
  EXPECT_THAT(head_refused("/ism/laser", "/ism/camera/Tür"), HasSubstr("two layers"));
  EXPECT_EQ(decode_tile(with_head("\"version\":1", "\"version\":9"), {}).error().code,
            ErrorCode::kUnsupported);
}

TEST(TileFile, WhatCouldNotBeReadAgainIsNotWritten) {
  const auto refused = [](const StackTile& tile, const TileLattice& lattice) {
    const auto bytes = encode_tile(tile, lattice);
    return bytes ? std::string() : to_string(bytes.error());
  };
  TileLattice lattice = small_tiles();
  EXPECT_THAT(refused(sample_tile({0, 0}, 1), {.tile_cells = 9}), HasSubstr("other cells"));
  lattice.frame_id = "\xFF";
  EXPECT_THAT(refused({}, lattice), HasSubstr("frame_id: must be UTF-8"));
  const GridGeometry geometry = geometry_of(small_tiles(), {}).value();
  StackTile tile;
  tile.layers.emplace("/ism/a\n", LogOddsGrid::create(geometry).value());
  EXPECT_THAT(refused(tile, small_tiles()), HasSubstr("without control characters"));
  tile.layers.clear();
  for (int i = 0; i < 257; ++i) {
    tile.layers.emplace("/ism/" + std::to_string(i), LogOddsGrid::create(geometry).value());
  }
  EXPECT_THAT(refused(tile, small_tiles()), HasSubstr("257 layers, the limit is 256"));
}

TEST(TileFile, ALargeTileOfNothingIsSmallAndReadable) {
  // 2 MiB of one byte would deflate by 1000:1, which a reader of strangers' files refuses.
  const TileLattice lattice{.resolution_m = 0.1, .tile_cells = 1024};
  const GridGeometry geometry = geometry_of(lattice, {}).value();
  StackTile tile;
  tile.layers.emplace("/ism/a", LogOddsGrid::create(geometry).value());
  const std::string bytes = encode_tile(tile, lattice).value();
  EXPECT_LT(bytes.size(), 300'000U);
  EXPECT_EQ(decode_tile(bytes, {}).value().tile, tile);
}

}  // namespace
}  // namespace hypermap
