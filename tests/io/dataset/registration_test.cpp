// SPDX-License-Identifier: BSD-3-Clause
// Recordings in the layout of 7-Scenes, whose depth is registered to colour in some and in others
// not: the images say.
#include "hypermap/core/base/random_numbers.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "io/dataset/opened_dataset.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using test::opened;
using test::padded;
using test::TempDir;
using test::write_text;

constexpr PinholeCamera kDepthCamera{320, 240, 292.5, 292.5, 160, 120};

/// An upright board, seen from the front. Unit: metre, in the depth camera.
struct Board {
  double x = 0.0;
  double y = 0.0;
  double z = 3.0;
  double half_width = 100.0;
  double half_height = 100.0;
  std::uint8_t grey = 90;
};

/// A wall with boards before it, others in each frame.
std::vector<Board> boards_of(int frame) {
  std::vector<Board> boards{Board{}};
  SplitMix64 random;
  for (int i = 0; i < 100 * frame; ++i) (void)random();
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() % 1000) / 1000.0;
  };
  for (int i = 0; i < 10; ++i) {
    const double z = between(0.9, 2.5);
    boards.push_back({between(-0.5, 0.5) * z,
                      between(-0.35, 0.35) * z,
                      z,
                      between(0.05, 0.15),
                      between(0.05, 0.15),
                      static_cast<std::uint8_t>(random() % 2 == 0 ? 20 : 200)});
  }
  return boards;
}

/// The nearest board at a pixel of a camera that stands `right_m` to the right.
const Board& board_at(
    const std::vector<Board>& boards, const PinholeCamera& camera, double right_m, int u, int v) {
  const Board* nearest = &boards.front();
  for (const Board& board : boards) {
    const Eigen::Vector3d point = camera.unproject(u, v, board.z).xyz;
    const bool is_on = std::abs(point.x() + right_m - board.x) < board.half_width &&
                       std::abs(point.y() - board.y) < board.half_height;
    if (is_on && board.z < nearest->z) nearest = &board;
  }
  return *nearest;
}

/// Four frames: depth by `kDepthCamera`, colour by a camera beside it.
void write_pair_of_cameras(const std::filesystem::path& folder,
                           const PinholeCamera& color_camera,
                           double right_m) {
  const std::string size = "320 240\n";
  for (int frame = 0; frame < 4; ++frame) {
    const std::vector<Board> boards = boards_of(frame);
    std::string depth = "P5\n" + size + "65535\n";
    std::string color = "P5\n" + size + "255\n";
    for (int v = 0; v < kDepthCamera.height_px; ++v) {
      for (int u = 0; u < kDepthCamera.width_px; ++u) {
        const double z = board_at(boards, kDepthCamera, 0.0, u, v).z;
        const auto depth_mm = static_cast<std::uint16_t>(1000.0 * z);
        depth.push_back(static_cast<char>(depth_mm >> 8U));
        depth.push_back(static_cast<char>(depth_mm & 0xFFU));
        color.push_back(static_cast<char>(board_at(boards, color_camera, right_m, u, v).grey));
      }
    }
    const std::string stem = "frame-" + padded(frame, 6);
    write_text(folder / (stem + ".depth.pgm"), depth);
    write_text(folder / (stem + ".color.pgm"), color);
    write_text(folder / (stem + ".pose.txt"), test::pose_rows(frame));
  }
  write_text(folder / "camera-intrinsics.txt", "292.5 0 160\n0 292.5 120\n0 0 1\n");
}

TEST(Registration, AColourCameraBesideDepthIsFound) {
  const TempDir dir;
  const PinholeCamera color_camera{320, 240, 265, 265, 163, 117};
  write_pair_of_cameras(dir / "s", color_camera, 0.03);
  ClassRegistry registry;
  const auto reader = opened(dir / "s", registry);
  ASSERT_NE(reader, nullptr);
  const PinholeCamera& found = reader->camera();
  EXPECT_NEAR(found.fx_px, color_camera.fx_px, 4.0);
  EXPECT_EQ(found.fx_px, found.fy_px);
  EXPECT_NEAR(found.cx_px, color_camera.cx_px, 3.0);
  EXPECT_NEAR(found.cy_px, color_camera.cy_px, 2.0);
  EXPECT_FALSE(reader->summary().registration.empty());
}

TEST(Registration, WhatDepthShowsLiesWhereColourShowsIt) {
  const TempDir dir;
  const PinholeCamera color_camera{320, 240, 265, 265, 163, 117};
  write_pair_of_cameras(dir / "s", color_camera, 0.03);
  ClassRegistry registry;
  const auto reader = opened(dir / "s", registry, {.read_color = true});
  ASSERT_NE(reader, nullptr);
  const auto frame = reader->read(1);
  ASSERT_TRUE(frame) << to_string(frame.error());
  // The wall alone is of this grey: pixels where one of the two images shows it and the other does
  // not. As the files have them, those are a fifth of all.
  int num_wrong = 0;
  int num_measured = 0;
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) {
      const float z = frame->depth_m.at(u, v);
      if (z == 0.0F) continue;
      ++num_measured;
      num_wrong += (frame->color.at(u, v).r == 90) != (z > 2.9F) ? 1 : 0;
    }
  }
  EXPECT_GT(num_measured, 320 * 240 * 3 / 4);
  EXPECT_LT(num_wrong, num_measured / 20);
}

TEST(Registration, PosesAreThoseOfDepth) {
  const TempDir dir;
  write_pair_of_cameras(dir / "s", {320, 240, 265, 265, 163, 117}, 0.03);
  ClassRegistry registry;
  const auto reader = opened(dir / "s", registry);
  ASSERT_NE(reader, nullptr);
  const auto frame = reader->read(1);
  ASSERT_TRUE(frame) << to_string(frame.error());
  // Frame 1 lies 1 m along x; the colour camera stands 3 cm further to the right.
  EXPECT_NEAR(frame->map_from_camera.origin().xyz.x(), 1.03, 0.015);
}

TEST(Registration, RegisteredDepthStaysAsItIs) {
  const TempDir dir;
  write_pair_of_cameras(dir / "s", kDepthCamera, 0.0);
  ClassRegistry registry;
  const auto reader = opened(dir / "s", registry);
  ASSERT_NE(reader, nullptr);
  EXPECT_EQ(reader->camera(), kDepthCamera);
  EXPECT_EQ(reader->summary().registration, "");
}

}  // namespace
}  // namespace hypermap
