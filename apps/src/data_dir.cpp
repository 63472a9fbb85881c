// SPDX-License-Identifier: BSD-3-Clause
#include "data_dir.hpp"

namespace hypermap::app {

std::filesystem::path data_dir() {
  std::error_code no_link;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", no_link);
  if (!no_link) {
    auto installed = program.parent_path().parent_path() / "share" / "hypermap";
    if (std::filesystem::exists(installed, no_link)) return installed;
  }
  return HYPERMAP_BUILD_DATA_DIR;
}

}  // namespace hypermap::app
