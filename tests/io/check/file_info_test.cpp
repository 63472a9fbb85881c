// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/check/file_info.hpp"

#include "hypermap/io/archive/map_archive.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <variant>

namespace hypermap {
namespace {

TEST(FileInfo, AnArchiveIsToldOfLayerByLayer) {
  const test::TempDir dir;
  MapArchive archive;
  ASSERT_TRUE(archive.hypermap.add_layer({{.name = "shapes"}, SemanticLayer()}));
  ASSERT_TRUE(save_archive(archive, dir / "a.hmap"));
  const auto described = describe_file(dir / "a.hmap");
  ASSERT_TRUE(described) << to_string(described.error());
  const auto& info = std::get<ArchiveInfo>(described->value);
  ASSERT_EQ(info.layers.size(), 1U);
  EXPECT_EQ(info.layers[0].name, "shapes");
}

TEST(FileInfo, AMapByItselfIsAnArchiveWithThisLayer) {
  const test::TempDir dir;
  std::ofstream(dir / "map.yaml") << "image: a.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n"
                                     "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  std::ofstream(dir / "a.pgm", std::ios::binary) << "P5\n2 1\n255\n" << '\0' << '\xFE';
  const auto described = describe_file(dir / "map.yaml");
  ASSERT_TRUE(described) << to_string(described.error());
  const auto& info = std::get<ArchiveInfo>(described->value);
  ASSERT_EQ(info.layers.size(), 1U);
  EXPECT_EQ(info.layers[0].name, "map");
  EXPECT_EQ(info.layers[0].cells->occupied, 1U);
  EXPECT_EQ(info.layers[0].cells->free, 1U);
}

TEST(FileInfo, AFolderIsADatasetOrIsRefusedAsOne) {
  const test::TempDir sequence;
  (void)test::write_tum(sequence.path());
  const auto described = describe_file(sequence.path());
  ASSERT_TRUE(described) << to_string(described.error());
  EXPECT_EQ(std::get<DatasetSummary>(described->value).num_frames, 4U);
  const test::TempDir dir;
  EXPECT_EQ(describe_file(dir.path()).error().code, ErrorCode::kNotFound);
}

TEST(FileInfo, AFolderOfTilesIsToldOfAsTheStackThatTheyAre) {
  const test::TempDir dir;
  std::ofstream(
      dir / ("What_OGM_T_1.000000000s.ns_Format_INT8_Unit_logodds_Layer_-ism-cam_Res_1000mm_"
             "X_0m_Y_0m_Z_0m_rows_1_cols_2_lat_nan_lon_nan_alt_nan_.bin"),
      std::ios::binary)
      << "\x10\x10";
  const auto described = describe_file(dir.path());
  ASSERT_TRUE(described) << to_string(described.error());
  const auto& info = std::get<ArchiveInfo>(described->value);
  ASSERT_EQ(info.layers.size(), 1U);
  EXPECT_EQ(info.layers[0].name, "tiles");
  EXPECT_EQ(info.layers[0].cells->occupied, 2U);
  const auto one = describe_file(std::filesystem::directory_iterator(dir.path())->path());
  ASSERT_FALSE(one);
  EXPECT_EQ(one.error().code, ErrorCode::kUnsupported);
}

TEST(FileInfo, WhatIsNotThereIsAnError) {
  EXPECT_EQ(describe_file("/nonexistent/a.hmap").error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace hypermap
