// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Files that a test writes.
#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>

namespace hypermap::test {

/// Makes the folders on the way as well.
inline void write_text(const std::filesystem::path& path, std::string_view text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace hypermap::test
