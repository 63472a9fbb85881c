// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether a file is what it should be, by the same readers that load it.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/codec/file_kind.hpp"
#include "hypermap/io/dataset/depth_file.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

struct FileCheckOptions {
  std::optional<FileKind> as = std::nullopt;  ///< Insisted on; none: found by content.
  ImageSize size = {};                        ///< What an image must measure; 0: any.
  /// Of a dataset's folder, from outside it; none: what find_layout finds.
  std::optional<std::filesystem::path> description = std::nullopt;
  bool strict = false;        ///< Findings become errors.
  ArchiveLimits limits = {};  ///< Of archives; the sums also of a semantic layer.
  StopCheck stop = {};        ///< Ends the reading of either with kInterrupted.
};

struct FileCheckResult {
  std::optional<FileKind> kind;  ///< None when it could not be found.
  std::string summary;           ///< "2 poses"; empty when the file was refused.
  std::vector<Finding> findings;

  [[nodiscard]] bool is_refused() const;
  /// Of the command line: 0 nothing found, 1 findings, 2 refused content, 3 the system.
  [[nodiscard]] int exit_code() const;
};

/// Reads the whole file by the reader of its kind and discards it.
/// Cost: bounded by the limits of the readers.
[[nodiscard]] FileCheckResult check_file(const std::filesystem::path& path,
                                         const FileCheckOptions& options = {});

}  // namespace hypermap
