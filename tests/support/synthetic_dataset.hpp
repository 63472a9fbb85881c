// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Small datasets in every layout that we read, all of the same four frames.
#pragma once

#include "support/text_files.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hypermap::test {

inline constexpr int kSyntheticWidth = 8;
inline constexpr int kSyntheticHeight = 6;
inline constexpr int kSyntheticFrames = 4;

/// A 16-bit PGM in which every pixel is `value`; any grey is white enough for colour as well.
inline std::string pgm16(std::uint16_t value,
                         int width = kSyntheticWidth,
                         int height = kSyntheticHeight) {
  std::string out = "P5\n" + std::to_string(width) + " " + std::to_string(height) + "\n65535\n";
  for (int i = 0; i < width * height; ++i) {
    out.push_back(static_cast<char>(value >> 8U));
    out.push_back(static_cast<char>(value & 0xFFU));
  }
  return out;
}

inline std::string pgm8(std::uint8_t value,
                        int width = kSyntheticWidth,
                        int height = kSyntheticHeight) {
  return "P5\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n" +
         std::string(static_cast<std::size_t>(width * height), static_cast<char>(value));
}

/// Camera to world of frame `i`: i metres along x, nothing turned.
inline std::string pose_rows(int i) {
  return "1 0 0 " + std::to_string(i) + "\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
}

inline std::string padded(int number, std::size_t width) {
  const std::string digits = std::to_string(number);
  return std::string(width - digits.size(), '0') + digits;
}

/// What all layouts hold: depth (i + 1) m, pose i m along x, one chair detected in frame 2.
/// The names of the files of frame 1, for tests that break them.
struct SyntheticDataset {
  std::filesystem::path folder;
  std::string depth_of_1;
  std::string color_of_1;
  std::string pose_of_1;  ///< Empty when poses are lines of one file.
};

inline std::string intrinsics_json(double depth_scale) {
  return "{\"width\": 8, \"height\": 6, \"fx\": 8, \"fy\": 8, \"cx\": 3.5, \"cy\": 2.5, "
         "\"depth_scale\": " +
         std::to_string(depth_scale) + "}";
}

inline std::string chair_in(const std::string& image) {
  return "{\"image\": \"" + image +
         "\", \"detections\": [{\"label\": \"chair\", \"score\": 0.9, \"bbox\": [1, 1, 4, 5]}]}\n";
}

inline SyntheticDataset write_tum(const std::filesystem::path& folder) {
  std::string rgb = "# color images\n";
  std::string depth = "# depth maps\n";
  std::string poses = "# ground truth\n";
  for (int i = 0; i < kSyntheticFrames; ++i) {
    const std::string second = std::to_string(100 + i);
    const std::string index = std::to_string(i);
    rgb.append(second).append(".010 rgb/").append(second).append(".010.pgm\n");
    depth.append(second).append(".000 depth/").append(second).append(".000.pgm\n");
    poses.append(second).append(".005 ").append(index).append(" 0 0 0 0 0 1\n");
    write_text(folder / ("rgb/" + second + ".010.pgm"), pgm8(200));
    write_text(folder / ("depth/" + second + ".000.pgm"),
               pgm16(static_cast<std::uint16_t>(5000 * (i + 1))));
  }
  write_text(folder / "rgb.txt", rgb);
  write_text(folder / "depth.txt", depth);
  write_text(folder / "groundtruth.txt", poses);
  write_text(folder / "intrinsics.json", intrinsics_json(5000));
  write_text(folder / "detections.jsonl", chair_in("rgb/102.010.pgm"));
  return {folder, "depth/101.000.pgm", "rgb/101.010.pgm", ""};
}

inline SyntheticDataset write_7scenes(const std::filesystem::path& folder) {
  for (int i = 0; i < kSyntheticFrames; ++i) {
    const std::string stem = "frame-" + padded(i, 6);
    write_text(folder / (stem + ".color.pgm"), pgm8(200));
    write_text(folder / (stem + ".depth.pgm"), pgm16(static_cast<std::uint16_t>(1000 * (i + 1))));
    write_text(folder / (stem + ".pose.txt"), pose_rows(i));
  }
  write_text(folder / "camera-intrinsics.txt", "8 0 3.5\n0 8 2.5\n0 0 1\n");
  write_text(folder / "detections.jsonl", chair_in("frame-000002.color.pgm"));
  return {folder, "frame-000001.depth.pgm", "frame-000001.color.pgm", "frame-000001.pose.txt"};
}

inline SyntheticDataset write_open3d(const std::filesystem::path& folder) {
  std::string log;
  for (int i = 0; i < kSyntheticFrames; ++i) {
    const std::string name = padded(5 * i, 5);
    write_text(folder / ("image/" + name + ".pgm"), pgm8(200));
    write_text(folder / ("depth/" + name + ".pgm"),
               pgm16(static_cast<std::uint16_t>(1000 * (i + 1))));
    log += std::to_string(5 * i) + " " + std::to_string(5 * i) + " 1\n" + pose_rows(i);
  }
  write_text(folder / "scene/trajectory.log", log);
  write_text(
      folder / "intrinsic.json",
      "{\"width\": 8, \"height\": 6, \"intrinsic_matrix\": [8, 0, 0, 0, 8, 0, 3.5, 2.5, 1]}");
  write_text(folder / "detections.jsonl", chair_in("image/00010.pgm"));
  return {folder, "depth/00005.pgm", "image/00005.pgm", ""};
}

inline SyntheticDataset write_scannet(const std::filesystem::path& folder) {
  for (int i = 0; i < kSyntheticFrames; ++i) {
    const std::string name = std::to_string(i);
    write_text(folder / ("color/" + name + ".pgm"), pgm8(200));
    write_text(folder / ("depth/" + name + ".pgm"),
               pgm16(static_cast<std::uint16_t>(1000 * (i + 1))));
    write_text(folder / ("pose/" + name + ".txt"), pose_rows(i));
  }
  const std::string matrix = "8 0 3.5 0\n0 8 2.5 0\n0 0 1 0\n0 0 0 1\n";
  write_text(folder / "intrinsic/intrinsic_color.txt", matrix);
  write_text(folder / "intrinsic/intrinsic_depth.txt", matrix);
  write_text(folder / "detections.jsonl", chair_in("color/2.pgm"));
  return {folder, "depth/1.pgm", "color/1.pgm", "pose/1.txt"};
}

inline SyntheticDataset write_described(const std::filesystem::path& folder) {
  std::string poses;
  for (int i = 0; i < kSyntheticFrames; ++i) {
    const std::string name = padded(i, 4);
    write_text(folder / ("c/" + name + "_c.pgm"), pgm8(200));
    write_text(folder / ("d/" + name + "_d.pgm"), pgm16(static_cast<std::uint16_t>(100 * (i + 1))));
    // World to camera: the inverse of i metres along x.
    poses += std::to_string(100 + i) + ".5 " + std::to_string(-i) + " 0 0 0 0 0 1\n";
  }
  write_text(folder / "p.txt", poses);
  write_text(folder / "boxes.jsonl", chair_in("c/0002_c.pgm"));
  write_text(folder / "dataset.yaml",
             "name: synthetic\n"
             "intrinsics: {width: 8, height: 6, fx: 8, fy: 8, cx: 3.5, cy: 2.5}\n"
             "depth: d/*_d.pgm\n"
             "depth_scale: 100\n"
             "color: c/*_c.pgm\n"
             "trajectory: p.txt\n"
             "pair_by: order\n"
             "pose_direction: world_to_camera\n"
             "up_axis: -y\n"
             "detections: boxes.jsonl\n");
  return {folder, "d/0001_d.pgm", "c/0001_c.pgm", ""};
}

}  // namespace hypermap::test
