// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Exports that write several files into a folder.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <filesystem>
#include <set>
#include <string>
#include <string_view>

namespace hypermap {

/// With the folders above. Errors: kIo.
[[nodiscard]] Result<void> make_export_folder(const std::filesystem::path& folder);

/// Names of files, each another one, although what makes classes or layers differ may not stand in
/// a file name: nothing in it may lead elsewhere.
class FileNames {
 public:
  [[nodiscard]] std::string add(std::string_view name);

 private:
  std::set<std::string> taken_;
};

}  // namespace hypermap
