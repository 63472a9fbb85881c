// SPDX-License-Identifier: BSD-3-Clause
#include "scene_painter.hpp"

#include "rendering/shaders.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace hypermap {
namespace {

constexpr Rgb8 kUnknownColor{214, 219, 226};
constexpr Rgb8 kFreeColor{255, 255, 255};
constexpr Rgb8 kOccupiedColor{44, 52, 66};
constexpr Rgb8 kFogColor{238, 241, 245};

/// OpenGL takes offsets into buffers as pointers.
const void* byte_offset(std::size_t bytes) {
  return reinterpret_cast<const void*>(bytes);  // NOLINT(performance-no-int-to-ptr)
}

float unit(std::uint8_t channel) {
  return static_cast<float>(channel) / 255.0F;
}

template <class T>
void upload(const GlApi& gl, GLuint buffer, std::span<const T> items) {
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
  gl.BufferData(
      GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(items.size_bytes()), items.data(), GL_STREAM_DRAW);
}

/// A fresh vertex array, so that no attribute of another kind of shape lingers.
void bind_fresh_array(const GlApi& gl) {
  GLuint array = 0;
  gl.GenVertexArrays(1, &array);
  gl.BindVertexArray(array);
}

struct Attribute {
  GLuint location = 0;
  GLint size = 0;
  GLenum type = GL_FLOAT;
  GLboolean normalized = GL_FALSE;
  std::size_t offset = 0;
};

/// An attribute of which each instance has one.
void per_instance(const GlApi& gl, const Attribute& attribute, std::size_t stride) {
  gl.EnableVertexAttribArray(attribute.location);
  gl.VertexAttribPointer(attribute.location,
                         attribute.size,
                         attribute.type,
                         attribute.normalized,
                         static_cast<GLsizei>(stride),
                         byte_offset(attribute.offset));
  gl.VertexAttribDivisor(attribute.location, 1);
}

std::array<float, 3> point_at(const Eigen::Vector2d& plan, double height_m) {
  return {static_cast<float>(plan.x()), static_cast<float>(plan.y()), static_cast<float>(height_m)};
}

std::uint8_t blend(std::uint8_t from, std::uint8_t to, double share) {
  return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
}

/// The picture of a grid, not larger than a texture can be: of merged cells the fullest counts.
ColorImage texture_of(const OccupancyGrid& grid, int largest_side) {
  const GridGeometry& geometry = grid.geometry();
  const int step = (std::max(geometry.cols, geometry.rows) + largest_side - 1) / largest_side;
  Image<std::int8_t> merged(
      (geometry.cols + step - 1) / step, (geometry.rows + step - 1) / step, kUnknownCell);
  for (int row = 0; row < geometry.rows; ++row) {
    for (int col = 0; col < geometry.cols; ++col) {
      std::int8_t& cell = merged.at(col / step, row / step);
      cell = std::max(cell, grid.at({col, row}));
    }
  }
  ColorImage texture(merged.width_px(), merged.height_px());
  std::transform(
      merged.pixels().begin(), merged.pixels().end(), texture.pixels().begin(), occupancy_color);
  return texture;
}

/// The picture of coloured cells, not larger than a texture can be: of merged cells the first
/// counts.
ColorImage texture_of(const DrawnCells& cells, int largest_side) {
  const GridGeometry& geometry = cells.geometry;
  const int step = (std::max(geometry.cols, geometry.rows) + largest_side - 1) / largest_side;
  ColorImage texture((geometry.cols + step - 1) / step, (geometry.rows + step - 1) / step);
  for (int row = 0; row < texture.height_px(); ++row) {
    for (int col = 0; col < texture.width_px(); ++col) {
      texture.at(col, row) = cells.colors[geometry.index({col * step, row * step})];
    }
  }
  return texture;
}

void load_texture(const GlApi& gl, const ColorImage& picture) {
  GLuint texture = 0;
  gl.GenTextures(1, &texture);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.TexImage2D(GL_TEXTURE_2D,
                0,
                GL_RGB8,
                picture.width_px(),
                picture.height_px(),
                0,
                GL_RGB,
                GL_UNSIGNED_BYTE,
                picture.pixels().data());
  gl.GenerateMipmap(GL_TEXTURE_2D);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

std::vector<std::array<float, 3>> points_at(const Ring& ring, double height_m) {
  std::vector<std::array<float, 3>> points;
  points.reserve(ring.size());
  for (const Eigen::Vector2d& point : ring) points.push_back(point_at(point, height_m));
  return points;
}

}  // namespace

Rgb8 occupancy_color(std::int8_t occupancy) {
  if (occupancy < 0) return kUnknownColor;
  const double share = occupancy / 100.0;
  return {blend(kFreeColor.r, kOccupiedColor.r, share),
          blend(kFreeColor.g, kOccupiedColor.g, share),
          blend(kFreeColor.b, kOccupiedColor.b, share)};
}

Result<ScenePainter> ScenePainter::create(
    const GlApi& gl, const SnapshotCamera& camera, int width_px, int height_px, int pixel_scale) {
  ScenePainter painter(gl, camera);
  Programs& programs = painter.programs_;
  HYPERMAP_ASSIGN_OR_RETURN(programs.backdrop,
                            make_program(gl, kBackdropVertex, kBackdropFragment));
  HYPERMAP_ASSIGN_OR_RETURN(programs.grid, make_program(gl, kGridVertex, kGridFragment));
  HYPERMAP_ASSIGN_OR_RETURN(programs.flat, make_program(gl, kFlatVertex, kFlatFragment));
  HYPERMAP_ASSIGN_OR_RETURN(programs.faces, make_program(gl, kFaceVertex, kFaceFragment));
  HYPERMAP_ASSIGN_OR_RETURN(programs.lines, make_program(gl, kLineVertex, kLineFragment));
  painter.width_px_ = width_px;
  painter.height_px_ = height_px;
  painter.pixel_scale_ = pixel_scale;
  gl.GenBuffers(1, &painter.buffer_);
  gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl.ClearColor(1.0F, 1.0F, 1.0F, 1.0F);
  gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  return painter;
}

void ScenePainter::use(GLuint program) const {
  const Eigen::Matrix4f clip_from_map = camera_->clip_from_map().cast<float>();
  gl_->UseProgram(program);
  gl_->UniformMatrix4fv(
      gl_->GetUniformLocation(program, "clip_from_map"), 1, GL_FALSE, clip_from_map.data());
}

void ScenePainter::draw_backdrop(Rgb8 upper, Rgb8 lower) const {
  bind_fresh_array(*gl_);
  gl_->UseProgram(programs_.backdrop);
  const auto set_color = [&](const char* name, Rgb8 color) {
    gl_->Uniform3f(gl_->GetUniformLocation(programs_.backdrop, name),
                   unit(color.r),
                   unit(color.g),
                   unit(color.b));
  };
  set_color("upper", upper);
  set_color("lower", lower);
  gl_->Disable(GL_DEPTH_TEST);
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
}

void ScenePainter::draw_triangles(GLenum mode, std::span<const std::array<float, 3>> points) const {
  bind_fresh_array(*gl_);
  upload(*gl_, buffer_, points);
  gl_->EnableVertexAttribArray(0);
  gl_->VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  gl_->DrawArrays(mode, 0, static_cast<GLsizei>(points.size()));
}

int ScenePainter::largest_texture_side() const {
  GLint side = 0;
  gl_->GetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
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
  load_texture(*gl_, texture);
  const double cols = geometry.cols;
  const double rows = geometry.rows;
  const auto corner = [&](double col, double row) {
    return point_at(from_cells(geometry, {col, row}), height_m);
  };
  const std::array<std::array<float, 3>, 4> corners{
      corner(0, 0), corner(cols, 0), corner(0, rows), corner(cols, rows)};
  use(programs_.grid);
  gl_->Uniform1i(gl_->GetUniformLocation(programs_.grid, "cells"), 0);
  gl_->Disable(GL_DEPTH_TEST);
  draw_triangles(GL_TRIANGLE_STRIP, corners);
}

void ScenePainter::fill(const Polygon& polygon, double height_m, Paint paint) const {
  if (polygon.outer.empty()) return;
  use(programs_.flat);
  gl_->Uniform4f(gl_->GetUniformLocation(programs_.flat, "paint"),
                 unit(paint.color.r),
                 unit(paint.color.g),
                 unit(paint.color.b),
                 unit(paint.alpha));
  gl_->Disable(GL_DEPTH_TEST);
  gl_->Enable(GL_STENCIL_TEST);
  // Each ring as a fan turns the stencil over: what is turned over an odd number of times is
  // inside.
  gl_->ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  gl_->StencilFunc(GL_ALWAYS, 0, 1);
  gl_->StencilOp(GL_KEEP, GL_KEEP, GL_INVERT);
  draw_triangles(GL_TRIANGLE_FAN, points_at(polygon.outer, height_m));
  for (const Ring& hole : polygon.holes) draw_triangles(GL_TRIANGLE_FAN, points_at(hole, height_m));
  // Paint the inside and leave the stencil as it was.
  gl_->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl_->StencilFunc(GL_NOTEQUAL, 0, 1);
  gl_->StencilOp(GL_KEEP, GL_KEEP, GL_ZERO);
  gl_->Enable(GL_BLEND);
  const Rect around = bounds(polygon);
  const std::array<std::array<float, 3>, 4> cover{
      point_at(around.min, height_m),
      point_at({around.max.x(), around.min.y()}, height_m),
      point_at({around.min.x(), around.max.y()}, height_m),
      point_at(around.max, height_m)};
  draw_triangles(GL_TRIANGLE_STRIP, cover);
  gl_->Disable(GL_BLEND);
  gl_->Disable(GL_STENCIL_TEST);
}

void ScenePainter::draw_faces(std::span<const PaintedFace> faces) const {
  if (faces.empty()) return;
  bind_fresh_array(*gl_);
  upload(*gl_, buffer_, faces);
  constexpr std::size_t kStride = sizeof(PaintedFace);
  per_instance(*gl_, {0, 4, GL_FLOAT, GL_FALSE, offsetof(PaintedFace, centre_in_map)}, kStride);
  per_instance(*gl_, {1, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(PaintedFace, paint)}, kStride);
  per_instance(*gl_, {2, 4, GL_UNSIGNED_BYTE, GL_FALSE, offsetof(PaintedFace, openness)}, kStride);
  gl_->EnableVertexAttribArray(3);
  gl_->VertexAttribIPointer(3,
                            1,
                            GL_UNSIGNED_BYTE,
                            static_cast<GLsizei>(kStride),
                            byte_offset(offsetof(PaintedFace, direction)));
  gl_->VertexAttribDivisor(3, 1);
  use(programs_.faces);
  const Eigen::Vector3f eye = camera_->eye_in_map().value_or(Eigen::Vector3d::Zero()).cast<float>();
  gl_->Uniform3f(gl_->GetUniformLocation(programs_.faces, "fog_from"), eye.x(), eye.y(), eye.z());
  gl_->Uniform1f(gl_->GetUniformLocation(programs_.faces, "fog_length"),
                 camera_->eye_in_map() ? 9.0F : 0.0F);
  gl_->Uniform3f(gl_->GetUniformLocation(programs_.faces, "fog_color"),
                 unit(kFogColor.r),
                 unit(kFogColor.g),
                 unit(kFogColor.b));
  gl_->Enable(GL_DEPTH_TEST);
  gl_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(faces.size()));
}

void ScenePainter::draw_lines(std::span<const PaintedLine> lines, const LineStyle& style) const {
  if (lines.empty()) return;
  bind_fresh_array(*gl_);
  upload(*gl_, buffer_, lines);
  constexpr std::size_t kStride = sizeof(PaintedLine);
  per_instance(*gl_, {0, 3, GL_FLOAT, GL_FALSE, offsetof(PaintedLine, from_in_map)}, kStride);
  per_instance(*gl_, {1, 3, GL_FLOAT, GL_FALSE, offsetof(PaintedLine, to_in_map)}, kStride);
  per_instance(*gl_, {2, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(PaintedLine, paint)}, kStride);
  use(programs_.lines);
  gl_->Uniform2f(gl_->GetUniformLocation(programs_.lines, "half_picture_px"),
                 static_cast<float>(0.5 * width_px_),
                 static_cast<float>(0.5 * height_px_));
  gl_->Uniform1f(gl_->GetUniformLocation(programs_.lines, "half_width_px"),
                 static_cast<float>(0.5 * style.width_px * pixel_scale_));
  if (style.hidden_by_voxels) {
    gl_->Enable(GL_DEPTH_TEST);
  } else {
    gl_->Disable(GL_DEPTH_TEST);
  }
  gl_->DepthMask(GL_FALSE);
  gl_->Enable(GL_BLEND);
  gl_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(lines.size()));
  gl_->Disable(GL_BLEND);
  gl_->DepthMask(GL_TRUE);
}

}  // namespace hypermap
