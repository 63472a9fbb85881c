// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One judge for each kind of file: reads it with its reader and says what it holds.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/dataset/depth_file.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace hypermap {

struct Verdict {
  std::string summary;
  std::vector<Finding> findings;
};

/// Errors of all: those of the kind's reader.
[[nodiscard]] Result<Verdict> judge_archive(const std::filesystem::path& path);
[[nodiscard]] Result<Verdict> judge_octree(const std::filesystem::path& path);
/// The description, and the picture that it names; one that is absent is a finding.
[[nodiscard]] Result<Verdict> judge_map(const std::filesystem::path& path);
[[nodiscard]] Result<Verdict> judge_semantic(const std::filesystem::path& path);
[[nodiscard]] Result<Verdict> judge_image(const std::filesystem::path& path, PictureSize expected);
[[nodiscard]] Result<Verdict> judge_depth(const std::filesystem::path& path, PictureSize expected);
/// TUM lines, Open3D records or one matrix, by how many numbers the first line has.
[[nodiscard]] Result<Verdict> judge_trajectory(const std::filesystem::path& path);
/// Errors: kInvalidArgument when the stated size is not `expected`.
[[nodiscard]] Result<Verdict> judge_intrinsics(const std::filesystem::path& path,
                                               PictureSize expected);
[[nodiscard]] Result<Verdict> judge_detections(const std::filesystem::path& path);
/// A file of options, or a bare map configuration as text; files that it names and that are absent
/// are findings.
[[nodiscard]] Result<Verdict> judge_config(const std::filesystem::path& path);
/// A folder, every frame of it, or a description (`dataset.yaml`) as text.
[[nodiscard]] Result<Verdict> judge_dataset(const std::filesystem::path& path);

}  // namespace hypermap
