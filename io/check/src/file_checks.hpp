// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One check for each kind of file: reads it with its reader and summarises the content.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/check/file_check.hpp"
#include "hypermap/io/dataset/depth_file.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace hypermap {

struct FileSummary {
  std::string summary;
  std::vector<Finding> findings;
};

/// Errors of all: those of the kind's reader.
[[nodiscard]] Result<FileSummary> check_archive(const std::filesystem::path& path,
                                                const FileCheckOptions& options);
[[nodiscard]] Result<FileSummary> check_octree(const std::filesystem::path& path);
/// The description, and the image that it names; one that is absent is a finding.
[[nodiscard]] Result<FileSummary> check_map(const std::filesystem::path& path,
                                            const FileCheckOptions& options);
[[nodiscard]] Result<FileSummary> check_semantic(const std::filesystem::path& path,
                                                 const FileCheckOptions& options);
[[nodiscard]] Result<FileSummary> check_image(const std::filesystem::path& path,
                                              ImageSize expected);
[[nodiscard]] Result<FileSummary> check_depth(const std::filesystem::path& path,
                                              ImageSize expected);
/// TUM lines, Open3D records, one matrix or a matrix a line, by how many numbers the first line
/// has.
[[nodiscard]] Result<FileSummary> check_trajectory(const std::filesystem::path& path);
/// Errors: kInvalidArgument when the stated size is not `expected`.
[[nodiscard]] Result<FileSummary> check_intrinsics(const std::filesystem::path& path,
                                                   ImageSize expected);
[[nodiscard]] Result<FileSummary> check_detections(const std::filesystem::path& path);
/// A file of options, or a bare map configuration as text; files that it names and that are absent
/// are findings, those out of reach errors among them.
[[nodiscard]] Result<FileSummary> check_config(const std::filesystem::path& path, FileReach reach);
/// A folder, every frame of it, or a description (`dataset.yaml`) as text.
[[nodiscard]] Result<FileSummary> check_dataset(const std::filesystem::path& path,
                                                const FileCheckOptions& options);
[[nodiscard]] Result<FileSummary> check_truth(const std::filesystem::path& path);
/// A `.tile` of ours, whose name is a finding where it is not that of its content; a folder of
/// tiles; else one of [sogm]'s public implementation.
[[nodiscard]] Result<FileSummary> check_tile(const std::filesystem::path& path);
[[nodiscard]] Result<FileSummary> check_embedding(const std::filesystem::path& path);
[[nodiscard]] Result<FileSummary> check_cloud(const std::filesystem::path& path);
/// Files and folders that it names and that are absent are findings.
[[nodiscard]] Result<FileSummary> check_sequences(const std::filesystem::path& path);
/// The changes by themselves: whether they fit a layer, that layer tells.
[[nodiscard]] Result<FileSummary> check_update(const std::filesystem::path& path,
                                               const FileCheckOptions& options);
[[nodiscard]] Result<FileSummary> check_zones(const std::filesystem::path& path);
[[nodiscard]] Result<FileSummary> check_vocabulary(const std::filesystem::path& path);
[[nodiscard]] Result<FileSummary> check_places(const std::filesystem::path& path);
/// The index alone; tiles that it names and that are absent are findings.
[[nodiscard]] Result<FileSummary> check_tile_set(const std::filesystem::path& path);

}  // namespace hypermap
