// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether a file is what it should be, by the same readers that load it.
#pragma once

#include "hypermap/core/result.hpp"
#include "hypermap/io/depth_file.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// Kinds of files (and folders) that we read.
enum class FileKind : std::uint8_t {
  kArchive,
  kOctree,
  kMap,  ///< map_server YAML with its picture.
  kImage,
  kDepth,
  kSemantic,  ///< A list of names and polygons.
  kTrajectory,
  kIntrinsics,
  kDetections,
  kConfig,  ///< A bare map configuration, or a file of options.
  kDataset,
};

/// The names of the command line, in the order of the enumerators.
[[nodiscard]] std::span<const std::string_view> file_kind_names();
[[nodiscard]] std::string_view name_of(FileKind kind);
/// Errors: kInvalidArgument with the names there are.
[[nodiscard]] Result<FileKind> file_kind(std::string_view name);

/// What a file most likely is: a folder is a dataset; `.hmap`, `.ot` and `.bt` are what they say;
/// else its first 64 KiB decide, and where they do not (empty, comments only) its extension.
///
/// Boundary: a 16-bit picture of one channel is taken for depth. A broken file is given the kind
/// that it seems to be, so that the reader of that kind can say what is wrong. Errors: kIo;
/// kUnsupported when nothing fits.
[[nodiscard]] Result<FileKind> find_file_kind(const std::filesystem::path& path);

struct FileCheckOptions {
  std::optional<FileKind> as = std::nullopt;  ///< Insisted on; none: found by content.
  PictureSize size = {};                      ///< What a picture must measure; 0: any.
  bool strict = false;                        ///< Findings become errors.
};

struct FileJudgement {
  std::optional<FileKind> kind;  ///< None when it could not be found.
  std::string summary;           ///< "2 poses"; empty when the file was refused.
  std::vector<Finding> findings;

  [[nodiscard]] bool is_refused() const;
  /// Of the command line: 0 nothing found, 1 findings, 2 refused content, 3 the system.
  [[nodiscard]] int exit_code() const;
};

/// Reads the file as its kind asks, whole, and throws it away.
/// Cost: bounded by the limits of the readers.
[[nodiscard]] FileJudgement check_file(const std::filesystem::path& path,
                                       const FileCheckOptions& options = {});

}  // namespace hypermap
