// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a file of any kind that we read as a whole holds.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/archive_info.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"

#include <filesystem>
#include <optional>
#include <variant>

namespace hypermap {

/// Of a map: layers and extensions. Of a folder with a sequence: what was found in it.
using FileInfo = std::variant<ArchiveInfo, DatasetSummary>;

/// Archives, bare configurations, octrees, map_server maps, folders of tiles and datasets, told
/// apart by content
/// (`find_file_kind`). An octree or a map by itself is told of as an archive with this one part.
///
/// `limits` are those of archives, whose reading `stop` ends; `description` is that of a dataset's
/// folder, from outside it.
/// Errors: those of find_file_kind and of the kind's reader; what is of another kind is read, and
/// refused, as an archive.
[[nodiscard]] Result<Loaded<FileInfo>> describe_file(
    const std::filesystem::path& path,
    const ArchiveLimits& limits = {},
    const StopCheck& stop = {},
    const std::optional<std::filesystem::path>& description = std::nullopt);

}  // namespace hypermap
