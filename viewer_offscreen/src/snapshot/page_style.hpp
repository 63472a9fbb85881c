// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Sizes, colours and type of what is written on a page, and how wide its legend is.
#pragma once

#include "annotations.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace hypermap {

inline constexpr Rgb8 kInk{33, 38, 45};
inline constexpr Rgb8 kFaintInk{106, 115, 125};
inline constexpr double kRowPx = 21.0;
inline constexpr double kNotePx = 18.0;  ///< A line under the subtitle.
inline constexpr double kSwatchPx = 12.0;
inline constexpr double kColumnGapPx = 16.0;
inline constexpr double kScaleBarPx = 180.0;  ///< At most.

/// Styles and lengths at the size of the page.
struct Look {
  double scale = 1.0;

  [[nodiscard]] double px(double length) const { return scale * length; }
  [[nodiscard]] int font_px(double height) const {
    return std::max(9, static_cast<int>(std::lround(scale * height)));
  }
  [[nodiscard]] TextStyle title() const { return {font_px(21.0), kInk, FontWeight::kBold}; }
  [[nodiscard]] TextStyle small() const { return {font_px(13.0), kFaintInk, FontWeight::kRegular}; }
  [[nodiscard]] TextStyle row() const { return {font_px(13.5), kInk, FontWeight::kRegular}; }
  [[nodiscard]] TextStyle heading() const {
    return {font_px(11.5), kFaintInk, FontWeight::kRegular};
  }
  [[nodiscard]] TextStyle label() const { return {font_px(13.0), kInk, FontWeight::kRegular}; }
};

/// Widths of the legend's columns: names, then each number.
struct LegendColumns {
  double name_px = 0.0;
  std::vector<double> number_px;

  [[nodiscard]] double total_px(const Look& look) const {
    const double numbers = std::accumulate(number_px.begin(), number_px.end(), 0.0);
    return look.px(kSwatchPx + 8.0) + name_px + numbers +
           look.px(kColumnGapPx) * static_cast<double>(number_px.size());
  }
};

/// As wide as the widest text of each; long names will be cut.
[[nodiscard]] LegendColumns measure(const TextPainter& text,
                                    const Legend& legend,
                                    const Look& look);

}  // namespace hypermap
