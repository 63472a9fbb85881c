// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Command lines that would write over what they read are wrong.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace hypermap::app {

/// Throws CLI::ValidationError naming `option` when `output` is "-", which names no file here, or
/// one of the `inputs`, by whatever name, or, when an input is a folder, a file of it that is there
/// and is no map: bears no archive's name, or that of a simulation's truth. Nor may it be a file
/// that is there in a subfolder of a dataset, where its images are. Empty names stand for nothing.
void keep_apart(const std::string& option,
                const std::filesystem::path& output,
                const std::vector<std::filesystem::path>& inputs);

/// Throws CLI::ValidationError naming `option` when the folder `output` is that of a dataset.
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
