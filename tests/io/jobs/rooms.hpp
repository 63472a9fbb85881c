// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Small sequences of one place, one after the other.
#pragma once

#include "hypermap/io/jobs/map_many_job.hpp"
#include "support/block_dataset.hpp"
#include "support/text_files.hpp"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace hypermap::test {

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Two frames of a block before a wall, 1.2 m beside those of the room before it, and a minute
/// later: each shows what its neighbours show, too, and no voxel of the wall is in three of them.
inline void write_room(const std::filesystem::path& folder, std::size_t index) {
  write_block_dataset(folder, 2);
  std::string depth;
  std::string poses;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string stamp = std::to_string(100 + 60 * index + i) + ".0 ";
    depth += stamp + "depth/" + std::to_string(100 + i) + ".pgm\n";
    poses += stamp + std::to_string(1.2 * static_cast<double>(index)) + " 0 0 0 0 0 1\n";
  }
  write_text(folder / "depth.txt", depth);
  write_text(folder / "groundtruth.txt", poses);
}

/// Rooms "room0", "room1" ... in the folder.
inline std::vector<ListedSequence> write_rooms(const std::filesystem::path& folder,
                                               std::size_t num_rooms) {
  std::vector<ListedSequence> sequences;
  for (std::size_t i = 0; i < num_rooms; ++i) {
    const std::string name = "room" + std::to_string(i);
    write_room(folder / name, i);
    sequences.push_back({.name = name, .input = folder / name});
  }
  return sequences;
}

/// Their map is `output`.hmap, their parts lie in `output`.parts.
inline MapManyJob job_of_rooms(const std::vector<ListedSequence>& sequences,
                               const std::filesystem::path& output) {
  MapManyJob job{.sequences = sequences,
                 .output = output.string() + ".hmap",
                 .parts = output.string() + ".parts"};
  job.mapping.up_axis = "z";
  return job;
}

}  // namespace hypermap::test
