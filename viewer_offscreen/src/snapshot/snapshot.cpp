// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/snapshot/snapshot.hpp"

#include "annotation/text_painter.hpp"
#include "hypermap/viewer_offscreen/rendering/egl_context.hpp"
#include "page_filling.hpp"
#include "rendering/gl_canvas.hpp"
#include "scene_content.hpp"
#include "scene_painter.hpp"
#include "scene_shapes.hpp"

#include <algorithm>
#include <exception>
#include <new>
#include <string>
#include <utility>

namespace hypermap {
namespace {

constexpr Rgb8 kSkyColor{250, 251, 253};
constexpr Rgb8 kGroundColor{229, 234, 240};
constexpr double kBoxLinePx = 2.0;
constexpr std::uint8_t kPolygonAlpha = 190;

/// Lines behind voxels shimmer through, so that a box is seen whole.
void draw_box_lines(const ScenePainter& painter, std::vector<PaintedLine> lines) {
  painter.draw_lines(lines, {.width_px = kBoxLinePx});
  for (PaintedLine& line : lines) line.paint.alpha = 60;
  painter.draw_lines(lines, {.width_px = 0.75 * kBoxLinePx, .hidden_by_voxels = false});
}

/// So that what lies on a table is drawn over it.
std::vector<const SemanticObject*> large_first(std::span<const SemanticObject> objects) {
  const auto size = [](const SemanticObject* object) {
    const Rect around = bounds_of(*object);
    return (around.max - around.min).prod();
  };
  std::vector<const SemanticObject*> order;
  for (const SemanticObject& object : objects) order.push_back(&object);
  std::stable_sort(
      order.begin(), order.end(), [&](const auto* a, const auto* b) { return size(a) > size(b); });
  return order;
}

void draw_semantic(const ScenePainter& painter,
                   std::span<const SemanticObject> objects,
                   const ClassPalette& palette,
                   double height_m) {
  for (const SemanticObject* object : large_first(objects)) {
    const Rgb8 color = palette.color_of(object->name);
    for (const Polygon& part : object->parts) {
      painter.fill(part, height_m, {color, kPolygonAlpha});
      painter.draw_lines(paint_outline(part, height_m, {color}),
                         {.width_px = 2.0, .hidden_by_voxels = false});
    }
  }
}

/// Everything but text, from the floor up.
Result<void> draw_scene(const SnapshotScene& scene,
                        const SnapshotLayers& layers,
                        const VisibleVoxels& voxels,
                        const ClassColors& colors,
                        const SnapshotCamera& camera,
                        const ScenePainter& painter) {
  painter.draw_backdrop(kSkyColor, kGroundColor);
  if (layers.occupancy && scene.occupancy)
    painter.draw_grid(known_part(*scene.occupancy), voxels.floor_m);
  if (layers.overlay) {
    for (const DrawnCells& cells : scene.overlay.cells) painter.draw_cells(cells, voxels.floor_m);
  }
  if (camera.pixels_per_m()) {
    painter.draw_lines(paint_metric_grid(points_to_frame(scene, layers, voxels, TopView{}),
                                         voxels.floor_m,
                                         *camera.pixels_per_m()),
                       {.width_px = 1.0, .hidden_by_voxels = false});
  }
  if (layers.semantic) draw_semantic(painter, scene.semantic, scene.palette, voxels.floor_m);
  if (layers.overlay) {
    painter.draw_lines(paint_overlay_lines(scene.overlay.lines, voxels.floor_m),
                       {.width_px = 2.0, .hidden_by_voxels = false});
  }
  if (layers.voxels) {
    HYPERMAP_ASSIGN_OR_RETURN(const auto faces, paint_voxels(voxels, colors, camera));
    painter.draw_faces(faces);
  }
  if (layers.trajectory) {
    painter.draw_lines(paint_trajectory(scene.trajectory_in_map), {.width_px = 2.0});
  }
  if (layers.objects) draw_box_lines(painter, paint_boxes(scene.objects, colors));
  return {};
}

/// Says so where the image has letters that no font here has.
void note_missing_letters(Annotations& annotations, const TextPainter& text) {
  const bool has_all =
      text.can_write(annotations.title) &&
      std::all_of(annotations.labels.begin(),
                  annotations.labels.end(),
                  [&](const MapLabel& label) { return text.can_write(label.text); }) &&
      std::all_of(annotations.legend.rows.begin(),
                  annotations.legend.rows.end(),
                  [&](const LegendRow& row) { return text.can_write(row.name); });
  if (!has_all)
    annotations.notes.emplace_back("no font here has all letters (Debian: fonts-noto-cjk)");
}

Result<ColorImage> render(const SnapshotScene& scene, const SnapshotOptions& options) {
  HYPERMAP_ASSIGN_OR_RETURN(const EglContext context, EglContext::create());
  HYPERMAP_ASSIGN_OR_RETURN(const TextPainter text, TextPainter::create(options.font_file));

  const ClassRegistry registry = drawn_classes(scene);
  const SnapshotLayers layers = drawn_layers(scene, options);
  const VisibleVoxels voxels = layers.voxels ? visible_voxels(scene, options) : VisibleVoxels{};
  const ClassColors colors(registry, scene.palette);
  Annotations annotations = options.annotations
                                ? annotations_of(scene, options, layers, voxels, registry, colors)
                                : Annotations{};
  note_missing_letters(annotations, text);
  const PagePlan plan = plan_page(text, annotations, options);
  const auto framed = points_to_frame(scene, layers, voxels, options.view);
  const SnapshotCamera camera =
      options.annotations ? fill_page(options, plan, framed, points_drawn(scene, layers, voxels))
                          : SnapshotCamera::frame(options, framed, plan.canvas);

  const int drawn_width_px = options.width_px * options.supersampling;
  const int drawn_height_px = options.height_px * options.supersampling;
  HYPERMAP_ASSIGN_OR_RETURN(const GlCanvas canvas,
                            GlCanvas::create(drawn_width_px, drawn_height_px));
  HYPERMAP_ASSIGN_OR_RETURN(
      const ScenePainter painter,
      ScenePainter::create(camera, drawn_width_px, drawn_height_px, options.supersampling));
  HYPERMAP_TRY(draw_scene(scene, layers, voxels, colors, camera, painter));
  HYPERMAP_ASSIGN_OR_RETURN(ColorImage image, canvas.read());
  if (options.supersampling > 1) image = averaged(image, options.supersampling);
  if (!options.annotations) return image;
  return annotated(std::move(image), text, annotations, plan, camera);
}

}  // namespace

Result<ColorImage> render_snapshot(const SnapshotScene& scene, const SnapshotOptions& options) {
  HYPERMAP_TRY(validate(options));
  try {
    return render(scene, options);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for the image");
  } catch (const std::exception& error) {  // OpenCV, while it writes text
    return fail(ErrorCode::kUnavailable, std::string("the image cannot be drawn: ") + error.what());
  }
}

}  // namespace hypermap
