// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Command lines that would write over what they read are wrong.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hypermap::app {

/// What of a dataset an output may take the place of.
enum class MayReplace : std::uint8_t { kNothing, kDetections };

/// Why the output may not be written: it is part of a dataset (`dataset_file`). None: it is none.
[[nodiscard]] std::optional<std::string> dataset_fault(const std::filesystem::path& output,
                                                       MayReplace may = MayReplace::kNothing);

/// Throws CLI::ValidationError naming `option` when `output` is "-", which names no file here, is
/// part of a dataset (`dataset_fault`), or is one of the `inputs`, by whatever name. In an input
/// that is a folder and does not say what belongs to it, whatever is there and bears another suffix
/// than maps is part of it. Empty names stand for nothing.
void keep_apart(const std::string& option,
                const std::filesystem::path& output,
                const std::vector<std::filesystem::path>& inputs,
                MayReplace may = MayReplace::kNothing);

/// Throws CLI::ValidationError naming `option` when `output` is one of the `others` that the
/// command writes, by whatever name. Empty names stand for nothing.
void keep_unlike(const std::string& option,
                 const std::filesystem::path& output,
                 const std::vector<std::filesystem::path>& others);

/// Throws CLI::ValidationError naming `option` when the folder `output` is that of a dataset, or
/// one in which it has images or would look for them.
void keep_out_of_datasets(const std::string& option, const std::filesystem::path& output);

/// The error of a later file, with the files that were written before it.
[[nodiscard]] Error with_written(Error error, const std::vector<std::filesystem::path>& files);

/// Whether the file ends in `suffix`, upper and lower case alike, or has none: that is no promise.
[[nodiscard]] bool has_suffix(const std::filesystem::path& file, const std::string& suffix);

/// Throws CLI::ValidationError naming `option` when `output` has another suffix (`has_suffix`).
void keep_suffix(const std::string& option,
                 const std::filesystem::path& output,
                 const std::string& suffix);

}  // namespace hypermap::app
