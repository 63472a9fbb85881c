// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether files are those that they were, by what is in them.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"

#include <filesystem>
#include <span>
#include <string>

namespace hypermap {

/// Hash of a file's bytes, as `InputHash` gives it. Errors: kIo; kInterrupted when `stop`, asked
/// for each piece, says so. Cost: reads it once, a MiB at a time.
[[nodiscard]] Result<std::string> content_hash(const std::filesystem::path& path,
                                               const StopCheck& stop = {});

/// Hash of the names and bytes of all regular files below a folder, in the order of their names;
/// links are followed, a folder that holds itself once. What lies at or below a path of `left_out`
/// does not count. Errors: kIo, kInterrupted.
[[nodiscard]] Result<std::string> folder_hash(const std::filesystem::path& folder,
                                              std::span<const std::filesystem::path> left_out = {},
                                              const StopCheck& stop = {});

}  // namespace hypermap
