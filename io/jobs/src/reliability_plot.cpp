// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/reliability_plot.hpp"

#include "plot_font.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

constexpr int kPanelPx = 400;
constexpr int kMarginPx = 40;
constexpr int kDotPx = 2;      // a dot of a letter, which has 5 by 7 of them
constexpr int kLetterPx = 12;  // from one letter to the next
constexpr int kGapPx = 6;      // between words and the panel
constexpr int kMarkPx = 4;     // from the middle of a square to its edge
constexpr Rgb8 kPaper{255, 255, 255};
constexpr Rgb8 kGrid{225, 225, 225};
constexpr Rgb8 kFrame{90, 90, 90};
constexpr Rgb8 kGap{170, 170, 170};
constexpr Rgb8 kBlue{31, 119, 180};
constexpr Rgb8 kOrange{220, 110, 10};

/// A square of 0 .. 1 by 0 .. 1 within an image.
class UnitPanel {
 public:
  UnitPanel(ColorImage& image, int left_px) : image_(image), left_px_(left_px) {}

  /// `what` is the name of the axis to the right.
  void draw(const CalibrationReport& report, std::string_view what, Rgb8 color) {
    axes(what, color);
    for (int tenth = 0; tenth <= 10; ++tenth) {
      const Rgb8 shade = tenth % 10 == 0 ? kFrame : kGrid;
      line(0.1 * tenth, 0.0, 0.1 * tenth, 1.0, shade);
      line(0.0, 0.1 * tenth, 1.0, 0.1 * tenth, shade);
    }
    line(0.0, 0.0, 1.0, 1.0, kFrame);
    const CalibrationBin* previous = nullptr;
    for (const CalibrationBin& bin : report.bins) {
      const double p = bin.mean_probability;
      line(p, bin.true_share, p, p, kGap);
      if (previous != nullptr)
        line(previous->mean_probability, previous->true_share, p, bin.true_share, color);
      previous = &bin;
    }
    for (const CalibrationBin& bin : report.bins) mark(bin.mean_probability, bin.true_share, color);
  }

 private:
  /// Words and numbers at the axes.
  void axes(std::string_view what, Rgb8 color) {
    const int below_px = row(0.0) + kGapPx;
    text("0", column(0.0), below_px, kFrame);
    text("0.5", column(0.5) - width_px("0.5") / 2, below_px, kFrame);
    text("1", column(1.0) - width_px("1"), below_px, kFrame);
    const int letter_height_px = 7 * kDotPx;
    const int second_line_px = below_px + letter_height_px + kDotPx;
    text(what, column(0.5) - width_px(what) / 2, second_line_px, color);
    text("share true", column(0.0), row(1.0) - kGapPx - letter_height_px, color);
    for (const auto& [label, at] : {std::pair("0", 0.0), {"0.5", 0.5}, {"1", 1.0}}) {
      text(label, column(0.0) - width_px(label) - 1, row(at) - letter_height_px / 2, kFrame);
    }
  }

  [[nodiscard]] static int width_px(std::string_view words) {
    return kLetterPx * static_cast<int>(words.size());
  }

  void text(std::string_view words, int left_px, int top_px, Rgb8 color) {
    for (const char letter : words) {
      const PlotGlyph glyph = plot_glyph(letter);
      for (int v = 0; v < 7 * kDotPx; ++v) {
        for (int u = 0; u < 5 * kDotPx; ++u) {
          const unsigned dots = glyph.at(static_cast<std::size_t>(v / kDotPx));
          if ((dots >> (4 - u / kDotPx) & 1U) != 0) image_.at(left_px + u, top_px + v) = color;
        }
      }
      left_px += kLetterPx;
    }
  }

  [[nodiscard]] int column(double x) const {
    return left_px_ + static_cast<int>(std::lround(x * kPanelPx));
  }
  [[nodiscard]] static int row(double y) {
    return kMarginPx + static_cast<int>(std::lround((1.0 - y) * kPanelPx));
  }

  void line(double from_x, double from_y, double to_x, double to_y, Rgb8 color) {
    const int steps = 2 * kPanelPx;
    for (int i = 0; i <= steps; ++i) {
      const double share = static_cast<double>(i) / steps;
      image_.at(column(from_x + share * (to_x - from_x)), row(from_y + share * (to_y - from_y))) =
          color;
    }
  }

  void mark(double x, double y, Rgb8 color) {
    for (int v = row(y) - kMarkPx; v <= row(y) + kMarkPx; ++v) {
      for (int u = column(x) - kMarkPx; u <= column(x) + kMarkPx; ++u) image_.at(u, v) = color;
    }
  }

  ColorImage& image_;
  int left_px_;
};

}  // namespace

ColorImage draw_reliability(const CalibrationReport& best_class, const CalibrationReport& real) {
  ColorImage image(2 * kPanelPx + 3 * kMarginPx + 1, kPanelPx + 2 * kMarginPx + 1);
  std::ranges::fill(image.pixels(), kPaper);
  UnitPanel(image, kMarginPx).draw(best_class, "P(best class)", kBlue);
  UnitPanel(image, kPanelPx + 2 * kMarginPx).draw(real, "P(real)", kOrange);
  return image;
}

}  // namespace hypermap
