// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/sensor_models/detection_model.hpp"

#include "class_layers.hpp"
#include "ground_view.hpp"
#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/core/segmentation/depth_cloud.hpp"
#include "hypermap/core/segmentation/masks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace hypermap {
namespace {

constexpr OptionRow kDetectionModelRows[] = {
    option::section<&DetectionModelOptions::evidence>("evidence"),
    option::section<&DetectionModelOptions::heights>("heights"),
    option::number<&DetectionModelOptions::max_range_m>(
        "max_range_m",
        option::above(0.0, 100.0),
        {.unit = "m", .effect = "Feet and cells beyond are left out."}),
    option::number<&DetectionModelOptions::foot_share>(
        "foot_share",
        option::above(0.0, 1.0),
        {.effect = "A mask's foot is what it has in so much of its height, from below."}),
    option::number<&DetectionModelOptions::max_length_m>(
        "max_length_m",
        option::above(0.0, 10.0),
        {.unit = "m", .effect = "Objects reach no farther away from the camera."}),
};

/// The lower edge of what was detected, in pixels.
struct FootEdge {
  double u_min_px = 0.0;
  double u_max_px = 0.0;
  double v_px = 0.0;
};

/// The rows and columns that a mask has pixels in, of those from `v_begin` on.
PixelRect foot_of_mask(const MaskImage& mask, int v_begin) {
  PixelRect rect;
  for (int v = v_begin; v < mask.height_px(); ++v) {
    for (int u = 0; u < mask.width_px(); ++u) {
      if (mask.at(u, v) != 0) rect = united(rect, {u, v, u + 1, v + 1});
    }
  }
  return rect;
}

/// None where the image cuts it off, or there is nothing.
std::optional<FootEdge> foot_edge(const Detection& detection,
                                  const PinholeCamera& camera,
                                  double foot_share) {
  FootEdge edge{detection.box_px.u_min_px, detection.box_px.u_max_px, detection.box_px.v_max_px};
  if (detection.mask) {
    const PixelRect whole = bounds_of(*detection.mask);
    if (whole.empty()) return std::nullopt;
    const int num_rows = std::max(1, static_cast<int>(std::lround(foot_share * whole.height())));
    const PixelRect foot = foot_of_mask(*detection.mask, whole.v_end - num_rows);
    edge = {static_cast<double>(foot.u_begin),
            static_cast<double>(foot.u_end),
            static_cast<double>(foot.v_end)};
  }
  const bool is_cut = edge.v_px >= camera.height_px - 1.0;
  if (is_cut || !(edge.u_min_px < edge.u_max_px)) return std::nullopt;
  return edge;
}

/// Whether depth, where there is some just above the edge's middle, lies on the ground.
bool may_stand_there(const FootEdge& edge, const GroundView& view, const RgbdFrame& frame) {
  if (frame.depth_m.empty()) return true;
  const int u = std::clamp(static_cast<int>(std::floor((edge.u_min_px + edge.u_max_px) / 2.0)),
                           0,
                           frame.depth_m.width_px() - 1);
  const int v =
      std::clamp(static_cast<int>(std::ceil(edge.v_px)) - 1, 0, frame.depth_m.height_px() - 1);
  const float measured_m = frame.depth_m.at(u, v);
  return !is_measured(measured_m) || view.is_near_ground(u, v, measured_m);
}

/// What an object of this foot covers of the ground.
std::optional<Polygon> footprint_of(const FootEdge& edge,
                                    const GroundView& view,
                                    const Eigen::Vector2d& eye,
                                    double max_length_m) {
  constexpr double kHalfPixel =
      0.5;  // edges of boxes count from a pixel's corner, rays from its centre
  const double v_px = edge.v_px - kHalfPixel;
  const auto left = view.on_ground({edge.u_min_px - kHalfPixel, v_px});
  const auto right = view.on_ground({edge.u_max_px - kHalfPixel, v_px});
  if (!left || !right) return std::nullopt;
  const Eigen::Vector2d away = ((*left + *right) / 2.0 - eye).normalized();
  const Eigen::Vector2d length = std::min((*right - *left).norm(), max_length_m) * away;
  const std::array<Eigen::Vector2d, 4> corners{
      *left, *right, Eigen::Vector2d(*left + length), Eigen::Vector2d(*right + length)};
  auto hull = convex_hull(corners);
  if (!hull) return std::nullopt;  // a foot right below the camera
  return std::move(*hull);
}

/// Against every class, where the ground itself is seen.
void add_seen_ground(ClassLayers& layers,
                     const GroundView& view,
                     const RgbdFrame& frame,
                     LogOddsSteps free) {
  if (frame.depth_m.empty()) return;
  for (const CellInView& seen : view.cells_in_view()) {
    if (view.is_ground(seen, frame.depth_m)) layers.set_all(seen.cell, free);
  }
}

void add_detection(ClassLayers& layers,
                   const GroundView& view,
                   const RgbdFrame& frame,
                   const Detection& detection,
                   const DetectionModelOptions& options) {
  const auto edge = foot_edge(detection, frame.camera, options.foot_share);
  if (!edge || !may_stand_there(*edge, view, frame)) return;
  const Eigen::Vector2d eye = frame.map_from_camera.origin().xyz.head<2>();
  const auto footprint = footprint_of(*edge, view, eye, options.max_length_m);
  if (!footprint) return;
  const ClassId id = best_class(detection.class_scores)->id;
  const LogOdds hit = detection.score.value() * LogOdds::of(options.evidence.p_hit);
  for_each_covered_cell(view.geometry(), *footprint, [&](Cell cell, double covered) {
    layers.set(id, cell, std::max(layers.at(id, cell), to_steps(covered * hit)));
  });
}

}  // namespace

const OptionTable& option_table(const DetectionModelOptions&) {
  static constexpr OptionTable kTable{kDetectionModelRows};
  return kTable;
}

Result<void> validate(const DetectionModelOptions& options) {
  return check_options(options);
}

Result<DetectionModel> DetectionModel::create(ClassRegistry classes,
                                              DetectionModelOptions options) {
  HYPERMAP_TRY(validate(options));
  HYPERMAP_TRY(check_has_classes(classes));
  return DetectionModel(std::move(classes), std::move(options));
}

Result<std::vector<SensorGrid>> DetectionModel::grids(const RgbdFrame& frame) const {
  HYPERMAP_TRY(validate(frame));
  using Grids = std::vector<SensorGrid>;
  return guarded(ErrorCode::kInvalidArgument, "the frame", [&]() -> Result<Grids> {
    const GroundRange range{options_.heights, options_.evidence.resolution_m, options_.max_range_m};
    HYPERMAP_ASSIGN_OR_RETURN(const GroundView view,
                              GroundView::create(frame.camera, frame.map_from_camera, range));
    HYPERMAP_ASSIGN_OR_RETURN(
        ClassLayers layers,
        ClassLayers::create(classes_, {options_.parent, options_.frame_id}, view.geometry()));
    add_seen_ground(layers, view, frame, to_steps(LogOdds::of(options_.evidence.p_free)));
    for (const Detection& detection : frame.detections) {
      const auto best = best_class(detection.class_scores);
      if (!best || !classes_.contains(best->id)) continue;
      add_detection(layers, view, frame, detection, options_);
    }
    return std::move(layers).cropped();
  });
}

}  // namespace hypermap
