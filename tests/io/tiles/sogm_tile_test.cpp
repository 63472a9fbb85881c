// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/tiles/sogm_tile.hpp"

#include "hypermap/io/codec/byte_source.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <string>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kName =
    "What_OGM_T_1509366573.012345678s.ns_Format_INT8_Unit_logodds_Layer_-amiro6-ism-cam_Res_10mm_X_"
    "-1.5m_Y_2.25m_Z_0.1m_rows_2_cols_3_lat_52.028421_lon_8.532347_alt_118.5_.bin";

/// The name with one text in the place of another.
std::string changed(const std::string& old_text, const std::string& new_text) {
  std::string name = kName;
  const std::size_t at = name.find(old_text);
  EXPECT_NE(at, std::string::npos) << old_text;
  return name.replace(at, old_text.size(), new_text);
}

std::string name_refusal(const std::string& name) {
  const auto parsed = parse_sogm_tile_name(name);
  return parsed ? std::string() : to_string(parsed.error());
}

template <class Number>
std::string bytes_of(std::initializer_list<Number> numbers) {
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  std::memcpy(bytes.data(), std::data(numbers), bytes.size());
  return bytes;
}

/// Cells of one row.
Result<LogOddsGrid> cells_of(SogmFormat format, SogmUnit unit, int cols, const std::string& bytes) {
  return read_sogm_cells(*view_bytes(bytes),
                         {.layer = "/a",
                          .format = format,
                          .unit = unit,
                          .geometry = {.resolution_m = 0.01, .cols = cols, .rows = 1}});
}

template <class Number>
std::vector<LogOddsSteps> steps(SogmFormat format,
                                SogmUnit unit,
                                std::initializer_list<Number> numbers) {
  const auto grid = cells_of(format, unit, static_cast<int>(numbers.size()), bytes_of(numbers));
  EXPECT_TRUE(grid) << to_string(grid.error());
  return {grid->cells().begin(), grid->cells().end()};
}

TEST(SogmTile, ItsNameTellsEverything) {
  const SogmTileName name = parse_sogm_tile_name(kName).value();
  EXPECT_EQ(name.layer, "/amiro6/ism/cam");
  EXPECT_EQ(name.format, SogmFormat::kS8);
  EXPECT_EQ(name.unit, SogmUnit::kLogOdds);
  EXPECT_EQ(name.stamp.ns, 1'509'366'573'012'345'678);
  EXPECT_EQ(name.geometry,
            (GridGeometry{.resolution_m = 0.01, .origin = {-1.5, 2.25}, .cols = 3, .rows = 2}));
  EXPECT_EQ(name.z_m, 0.1);
  EXPECT_EQ(
      name.datum,
      (GeographicDatum{.latitude_deg = 52.028421, .longitude_deg = 8.532347, .altitude_m = 118.5}));
}

TEST(SogmTile, TheOlderFormIsRead) {
  const SogmTileName name = parse_sogm_tile_name(
                                "Timestamp_1509366573012345us_LayerIdx_4_Format_32F_GridRes_50mm_X_"
                                "1m_Y_-2m_yaw_0.5_rows_6_"
                                "cols_5.bin")
                                .value();
  EXPECT_EQ(name.layer, "/layer4");
  EXPECT_EQ(name.stamp.ns, 1'509'366'573'012'345'000);
  EXPECT_EQ(name.format, SogmFormat::kF32);
  EXPECT_EQ(name.geometry,
            (GridGeometry{
                .resolution_m = 0.05, .origin = {1, -2}, .yaw_rad = 0.5, .cols = 5, .rows = 6}));
  EXPECT_FALSE(name.datum);
}

TEST(SogmTile, FieldsComeInAnyOrderAndUnit) {
  const auto parsed = [](const std::string& name) { return parse_sogm_tile_name(name).value(); };
  EXPECT_EQ(parsed(changed("10mm", "1cm")), parsed(kName));
  EXPECT_EQ(parsed(changed("10mm", "0.01m")), parsed(kName));
  EXPECT_EQ(parsed(changed("10mm", "0.01")), parsed(kName));
  EXPECT_EQ(parsed(changed("What_OGM_", "")), parsed(kName));
  EXPECT_EQ(parsed(changed("Unit_logodds_", "")), parsed(kName));
  EXPECT_EQ(parsed("rows_2_" + changed("rows_2_", "")), parsed(kName));
  EXPECT_EQ(parsed(changed("_.bin", ".bin")), parsed(kName));
  // Parts of topics have underscores, and may be called as a key is.
  EXPECT_EQ(parsed(changed("-cam", "-front_cam")).layer, "/amiro6/ism/front_cam");
  EXPECT_EQ(parsed(changed("-amiro6-ism-cam", "Res")).layer, "/Res");
  EXPECT_NEAR(
      parsed(changed("Z_0.1m", "Z_0.1m_yaw_90deg")).geometry.yaw_rad, std::acos(0.0), 1e-15);
  // Without a fix receivers say NaN.
  EXPECT_FALSE(parsed(changed("lat_52.028421", "lat_nan")).datum);
  // Nanoseconds are counted, not digits of a fraction.
  EXPECT_EQ(parsed(changed("573.012345678s", "573.5s")).stamp.ns, 1'509'366'573'000'000'005);
}

TEST(SogmTile, WhatIsWrongWithANameIsSaid) {
  EXPECT_EQ(name_refusal(kName), "");
  EXPECT_THAT(name_refusal("tile.png"), HasSubstr("must end in .bin"));
  EXPECT_THAT(name_refusal(".bin"), HasSubstr("must begin with a key"));
  EXPECT_THAT(name_refusal("core_" + kName), HasSubstr("must begin with a key such as What"));
  for (const char* field : {"T_1509366573.012345678s.ns_",
                            "Format_INT8_",
                            "Layer_-amiro6-ism-cam_",
                            "Res_10mm_",
                            "X_-1.5m_",
                            "Y_2.25m_",
                            "rows_2_",
                            "cols_3_"}) {
    EXPECT_THAT(name_refusal(changed(field, "")), HasSubstr("is missing")) << field;
  }
  EXPECT_THAT(name_refusal(changed("rows_2", "rows_2_rows_2")), HasSubstr("rows: is told twice"));
  EXPECT_THAT(name_refusal(changed("OGM", "DEM")), HasSubstr("What: must be one of OGM"));
  EXPECT_THAT(name_refusal(changed("INT8", "64S")), HasSubstr("Format: must be one of"));
  EXPECT_THAT(name_refusal(changed("logodds", "metres")), HasSubstr("Unit: must be one of"));
  EXPECT_THAT(name_refusal(changed("INT8", "8U")), HasSubstr("need a sign"));
  EXPECT_THAT(name_refusal(changed("logodds", "probability")), HasSubstr("none with a sign"));
  EXPECT_THAT(name_refusal(changed("10mm", "ten")), HasSubstr("Res: must be a number"));
  EXPECT_THAT(name_refusal(changed("10mm", "0mm")), HasSubstr("resolution"));
  EXPECT_THAT(name_refusal(changed("10mm", "nanmm")), HasSubstr("resolution"));
  EXPECT_THAT(name_refusal(changed("X_-1.5m", "X_1,5m")), HasSubstr("X: must be a number"));
  EXPECT_THAT(name_refusal(changed("X_-1.5m", "X_1e7m")), HasSubstr("origin"));
  EXPECT_THAT(name_refusal(changed("X_-1.5m", "X_nanm")), HasSubstr("origin"));
  EXPECT_THAT(name_refusal(changed("Z_0.1m", "Z_infm")), HasSubstr("Z: must be finite"));
  EXPECT_THAT(name_refusal(changed("rows_2", "rows_-2")),
              HasSubstr("rows: must be a whole number"));
  EXPECT_THAT(name_refusal(changed("rows_2", "rows_0")), HasSubstr("has no cells"));
  EXPECT_THAT(name_refusal(changed("rows_2", "rows_99999999999")), HasSubstr("rows"));
  EXPECT_THAT(name_refusal(changed("rows_2", "rows_70000")), HasSubstr("65535 a side"));
  EXPECT_THAT(name_refusal(changed("lat_52", "lat_152")), HasSubstr("latitude_deg"));
  EXPECT_THAT(name_refusal(changed("-ism-", "--")), HasSubstr("single hyphens"));
  EXPECT_THAT(name_refusal(changed("012345678s", "1012345678s")), HasSubstr("T: must be"));
  EXPECT_THAT(name_refusal(changed("lat_", "unheard_1_lat_")), HasSubstr("cols"));
  EXPECT_EQ(parse_sogm_tile_name(changed("INT8", "64S")).error().code, ErrorCode::kUnsupported);
  EXPECT_EQ(parse_sogm_tile_name(changed("rows_2", "rows_70000")).error().code, ErrorCode::kLimit);
}

TEST(SogmTile, Int8IsSixteenTimesTheLogOdds) {
  // 127 / 16 = 7.9375; 8 / 16 = 0.5; -16 / 16 = -1.
  EXPECT_THAT(steps<std::int8_t>(SogmFormat::kS8, SogmUnit::kLogOdds, {127, 8, 0, -16, -127}),
              ElementsAre(7938, 500, 0, -1000, -7938));
  const auto refused =
      cells_of(SogmFormat::kS8, SogmUnit::kLogOdds, 2, bytes_of<std::int8_t>({0, -128}));
  EXPECT_THAT(to_string(refused.error()), HasSubstr("cell 1: is -128"));
}

TEST(SogmTile, EveryFormatIsRead) {
  constexpr auto kOdds = SogmUnit::kLogOdds;
  constexpr auto kShare = SogmUnit::kProbability;
  EXPECT_THAT(steps<std::int16_t>(SogmFormat::kS16, kOdds, {-16, 32'000}),
              ElementsAre(-1000, 13'815));
  EXPECT_THAT(steps<std::int32_t>(SogmFormat::kS32, kOdds, {24, -2'000'000'000}),
              ElementsAre(1500, -13'815));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  EXPECT_THAT(steps<float>(SogmFormat::kF32, kOdds, {0.25F, nan, -infinite, 99.0F}),
              ElementsAre(250, 0, -13'815, 13'815));
  EXPECT_THAT(steps<double>(SogmFormat::kF64, kOdds, {-0.0014, 1e300}), ElementsAre(-1, 13'815));
  // ln(204 / 51) = 1.386 294; ln(3) = 1.098 612; 0 and 1 are as sure as a cell can be.
  EXPECT_THAT(steps<std::uint8_t>(SogmFormat::kU8, kShare, {204, 0, 255}),
              ElementsAre(1386, -13'815, 13'815));
  EXPECT_THAT(steps<std::uint16_t>(SogmFormat::kU16, kShare, {52'428, 13'107}),
              ElementsAre(1386, -1386));
  EXPECT_THAT(steps<std::uint32_t>(SogmFormat::kU32, kShare, {3'435'973'836}), ElementsAre(1386));
  EXPECT_THAT(steps<float>(SogmFormat::kF32, kShare, {0.75F, nan, 0.5F}), ElementsAre(1099, 0, 0));
  EXPECT_THAT(steps<double>(SogmFormat::kF64, kShare, {0.25}), ElementsAre(-1099));
  for (const double wrong : {-0.1, 1.1, std::numeric_limits<double>::infinity()}) {
    const auto refused = cells_of(SogmFormat::kF64, kShare, 1, bytes_of<double>({wrong}));
    EXPECT_THAT(to_string(refused.error()), HasSubstr("cell 0")) << wrong;
  }
}

TEST(SogmTile, TheSizeIsThatOfTheName) {
  for (const std::size_t size : {0U, 5U, 7U, 12U}) {
    const auto read =
        read_sogm_cells(*view_bytes(std::string(size, '\0')), parse_sogm_tile_name(kName).value());
    ASSERT_FALSE(read) << size;
    EXPECT_THAT(to_string(read.error()), HasSubstr("expected 2 x 3 x 1 = 6"));
  }
  // 2^28 cells of 8 bytes are refused before memory is taken.
  EXPECT_FALSE(read_sogm_cells(
      *view_bytes(""), {.format = SogmFormat::kF64, .geometry = {.cols = 16'384, .rows = 16'384}}));
}

TEST(SogmTile, AFileIsReadRowByRowFromTheSmallestY) {
  const test::TempDir dir;
  std::ofstream(dir / kName, std::ios::binary) << bytes_of<std::int8_t>({1, 2, 3, 4, 5, 6});
  const SogmTile tile = read_sogm_tile(dir / kName).value();
  EXPECT_EQ(tile.name, parse_sogm_tile_name(kName).value());
  EXPECT_EQ(tile.grid.geometry(), tile.name.geometry);
  EXPECT_EQ(tile.grid.at({2, 0}), 188);  // 3 / 16 = 0.1875
  EXPECT_EQ(tile.grid.at({0, 1}), 250);
  EXPECT_EQ(read_sogm_tile(dir / changed("rows_2", "rows_3")).error().code, ErrorCode::kIo);
  std::filesystem::rename(dir / kName, dir / changed("rows_2", "rows_3"));
  EXPECT_THAT(to_string(read_sogm_tile(dir / changed("rows_2", "rows_3")).error()),
              HasSubstr("rows_3"));
}

}  // namespace
}  // namespace hypermap
