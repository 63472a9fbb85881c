// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Box plots: a row for each sample, on one logarithmic axis.
///
/// Source: [smap] C.7, figures 5.4 to 5.7. Deviation: whiskers reach the ends, so that no outlier
/// needs a dot; rows instead of columns, so that names are read without turning.
#pragma once

#include "hypermap/core/base/five_numbers.hpp"
#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/result.hpp"

#include <filesystem>
#include <span>
#include <string>

namespace hypermap {

struct BoxPlotRow {
  std::string name;
  FiveNumbers numbers;
};

/// Each row's box from quartile to quartile with its median, which also stands in numbers at its
/// right, and whiskers to minimum and maximum; a line for each power of ten.
/// `axis` says what and in which unit. Boundary: what is 0 or less is at the axis' lower end;
/// without rows, or with nothing above 0, the axis is 0.1 to 1. Errors: as
/// SegmentationFigures::create.
[[nodiscard]] Result<ColorImage> draw_box_plot(const std::string& title,
                                               const std::string& axis,
                                               std::span<const BoxPlotRow> rows,
                                               const std::filesystem::path& font_file = {});

}  // namespace hypermap
