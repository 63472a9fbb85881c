// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Memory that OpenGL draws into, with four samples a pixel.
#pragma once

#include "gl_api.hpp"
#include "hypermap/core/base/image.hpp"

namespace hypermap {

/// Bound for drawing from creation on; its buffers go with the context.
/// Requires: that EglContext is current in each call.
class GlCanvas {
 public:
  /// Errors: kUnavailable when the driver cannot draw images of this size; kOutOfMemory.
  [[nodiscard]] static Result<GlCanvas> create(int width_px, int height_px);

  /// What was drawn, samples averaged. Errors: those of check_gl.
  [[nodiscard]] Result<ColorImage> read() const;

 private:
  int width_px_ = 0;
  int height_px_ = 0;
  GLuint drawn_ = 0;     ///< Framebuffer with several samples a pixel, depth and stencil.
  GLuint resolved_ = 0;  ///< Framebuffer with one.
};

/// The image at 1 / factor of its sides: each pixel the mean of factor x factor.
/// Requires: both sides are multiples of factor.
[[nodiscard]] ColorImage averaged(const ColorImage& image, int factor);

}  // namespace hypermap
