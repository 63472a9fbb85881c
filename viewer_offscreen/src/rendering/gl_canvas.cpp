// SPDX-License-Identifier: BSD-3-Clause
#include "gl_canvas.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

namespace hypermap {
namespace {

constexpr GLint kSamples = 4;

void attach_buffer(GLenum format, GLenum place, int samples, int width_px, int height_px) {
  GLuint buffer = 0;
  glGenRenderbuffers(1, &buffer);
  glBindRenderbuffer(GL_RENDERBUFFER, buffer);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width_px, height_px);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, buffer);
}

GLuint bind_new_framebuffer() {
  GLuint framebuffer = 0;
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  return framebuffer;
}

GLint integer(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

}  // namespace

Result<GlCanvas> GlCanvas::create(int width_px, int height_px) {
  const GLint largest = integer(GL_MAX_RENDERBUFFER_SIZE);
  if (std::max(width_px, height_px) > largest) {
    return fail(ErrorCode::kUnavailable,
                "OpenGL draws at most " + std::to_string(largest) + " pixels a side here, not " +
                    std::to_string(std::max(width_px, height_px)));
  }
  GlCanvas canvas;
  canvas.width_px_ = width_px;
  canvas.height_px_ = height_px;
  canvas.resolved_ = bind_new_framebuffer();
  attach_buffer(GL_RGBA8, GL_COLOR_ATTACHMENT0, 0, width_px, height_px);
  canvas.drawn_ = bind_new_framebuffer();
  const GLint samples = std::min(kSamples, integer(GL_MAX_SAMPLES));
  attach_buffer(GL_RGBA8, GL_COLOR_ATTACHMENT0, samples, width_px, height_px);
  attach_buffer(GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL_ATTACHMENT, samples, width_px, height_px);
  HYPERMAP_TRY(check_gl("making room for the image"));
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    return fail(ErrorCode::kUnavailable, "OpenGL cannot draw into memory here");
  }
  glViewport(0, 0, width_px, height_px);
  return canvas;
}

Result<ColorImage> GlCanvas::read() const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_);
  glBlitFramebuffer(
      0, 0, width_px_, height_px_, 0, 0, width_px_, height_px_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  ColorImage upside_down(width_px_, height_px_);
  glReadPixels(0, 0, width_px_, height_px_, GL_RGB, GL_UNSIGNED_BYTE, upside_down.pixels().data());
  HYPERMAP_TRY(check_gl("reading the image"));
  ColorImage image(width_px_, height_px_);
  for (int v = 0; v < height_px_; ++v) {
    const auto row = upside_down.pixels().subspan(upside_down.index(0, height_px_ - 1 - v),
                                                  static_cast<std::size_t>(width_px_));
    std::copy(row.begin(), row.end(), image.pixels().subspan(image.index(0, v)).begin());
  }
  return image;
}

ColorImage averaged(const ColorImage& image, int factor) {
  ColorImage out(image.width_px() / factor, image.height_px() / factor);
  const auto mean = [area = static_cast<unsigned>(factor * factor)](unsigned sum) {
    return static_cast<std::uint8_t>((sum + area / 2U) / area);
  };
  for (int v = 0; v < out.height_px(); ++v) {
    for (int u = 0; u < out.width_px(); ++u) {
      std::array<unsigned, 3> sum{};
      for (int k = 0; k < factor * factor; ++k) {
        const Rgb8 pixel = image.at(u * factor + k % factor, v * factor + k / factor);
        sum[0] += pixel.r;
        sum[1] += pixel.g;
        sum[2] += pixel.b;
      }
      out.at(u, v) = {mean(sum[0]), mean(sum[1]), mean(sum[2])};
    }
  }
  return out;
}

}  // namespace hypermap
