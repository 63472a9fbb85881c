// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the figures share: enlarged parts of images, captions, a scale of colours.
#pragma once

#include "annotation/text_painter.hpp"
#include "hypermap/core/base/image.hpp"
#include "hypermap/viewer_offscreen/rendering/image_rect.hpp"

#include <span>
#include <string>
#include <vector>

namespace hypermap {

inline constexpr Rgb8 kFigurePaper{255, 255, 255};
inline constexpr Rgb8 kFigureInk{33, 38, 45};

/// A part of an image, each of its pixels `scale` x `scale` of the figure's.
struct Enlargement {
  int u_begin = 0;
  int v_begin = 0;
  int width_px = 1;
  int height_px = 1;
  int scale = 1;

  /// A point of the image (corners of pixels are whole) in the figure.
  [[nodiscard]] Eigen::Vector2d to_figure(double u, double v) const {
    return {scale * (u - u_begin), scale * (v - v_begin)};
  }
};

/// The whole of an image, enlarged so that it is not much smaller than `width_px`.
[[nodiscard]] Enlargement whole_image(const ColorImage& image, int width_px);

[[nodiscard]] ColorImage enlarged(const ColorImage& image, const Enlargement& part);

/// `share` of `over` and the rest of `under`.
[[nodiscard]] Rgb8 mixed(Rgb8 under, Rgb8 over, double share);

/// Near is yellow, then green and blue, far violet: 0 and 1 are the ends, what is beyond is them.
[[nodiscard]] Rgb8 distance_color(double share);

/// The outline of a rectangle, in the figure's pixels.
void draw_outline(ColorImage& image,
                  const Eigen::Vector2d& low,
                  const Eigen::Vector2d& high,
                  double width_px,
                  Rgb8 color);

/// Text on a plate of `background` with its upper left corner there, moved into the image, and
/// below what of `taken` would lie under it. Returns where the plate is.
ImageRect write_on_plate(ColorImage& image,
                         const TextPainter& painter,
                         const std::string& text,
                         Eigen::Vector2d corner,
                         const TextStyle& style,
                         Rgb8 background,
                         std::span<const ImageRect> taken);

/// The image over a strip of paper with these lines.
[[nodiscard]] ColorImage with_caption(const ColorImage& image,
                                      const TextPainter& painter,
                                      const std::vector<std::string>& lines);

}  // namespace hypermap
