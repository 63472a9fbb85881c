// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace hypermap::app {

/// Where scenes, presets and dataset descriptions lie: `share/hypermap` beside the installed
/// program, else the project's `data/` that it was built from.
[[nodiscard]] std::filesystem::path data_dir();

}  // namespace hypermap::app
