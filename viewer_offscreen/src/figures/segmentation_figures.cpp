// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/figures/segmentation_figures.hpp"

#include "figure_page.hpp"
#include "hypermap/core/base/class_palette.hpp"
#include "hypermap/core/segmentation/masks.hpp"
#include "panel_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr int kFigureWidthPx = 960;
constexpr int kMaxFigureHeightPx = 1100;
constexpr double kMarginShare = 0.35;  ///< Around the detection, as a share of its sides.
constexpr double kLeastMarginPx = 24.0;
constexpr double kDimmed = 0.55;  ///< Of what a step does not keep.
constexpr double kLabelShare = 0.65;
constexpr Rgb8 kBoxColor{255, 255, 255};
constexpr Rgb8 kDroppedColor{110, 20, 20};
constexpr Rgb8 kEdgeColor{255, 140, 0};
constexpr double kNearPlaneM = 0.02;

std::string decimal(double value, int digits) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

/// A part of the image around a box, in whole pixels of it and of the figure.
Enlargement around(const PixelBox& box, const PinholeCamera& camera) {
  const double margin_u = std::max(kLeastMarginPx, kMarginShare * box.width_px());
  const double margin_v = std::max(kLeastMarginPx, kMarginShare * box.height_px());
  const auto clamped = [](double value, int low, int high) {
    return std::clamp(static_cast<int>(std::clamp(value, -1e6, 1e6)), low, high);
  };
  Enlargement part;
  part.u_begin = clamped(box.u_min_px - margin_u, 0, camera.width_px - 1);
  part.v_begin = clamped(box.v_min_px - margin_v, 0, camera.height_px - 1);
  part.width_px =
      clamped(box.u_max_px + margin_u, part.u_begin + 1, camera.width_px) - part.u_begin;
  part.height_px =
      clamped(box.v_max_px + margin_v, part.v_begin + 1, camera.height_px) - part.v_begin;
  part.scale =
      std::max(1, std::min(kFigureWidthPx / part.width_px, kMaxFigureHeightPx / part.height_px));
  return part;
}

std::string name_of(const Detection& detection, const ClassRegistry& classes) {
  const auto best = best_class(detection.class_scores);
  return best ? printable(classes.name(best->id)) : "unknown";
}

/// Colours the pixels of the mask that have a neighbour outside it.
void draw_edge(const MaskImage& mask, Rgb8 color, ColorImage& image) {
  const auto is_in = [&](int u, int v) { return mask.contains(u, v) && mask.at(u, v) != 0; };
  for (int v = 0; v < mask.height_px(); ++v) {
    for (int u = 0; u < mask.width_px(); ++u) {
      const bool is_inner =
          is_in(u - 1, v) && is_in(u + 1, v) && is_in(u, v - 1) && is_in(u, v + 1);
      if (is_in(u, v) && !is_inner) image.at(u, v) = color;
    }
  }
}

ColorImage dimmed(ColorImage image) {
  for (Rgb8& pixel : image.pixels()) pixel = mixed(pixel, {}, kDimmed);
  return image;
}

/// The pixels with a label in its colour, over what is there.
void tint(ColorImage& image, const ColorImage& backdrop, const LabelImage& labels) {
  const ColorImage colors = render_labels(labels, backdrop);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels.pixels()[i] < kLabelNone) continue;
    image.pixels()[i] = mixed(backdrop.pixels()[i], colors.pixels()[i], kLabelShare);
  }
}

void outline_detection(ColorImage& figure, const Enlargement& part, const Detection& detection) {
  const PixelBox& box = detection.box_px;
  draw_outline(figure,
               part.to_figure(box.u_min_px, box.v_min_px),
               part.to_figure(box.u_max_px, box.v_max_px),
               1.5,
               kBoxColor);
}

/// The line between two points of the map as far as it is before the camera.
void draw_edge(ColorImage& figure,
               const Enlargement& part,
               const RgbdFrame& frame,
               const Eigen::Vector3d& from_in_map,
               const Eigen::Vector3d& to_in_map) {
  const Eigen::Isometry3d camera_from_map = frame.map_from_camera.isometry().inverse();
  Eigen::Vector3d from = camera_from_map * from_in_map;
  Eigen::Vector3d to = camera_from_map * to_in_map;
  if (from.z() < to.z()) std::swap(from, to);
  if (from.z() <= kNearPlaneM) return;
  if (to.z() < kNearPlaneM)
    to = from + (from.z() - kNearPlaneM) / (from.z() - to.z()) * (to - from);
  const auto a = frame.camera.project(PointInCamera{from});
  const auto b = frame.camera.project(PointInCamera{to});
  if (!a || !b) return;
  draw_line(figure,
            part.to_figure(a->u_px + 0.5, a->v_px + 0.5),
            part.to_figure(b->u_px + 0.5, b->v_px + 0.5),
            2.0,
            kEdgeColor);
}

void draw_box_edges(ColorImage& figure,
                    const Enlargement& part,
                    const RgbdFrame& frame,
                    const Box& box) {
  const auto corner = [&](unsigned bits) {
    return Eigen::Vector3d((bits & 1U) != 0 ? box.max_in_map.x() : box.min_in_map.x(),
                           (bits & 2U) != 0 ? box.max_in_map.y() : box.min_in_map.y(),
                           (bits & 4U) != 0 ? box.max_in_map.z() : box.min_in_map.z());
  };
  for (unsigned bits = 0; bits < 8; ++bits) {
    for (const unsigned axis : {1U, 2U, 4U}) {
      if ((bits & axis) == 0) draw_edge(figure, part, frame, corner(bits), corner(bits | axis));
    }
  }
}

/// The detection's box, and what of the image the segment's box covers.
PixelBox united_with(PixelBox box, const Box& solid, const RgbdFrame& frame) {
  const Eigen::Isometry3d camera_from_map = frame.map_from_camera.isometry().inverse();
  for (const Eigen::Vector3d& corner : solid.corners()) {
    const auto seen = frame.camera.project(PointInCamera{camera_from_map * corner});
    if (!seen) continue;
    box.u_min_px = std::min(box.u_min_px, seen->u_px);
    box.v_min_px = std::min(box.v_min_px, seen->v_px);
    box.u_max_px = std::max(box.u_max_px, seen->u_px);
    box.v_max_px = std::max(box.v_max_px, seen->v_px);
  }
  return box;
}

std::string step_caption(const SegmentationTrace& trace, std::size_t index) {
  const SegmentationStep& step = trace.steps[index];
  std::string text = std::to_string(index + 1) + " " + step.name + ": " +
                     std::to_string(step.num_points) + " points";
  if (step.num_segments > 0) text += ", " + std::to_string(step.num_segments) + " segments";
  return text;
}

}  // namespace

struct SegmentationFigures::Impl {
  TextPainter painter;
};

Result<SegmentationFigures> SegmentationFigures::create(const std::filesystem::path& font_file) {
  HYPERMAP_ASSIGN_OR_RETURN(TextPainter painter, TextPainter::create(font_file));
  return SegmentationFigures(std::make_unique<Impl>(Impl{std::move(painter)}));
}

SegmentationFigures::SegmentationFigures(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SegmentationFigures::SegmentationFigures(SegmentationFigures&&) noexcept = default;
SegmentationFigures& SegmentationFigures::operator=(SegmentationFigures&&) noexcept = default;
SegmentationFigures::~SegmentationFigures() = default;

ColorImage SegmentationFigures::detections(const RgbdFrame& frame,
                                           const ClassRegistry& classes) const {
  ColorImage backdrop = backdrop_of(frame);
  for (const Detection& detection : frame.detections) {
    if (detection.mask)
      draw_edge(*detection.mask, class_color(name_of(detection, classes)), backdrop);
  }
  const Enlargement part = whole_image(backdrop, kFigureWidthPx);
  ColorImage figure = enlarged(backdrop, part);
  std::vector<ImageRect> tags;
  for (std::size_t i = 0; i < frame.detections.size(); ++i) {
    const Detection& detection = frame.detections[i];
    const std::string name = name_of(detection, classes);
    const Rgb8 color = class_color(name);
    const PixelBox& box = detection.box_px;
    const Eigen::Vector2d low = part.to_figure(box.u_min_px, box.v_min_px);
    draw_outline(figure, low, part.to_figure(box.u_max_px, box.v_max_px), 3.0, color);
    tags.push_back(
        write_on_plate(figure,
                       impl_->painter,
                       std::to_string(i) + " " + name + " " + decimal(detection.score.value(), 2),
                       low,
                       {.height_px = 15, .color = kFigureInk},
                       mixed(color, kFigurePaper, 0.6),
                       tags));
  }
  return with_caption(
      figure,
      impl_->painter,
      {printable(frame.name) + ": " + std::to_string(frame.detections.size()) + " detections"});
}

ColorImage SegmentationFigures::step(const RgbdFrame& frame,
                                     const Detection& detection,
                                     const SegmentationTrace& trace,
                                     std::size_t step) const {
  const ColorImage backdrop = backdrop_of(frame);
  ColorImage image = dimmed(backdrop);
  const LabelImage& labels = trace.steps[step].labels;
  if (step > 0) {
    const LabelImage& before = trace.steps[step - 1].labels;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const bool is_dropped = before.pixels()[i] >= kLabelNone && labels.pixels()[i] < kLabelNone;
      if (is_dropped) image.pixels()[i] = mixed(image.pixels()[i], kDroppedColor, kLabelShare);
    }
  }
  tint(image, backdrop, labels);
  const Enlargement part = around(box_with_mask(detection), frame.camera);
  ColorImage figure = enlarged(image, part);
  outline_detection(figure, part, detection);
  return with_caption(figure, impl_->painter, {step_caption(trace, step)});
}

ColorImage SegmentationFigures::segment(const RgbdFrame& frame,
                                        const Detection& detection,
                                        const Result<Segment>& segment) const {
  const ColorImage backdrop = backdrop_of(frame);
  ColorImage image = dimmed(backdrop);
  if (!segment) {
    const Enlargement part = around(box_with_mask(detection), frame.camera);
    ColorImage figure = enlarged(image, part);
    outline_detection(figure, part, detection);
    return with_caption(figure, impl_->painter, {"no segment: " + segment.error().what});
  }
  LabelImage labels(frame.camera.width_px, frame.camera.height_px, kLabelAbsent);
  for (const std::uint32_t pixel : segment->pixel_indices) labels.pixels()[pixel] = 1;
  tint(image, backdrop, labels);
  const Enlargement part = around(united_with(detection.box_px, segment->box, frame), frame.camera);
  ColorImage figure = enlarged(image, part);
  outline_detection(figure, part, detection);
  draw_box_edges(figure, part, frame, segment->box);
  const Eigen::Vector3d extent = segment->box.extent();
  return with_caption(
      figure,
      impl_->painter,
      {"box " + decimal(extent.x(), 2) + " x " + decimal(extent.y(), 2) + " x " +
           decimal(extent.z(), 2) + " m, " + decimal(segment->distance_m, 2) + " m away",
       std::to_string(segment->points_in_map.size()) + " points, confidence " +
           decimal(segment->box_confidence.value(), 2)});
}

ColorImage SegmentationFigures::panels(const RgbdFrame& frame, const BinnedDepthMap& panels) const {
  return draw_panels(backdrop_of(frame), panels, impl_->painter);
}

ColorImage SegmentationFigures::panels_from_above(const BinnedDepthMap& panels) const {
  return draw_panels_from_above(panels, impl_->painter);
}

}  // namespace hypermap
