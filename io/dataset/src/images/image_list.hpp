// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Files of a sequence, by pattern or from a list, in order.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// One file, and what its name or its line in the list says.
struct ListedFile {
  std::string path;                     ///< Relative to the dataset's folder.
  std::optional<std::uint64_t> number;  ///< Of the name.
  std::optional<Stamp> stamp;           ///< Of the list, or of a name that is a stamp.
};

[[nodiscard]] bool is_pattern(std::string_view text);

/// Whether a path relative to the dataset's folder fits a pattern. Boundary: none fits what is no
/// pattern with one `*` in its last part.
[[nodiscard]] bool fits_pattern(const std::string& path, const std::string& pattern);

/// Files that fit `pattern` (one `*` in its last part), by number, stamp or name in that order of
/// preference. Boundary: a folder that is not there gives none.
/// Errors: kInvalidArgument for a pattern without or with several `*`; kIo; kLimit at 10^6 files;
/// kMalformedFile when two names have one number.
[[nodiscard]] Result<std::vector<ListedFile>> list_image_files(const std::filesystem::path& folder,
                                                               const std::string& pattern);

/// Lines `stamp path`, or only `path`; `#` begins a comment. Files need not exist. By stamp.
/// Errors: kIo; kLimit; kMalformedFile naming the line: no path, a path that leaves the folder, a
/// stamp that is none or occurs twice; some lines with and some without stamp.
[[nodiscard]] Result<std::vector<ListedFile>> read_image_list(const std::filesystem::path& folder,
                                                              const std::string& list);

/// The files of a place: a pattern, a list, or none where it is empty.
/// Errors: of list_image_files and read_image_list.
[[nodiscard]] Result<std::vector<ListedFile>> list_files(const std::filesystem::path& folder,
                                                         const std::string& place);

/// The first run of digits in the last part of a path; none when there is none.
[[nodiscard]] std::optional<std::uint64_t> number_in_name(std::string_view path);

}  // namespace hypermap
