// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Box plots of times as image files.
#pragma once

#include "hypermap/core/base/five_numbers.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/viewer_offscreen/figures/box_plot.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace hypermap::app {

[[nodiscard]] FiveNumbers in_milliseconds(const FiveNumbers& seconds);

/// Draws the rows and writes them as PNG. Errors: those of draw_box_plot; kIo.
[[nodiscard]] Result<void> write_box_plot(const std::filesystem::path& path,
                                          const std::string& title,
                                          const std::string& axis,
                                          const std::vector<BoxPlotRow>& rows);

}  // namespace hypermap::app
