// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Our segmentation: what continues outside the box is background.
#include "segmentation/background_planes.hpp"
#include "segmentation/segmentation_policies.hpp"
#include "segmentation/surface_choice.hpp"
#include "segmentation/voxel_grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hypermap {
namespace {

/// A cell with fewer neighbours of the thing hangs in the air between two surfaces.
constexpr int kLeastNeighbours = 3;

/// Per cell the plane that it lies on, counted from 1; 0 on none.
std::vector<std::uint8_t> plane_of_cells(const DepthWindow& window,
                                         const std::vector<Plane>& planes,
                                         const ForegroundOptions& options) {
  std::vector<std::uint8_t> kind(window.size(), 0);
  for (int y = 0; y < window.height(); ++y) {
    for (int x = 0; x < window.width(); ++x) {
      const std::size_t cell = window.cell(x, y);
      if (window.depth_m[cell] == 0.0F) continue;
      const Eigen::Vector3f point = window.point_in_camera(x, y);
      const auto plane = std::find_if(
          planes.begin(), planes.end(), [&](const Plane& p) { return lies_on(p, point, options); });
      if (plane != planes.end()) kind[cell] = static_cast<std::uint8_t>(plane - planes.begin() + 1);
    }
  }
  return kind;
}

/// Cells outside the detection's mask are no part of it, whatever their depth.
void apply_mask(DepthWindow& window, const MaskImage& mask) {
  for (int y = 0; y < window.height(); ++y) {
    for (int x = 0; x < window.width(); ++x) {
      if (mask.at(x + window.rect.u_begin, y + window.rect.v_begin) != 0) continue;
      window.depth_m[window.cell(x, y)] = 0.0F;
    }
  }
}

/// 1 on cells of the box that belong to chosen surfaces and do not hang in the air.
std::vector<std::uint8_t> cells_of_thing(const DepthWindow& window,
                                         const DepthComponents& labelled,
                                         const ComponentIds& chosen) {
  std::vector<std::uint8_t> all(window.size(), 0);
  for (const std::uint32_t id : chosen) {
    for_each_cell_of(window, labelled, id, [&](int x, int y) { all[window.cell(x, y)] = 1; });
  }
  std::vector<std::uint8_t> firm = all;
  for (int y = 0; y < window.height(); ++y) {
    for (int x = 0; x < window.width(); ++x) {
      if (all[window.cell(x, y)] == 0) continue;
      int neighbours = -1;  // the cell itself
      for (int ny = std::max(0, y - 1); ny <= std::min(window.height() - 1, y + 1); ++ny) {
        for (int nx = std::max(0, x - 1); nx <= std::min(window.width() - 1, x + 1); ++nx) {
          neighbours += all[window.cell(nx, ny)];
        }
      }
      if (neighbours < kLeastNeighbours) firm[window.cell(x, y)] = 0;
    }
  }
  return firm;
}

PixelCloud cloud_of(const RgbdFrame& frame,
                    const DepthWindow& window,
                    const std::vector<std::uint8_t>& is_thing) {
  PixelCloud cloud;
  for (int y = 0; y < window.height(); ++y) {
    for (int x = 0; x < window.width(); ++x) {
      if (is_thing[window.cell(x, y)] == 0) continue;
      cloud.pixels.push_back(static_cast<std::uint32_t>(
          frame.depth_m.index(x + window.rect.u_begin, y + window.rect.v_begin)));
      cloud.points_in_camera.push_back(window.point_in_camera(x, y));
    }
  }
  return cloud;
}

/// One point per voxel, the voxels as small as wanted or as large as the number of points asks.
std::vector<Eigen::Vector3f> thinned(const PixelCloud& cloud, const ForegroundOptions& options) {
  double spacing_m = options.point_spacing_m;
  std::vector<Eigen::Vector3f> points = voxel_grid(cloud.points_in_camera, spacing_m).centroids;
  const auto most = static_cast<std::size_t>(options.max_points);
  while (points.size() > most) {
    const double excess = static_cast<double>(points.size()) / static_cast<double>(most);
    spacing_m *= 1.05 * std::sqrt(excess);
    points = voxel_grid(cloud.points_in_camera, spacing_m).centroids;
  }
  return points;
}

/// Writes down the steps of this policy, when somebody looks.
class Notes {
 public:
  Notes(StepRecorder* recorder, const RgbdFrame& frame, const DepthWindow& window)
      : recorder_(recorder) {
    if (recorder_ == nullptr) return;
    for (int v = window.rect.v_begin; v < window.rect.v_end; ++v) {
      for (int u = window.rect.u_begin; u < window.rect.u_end; ++u) {
        pixels_.push_back(static_cast<std::uint32_t>(frame.depth_m.index(u, v)));
      }
    }
  }

  /// `label_of(cell)` for each cell of the window; cells of a label >= 0 are counted.
  template <class LabelOf>
  void step(const char* name, std::size_t num_segments, LabelOf label_of) {
    if (recorder_ == nullptr) return;
    std::size_t num_points = 0;
    for (std::size_t cell = 0; cell < pixels_.size(); ++cell) num_points += label_of(cell) >= 0;
    recorder_->record(name, num_points, num_segments, pixels_, label_of);
  }

 private:
  StepRecorder* recorder_;
  std::vector<std::uint32_t> pixels_;
};

}  // namespace

Result<Segment> segment_by_foreground(const RgbdFrame& frame,
                                      const Detection& detection,
                                      const GeometricSegmentationOptions& options,
                                      StepRecorder* recorder) {
  const ForegroundOptions& foreground = options.foreground;
  DepthWindow window = make_depth_window(frame, detection, options);
  if (window.box.empty()) return nothing_left("crop");
  if (detection.mask) apply_mask(window, *detection.mask);
  Notes notes(recorder, frame, window);
  const auto if_measured = [&](std::size_t cell, std::int32_t label) {
    return window.depth_m[cell] > 0.0F ? label : kLabelAbsent;
  };
  notes.step("window", 0, [&](std::size_t cell) { return if_measured(cell, 1); });

  const Eigen::Matrix3f upright_from_camera =
      frame.map_from_camera.isometry().linear().cast<float>();
  const std::vector<Plane> planes =
      background_planes(window, upright_from_camera.row(2).transpose(), foreground);
  const std::vector<std::uint8_t> kind = plane_of_cells(window, planes, foreground);
  notes.step(
      "planes", planes.size(), [&](std::size_t cell) { return if_measured(cell, kind[cell]); });

  const DepthComponents labelled = connected_components(window, kind, foreground);
  notes.step("surfaces", labelled.components.size(), [&](std::size_t cell) {
    return if_measured(cell, static_cast<std::int32_t>(labelled.of_cell[cell]) + 1);
  });

  const ComponentIds chosen = choose_surfaces(window, labelled, upright_from_camera, foreground);
  const std::vector<std::uint8_t> is_thing = cells_of_thing(window, labelled, chosen);
  notes.step("thing", 1, [&](std::size_t cell) { return is_thing[cell] != 0 ? 1 : kLabelAbsent; });

  PixelCloud cloud = cloud_of(frame, window, is_thing);
  if (cloud.pixels.size() < static_cast<std::size_t>(foreground.min_pixels)) {
    return nothing_left("thing");
  }
  const std::vector<Eigen::Vector3f> points = thinned(cloud, foreground);
  return describe(frame, std::move(cloud.pixels), points, options);
}

}  // namespace hypermap
