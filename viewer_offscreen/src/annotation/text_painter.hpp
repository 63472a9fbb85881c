// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Writes and draws on finished images: text, plates, lines.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/viewer_offscreen/annotation/label_layout.hpp"

#include <Eigen/Core>

#include <filesystem>
#include <memory>
#include <string>

namespace hypermap {

enum class FontWeight { kRegular, kBold };

struct TextStyle {
  int height_px = 14;  ///< Of the font.
  Rgb8 color{33, 38, 45};
  FontWeight weight = FontWeight::kRegular;
};

/// UTF-8 text in a TrueType font; what holds Chinese, Japanese or Korean letters in a font that has
/// them, where there is one. Move-only.
class TextPainter {
 public:
  /// `font_file` empty: DejaVu Sans where systems keep it.
  /// Errors: kUnavailable naming the places looked at; kNotFound when `font_file` is no font;
  /// kOutOfMemory.
  [[nodiscard]] static Result<TextPainter> create(const std::filesystem::path& font_file);

  TextPainter(TextPainter&&) noexcept;
  TextPainter& operator=(TextPainter&&) noexcept;
  ~TextPainter();

  /// Whether no Chinese, Japanese or Korean letter of the text lacks a font. A font file that was
  /// named is taken to have all.
  [[nodiscard]] bool can_write(const std::string& text) const;
  [[nodiscard]] double width_px(const std::string& text, const TextStyle& style) const;
  /// The text, or as much of it as is not wider, with an ellipsis.
  [[nodiscard]] std::string fitted(const std::string& text,
                                   const TextStyle& style,
                                   double max_width_px) const;
  /// `x_px` is the left end, `baseline_px` the line that letters stand on.
  void write(ColorImage& image,
             const std::string& text,
             double x_px,
             double baseline_px,
             const TextStyle& style) const;

 private:
  struct Impl;
  explicit TextPainter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// A filled rectangle with round corners, blended by `opacity`.
void draw_plate(
    ColorImage& image, const ImageRect& rect, double radius_px, Rgb8 color, double opacity);

/// An antialiased line.
void draw_line(ColorImage& image,
               const Eigen::Vector2d& from_px,
               const Eigen::Vector2d& to_px,
               double width_px,
               Rgb8 color);

/// An antialiased filled circle.
void draw_disc(ColorImage& image, const Eigen::Vector2d& centre_px, double radius_px, Rgb8 color);

}  // namespace hypermap
