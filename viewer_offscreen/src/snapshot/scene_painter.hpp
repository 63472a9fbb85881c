// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Draws the parts of an image with OpenGL: backdrop, plan, voxels, lines.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"
#include "hypermap/projection/layers/layer_drawing.hpp"
#include "hypermap/viewer_offscreen/rendering/voxel_surface.hpp"
#include "hypermap/viewer_offscreen/snapshot/snapshot_camera.hpp"
#include "rendering/gl_api.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// A colour and how much it covers: 255 is opaque.
struct Paint {
  Rgb8 color;
  std::uint8_t alpha = 255;
};

/// A face as OpenGL gets it.
struct PaintedFace {
  std::array<float, 3> centre_in_map{};  ///< Of the voxel.
  float edge_m = 0.0F;
  Paint paint;
  std::array<std::uint8_t, 4> openness{};  ///< Per corner, as in VoxelFace.
  std::uint8_t direction = 0;              ///< FaceDirection.
  std::array<std::uint8_t, 3> padding{};   ///< Rows of 28 bytes: OpenGL wants multiples of 4.
};
static_assert(sizeof(PaintedFace) == 28);

struct PaintedLine {
  std::array<float, 3> from_in_map{};
  std::array<float, 3> to_in_map{};
  Paint paint;
};
static_assert(sizeof(PaintedLine) == 28);

struct LineStyle {
  double width_px = 2.0;
  bool hidden_by_voxels = true;  ///< False: drawn over everything.
};

/// Draws in the order of the calls, with the current context. The camera must outlive it.
class ScenePainter {
 public:
  /// `pixel_scale`: drawn pixels per pixel of the finished image (supersampling).
  /// Errors: those of make_program.
  [[nodiscard]] static Result<ScenePainter> create(const SnapshotCamera& camera,
                                                   int width_px,
                                                   int height_px,
                                                   int pixel_scale);

  void draw_backdrop(Rgb8 upper, Rgb8 lower) const;
  /// Draws a grid at the given height.
  void draw_grid(const OccupancyGrid& grid, double height_m) const;
  /// Draws coloured cells at the given height.
  void draw_cells(const DrawnCells& cells, double height_m) const;
  /// Fills a polygon with its holes left out.
  void fill(const Polygon& polygon, double height_m, Paint paint) const;
  void draw_faces(std::span<const PaintedFace> faces) const;
  void draw_lines(std::span<const PaintedLine> lines, const LineStyle& style) const;

 private:
  struct Programs {
    GLuint backdrop = 0;
    GLuint grid = 0;
    GLuint flat = 0;
    GLuint faces = 0;
    GLuint lines = 0;
  };

  explicit ScenePainter(const SnapshotCamera& camera) : camera_(&camera) {}
  void use(GLuint program) const;
  [[nodiscard]] int largest_texture_side() const;
  /// Stretches an image of the cells, row 0 first, over the grid.
  void draw_texture(const GridGeometry& geometry, const ColorImage& texture, double height_m) const;
  void draw_triangles(GLenum mode, std::span<const std::array<float, 3>> points) const;

  const SnapshotCamera* camera_;
  Programs programs_;
  GLuint buffer_ = 0;
  double width_px_ = 0.0;
  double height_px_ = 0.0;
  double pixel_scale_ = 1.0;
};

}  // namespace hypermap
