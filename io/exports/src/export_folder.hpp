// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Exports that write several files into a folder.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>

namespace hypermap {

/// With the folders above. Errors: kIo.
[[nodiscard]] Result<void> make_export_folder(const std::filesystem::path& folder);

/// Whether a folder may be replaced as a whole: it is not there, or all that lies in it are files
/// of an earlier export, by their names. Errors: kInvalidArgument naming what is none, "no <kind>";
/// kIo when it cannot be looked at.
[[nodiscard]] Result<void> require_replaceable(
    const std::filesystem::path& folder,
    std::string_view kind,
    const std::function<bool(const std::string&)>& is_of_export);

/// Names of files, each another one, although what makes classes or layers differ may not stand in
/// a file name: nothing in it may lead elsewhere.
class FileNames {
 public:
  [[nodiscard]] std::string add(std::string_view name);

 private:
  std::set<std::string> taken_;
};

}  // namespace hypermap
