// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A sequence in which a block stands before a wall, large enough to become an object.
#pragma once

#include "support/synthetic_dataset.hpp"
#include "support/text_files.hpp"

#include <cstddef>
#include <filesystem>
#include <string>

namespace hypermap::test {

/// A block of 20 x 20 pixels, 1.5 m away, before a wall 2 m away, in millimetres.
inline std::string block_before_wall() {
  constexpr int kWidth = 64;
  constexpr int kHeight = 48;
  constexpr int kBlockMm = 1500;
  std::string image = pgm16(2000, kWidth, kHeight);
  const std::size_t first = image.size() - std::size_t{2} * kWidth * kHeight;
  for (int v = 14; v < 34; ++v) {
    for (int u = 22; u < 42; ++u) {
      const std::size_t at = first + 2 * static_cast<std::size_t>(v * kWidth + u);
      image[at] = static_cast<char>(kBlockMm / 256);
      image[at + 1] = static_cast<char>(kBlockMm % 256);
    }
  }
  return image;
}

/// Frames at 100 s, 101 s, ..., a millimetre apart, without colour; its z axis is up.
inline void write_block_dataset(const std::filesystem::path& folder, int num_frames) {
  std::string depth;
  std::string poses;
  for (int i = 0; i < num_frames; ++i) {
    const std::string second = std::to_string(100 + i);
    depth.append(second).append(".0 depth/").append(second).append(".pgm\n");
    poses.append(second).append(".0 ").append(std::to_string(0.001 * i)).append(" 0 0 0 0 0 1\n");
    write_text(folder / ("depth/" + second + ".pgm"), block_before_wall());
  }
  write_text(folder / "dataset.yaml",
             "intrinsics: {width: 64, height: 48, fx: 64, fy: 64, cx: 31.5, cy: 23.5}\n"
             "depth: depth.txt\ndepth_scale: 1000\ntrajectory: groundtruth.txt\n");
  write_text(folder / "depth.txt", depth);
  write_text(folder / "groundtruth.txt", poses);
}

/// A line of detections: the block in frame `i`, with `keys` of a detection that is left open.
inline std::string block_seen_as(int i, const std::string& keys) {
  return "{\"timestamp\": \"" + std::to_string(100 + i) + ".0\", \"detections\": [" + keys +
         ", \"bbox\": [21, 13, 43, 35]}]}\n";
}

}  // namespace hypermap::test
