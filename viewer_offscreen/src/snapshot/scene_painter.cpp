// SPDX-License-Identifier: BSD-3-Clause
#include "scene_painter.hpp"

#include "grid_texture.hpp"
#include "rendering/shaders.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace hypermap {
namespace {

constexpr Rgb8 kFogColor{238, 241, 245};

/// OpenGL takes offsets into buffers as pointers.
const void* byte_offset(std::size_t bytes) {
  return reinterpret_cast<const void*>(bytes);  // NOLINT(performance-no-int-to-ptr)
}

float unit(std::uint8_t channel) {
  return static_cast<float>(channel) / 255.0F;
}

template <class T>
void upload(GLuint buffer, std::span<const T> items) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glBufferData(
      GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(items.size_bytes()), items.data(), GL_STREAM_DRAW);
}

/// A fresh vertex array, so that no attribute of another kind of shape lingers.
void bind_fresh_array() {
  GLuint array = 0;
  glGenVertexArrays(1, &array);
  glBindVertexArray(array);
}

struct Attribute {
  GLuint location = 0;
  GLint size = 0;
  GLenum type = GL_FLOAT;
  GLboolean normalized = GL_FALSE;
  std::size_t offset = 0;
};

/// An attribute of which each instance has one.
void per_instance(const Attribute& attribute, std::size_t stride) {
  glEnableVertexAttribArray(attribute.location);
  glVertexAttribPointer(attribute.location,
                        attribute.size,
                        attribute.type,
                        attribute.normalized,
                        static_cast<GLsizei>(stride),
                        byte_offset(attribute.offset));
  glVertexAttribDivisor(attribute.location, 1);
}

std::array<float, 3> point_at(const Eigen::Vector2d& plan, double height_m) {
  return {static_cast<float>(plan.x()), static_cast<float>(plan.y()), static_cast<float>(height_m)};
}

void load_texture(const ColorImage& image) {
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D,
               0,
               GL_RGB8,
               image.width_px(),
               image.height_px(),
               0,
               GL_RGB,
               GL_UNSIGNED_BYTE,
               image.pixels().data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

std::vector<std::array<float, 3>> points_at(const Ring& ring, double height_m) {
  std::vector<std::array<float, 3>> points;
  points.reserve(ring.size());
  for (const Eigen::Vector2d& point : ring) points.push_back(point_at(point, height_m));
  return points;
}

}  // namespace

Result<ScenePainter> ScenePainter::create(const SnapshotCamera& camera,
                                          int width_px,
                                          int height_px,
                                          int pixel_scale) {
  ScenePainter painter(camera);
  Programs& programs = painter.programs_;
  HYPERMAP_ASSIGN_OR_RETURN(programs.backdrop, make_program(kBackdropVertex, kBackdropFragment));
  HYPERMAP_ASSIGN_OR_RETURN(programs.grid, make_program(kGridVertex, kGridFragment));
  HYPERMAP_ASSIGN_OR_RETURN(programs.flat, make_program(kFlatVertex, kFlatFragment));
  HYPERMAP_ASSIGN_OR_RETURN(programs.faces, make_program(kFaceVertex, kFaceFragment));
  HYPERMAP_ASSIGN_OR_RETURN(programs.lines, make_program(kLineVertex, kLineFragment));
  painter.width_px_ = width_px;
  painter.height_px_ = height_px;
  painter.pixel_scale_ = pixel_scale;
  glGenBuffers(1, &painter.buffer_);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glClearColor(1.0F, 1.0F, 1.0F, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  return painter;
}

void ScenePainter::use(GLuint program) const {
  const Eigen::Matrix4f clip_from_map = camera_->clip_from_map().cast<float>();
  glUseProgram(program);
  glUniformMatrix4fv(
      glGetUniformLocation(program, "clip_from_map"), 1, GL_FALSE, clip_from_map.data());
}

void ScenePainter::draw_backdrop(Rgb8 upper, Rgb8 lower) const {
  bind_fresh_array();
  glUseProgram(programs_.backdrop);
  const auto set_color = [&](const char* name, Rgb8 color) {
    glUniform3f(glGetUniformLocation(programs_.backdrop, name),
                unit(color.r),
                unit(color.g),
                unit(color.b));
  };
  set_color("upper", upper);
  set_color("lower", lower);
  glDisable(GL_DEPTH_TEST);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void ScenePainter::draw_triangles(GLenum mode, std::span<const std::array<float, 3>> points) const {
  bind_fresh_array();
  upload(buffer_, points);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  glDrawArrays(mode, 0, static_cast<GLsizei>(points.size()));
}

int ScenePainter::largest_texture_side() const {
  GLint side = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
  return side;
}

void ScenePainter::draw_grid(const OccupancyGrid& grid, double height_m) const {
  if (grid.geometry().num_cells() == 0) return;
  draw_texture(grid.geometry(), texture_of(grid, largest_texture_side()), height_m);
}

void ScenePainter::draw_cells(const DrawnCells& cells, double height_m) const {
  if (cells.geometry.num_cells() == 0) return;
  draw_texture(cells.geometry, texture_of(cells, largest_texture_side()), height_m);
}

void ScenePainter::draw_texture(const GridGeometry& geometry,
                                const ColorImage& texture,
                                double height_m) const {
  load_texture(texture);
  const double cols = geometry.cols;
  const double rows = geometry.rows;
  const auto corner = [&](double col, double row) {
    return point_at(from_cells(geometry, {col, row}), height_m);
  };
  const std::array<std::array<float, 3>, 4> corners{
      corner(0, 0), corner(cols, 0), corner(0, rows), corner(cols, rows)};
  use(programs_.grid);
  glUniform1i(glGetUniformLocation(programs_.grid, "cells"), 0);
  glDisable(GL_DEPTH_TEST);
  draw_triangles(GL_TRIANGLE_STRIP, corners);
}

void ScenePainter::fill(const Polygon& polygon, double height_m, Paint paint) const {
  if (polygon.outer.empty()) return;
  use(programs_.flat);
  glUniform4f(glGetUniformLocation(programs_.flat, "paint"),
              unit(paint.color.r),
              unit(paint.color.g),
              unit(paint.color.b),
              unit(paint.alpha));
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_STENCIL_TEST);
  // Each ring as a fan turns the stencil over: what is turned over an odd number of times is
  // inside.
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glStencilFunc(GL_ALWAYS, 0, 1);
  glStencilOp(GL_KEEP, GL_KEEP, GL_INVERT);
  draw_triangles(GL_TRIANGLE_FAN, points_at(polygon.outer, height_m));
  for (const Ring& hole : polygon.holes) draw_triangles(GL_TRIANGLE_FAN, points_at(hole, height_m));
  // Paint the inside and leave the stencil as it was.
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glStencilFunc(GL_NOTEQUAL, 0, 1);
  glStencilOp(GL_KEEP, GL_KEEP, GL_ZERO);
  glEnable(GL_BLEND);
  const Rect around = bounds(polygon);
  const std::array<std::array<float, 3>, 4> cover{
      point_at(around.min, height_m),
      point_at({around.max.x(), around.min.y()}, height_m),
      point_at({around.min.x(), around.max.y()}, height_m),
      point_at(around.max, height_m)};
  draw_triangles(GL_TRIANGLE_STRIP, cover);
  glDisable(GL_BLEND);
  glDisable(GL_STENCIL_TEST);
}

void ScenePainter::draw_faces(std::span<const PaintedFace> faces) const {
  if (faces.empty()) return;
  bind_fresh_array();
  upload(buffer_, faces);
  constexpr std::size_t kStride = sizeof(PaintedFace);
  per_instance({0, 4, GL_FLOAT, GL_FALSE, offsetof(PaintedFace, centre_in_map)}, kStride);
  per_instance({1, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(PaintedFace, paint)}, kStride);
  per_instance({2, 4, GL_UNSIGNED_BYTE, GL_FALSE, offsetof(PaintedFace, openness)}, kStride);
  glEnableVertexAttribArray(3);
  glVertexAttribIPointer(3,
                         1,
                         GL_UNSIGNED_BYTE,
                         static_cast<GLsizei>(kStride),
                         byte_offset(offsetof(PaintedFace, direction)));
  glVertexAttribDivisor(3, 1);
  use(programs_.faces);
  const Eigen::Vector3f eye = camera_->eye_in_map().value_or(Eigen::Vector3d::Zero()).cast<float>();
  glUniform3f(glGetUniformLocation(programs_.faces, "fog_from"), eye.x(), eye.y(), eye.z());
  glUniform1f(glGetUniformLocation(programs_.faces, "fog_length"),
              camera_->eye_in_map() ? 9.0F : 0.0F);
  glUniform3f(glGetUniformLocation(programs_.faces, "fog_color"),
              unit(kFogColor.r),
              unit(kFogColor.g),
              unit(kFogColor.b));
  glEnable(GL_DEPTH_TEST);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(faces.size()));
}

void ScenePainter::draw_lines(std::span<const PaintedLine> lines, const LineStyle& style) const {
  if (lines.empty()) return;
  bind_fresh_array();
  upload(buffer_, lines);
  constexpr std::size_t kStride = sizeof(PaintedLine);
  per_instance({0, 3, GL_FLOAT, GL_FALSE, offsetof(PaintedLine, from_in_map)}, kStride);
  per_instance({1, 3, GL_FLOAT, GL_FALSE, offsetof(PaintedLine, to_in_map)}, kStride);
  per_instance({2, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(PaintedLine, paint)}, kStride);
  use(programs_.lines);
  glUniform2f(glGetUniformLocation(programs_.lines, "half_image_px"),
              static_cast<float>(0.5 * width_px_),
              static_cast<float>(0.5 * height_px_));
  glUniform1f(glGetUniformLocation(programs_.lines, "half_width_px"),
              static_cast<float>(0.5 * style.width_px * pixel_scale_));
  if (style.hidden_by_voxels) {
    glEnable(GL_DEPTH_TEST);
  } else {
    glDisable(GL_DEPTH_TEST);
  }
  glDepthMask(GL_FALSE);
  glEnable(GL_BLEND);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(lines.size()));
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
}

}  // namespace hypermap
