// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Our segmentation: what continues outside the box is background, and a mask shows the object.
#include "background_surfaces.hpp"
#include "flat_top.hpp"
#include "masked_surfaces.hpp"
#include "pixel_shares.hpp"
#include "segmentation/background_planes.hpp"
#include "segmentation/plane_growth.hpp"
#include "segmentation/plane_slices.hpp"
#include "segmentation/voxel_grid.hpp"
#include "segmentation_policies.hpp"
#include "surface_choice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

namespace hypermap {
namespace {

/// Share of the box that a patch of a plane covers at least to be taken for a part of the object.
constexpr double kPatchShare = 0.03;
/// And how much of its edge is its own outline: a seat is in front of the floor, a floor is not.
constexpr double kPatchMinOutline = 0.7;
/// A cell with fewer neighbours of the object hangs in the air between two surfaces.
constexpr int kLeastNeighbours = 3;
/// Less of a box that is mostly unmeasured is not the object.
constexpr double kLeastSpan = 0.15;
/// Distance of the points of a top that was seen and not measured, along the line of sight.
constexpr float kUnmeasuredSpacingM = 0.02F;

/// A plane found outside may go on through the object: the seats of two chairs are of one height.
/// What lies on it inside the box, and is not joined with the outside, is no background unless it
/// is seen through the object.
std::vector<std::uint8_t> without_patches(const DepthWindow& window,
                                          const DepthComponents& labelled,
                                          std::vector<std::uint8_t> plane_of_cell,
                                          const ForegroundOptions& options) {
  const double least = kPatchShare * window.box.width() * window.box.height();
  std::vector<std::uint8_t> is_freed(labelled.components.size(), 0);
  for (std::size_t id = 0; id < is_freed.size(); ++id) {
    const DepthComponent& component = labelled.components[id];
    const bool is_inside = component.outside_share() <= options.part_max_outside &&
                           component.outline_share() >= kPatchMinOutline;
    is_freed[id] = component.kind != 0 && component.num_in_box >= least && is_inside ? 1 : 0;
  }
  if (std::find(is_freed.begin(), is_freed.end(), 1) == is_freed.end()) return plane_of_cell;
  for (std::size_t cell = 0; cell < window.size(); ++cell) {
    const std::uint32_t id = labelled.of_cell[cell];
    if (id != kNoComponent && is_freed[id] != 0) plane_of_cell[cell] = 0;
  }
  return plane_of_cell;
}

/// The surfaces of a window whose planes are found, of several detections' objects each its own.
DepthComponents surfaces_of(const DepthWindow& window,
                            const std::vector<std::uint8_t>& plane_of_cell,
                            const ForegroundOptions& options) {
  DepthComponents labelled = connected_components(window, plane_of_cell);
  const auto freed = without_patches(window, labelled, plane_of_cell, options);
  if (freed != plane_of_cell) labelled = connected_components(window, freed);
  const auto shared = shared_out(window, labelled, freed);
  if (shared != freed) labelled = connected_components(window, shared);
  return labelled;
}

void add_to(std::span<std::uint8_t> sums, const std::uint8_t* values) {
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sums[i] = static_cast<std::uint8_t>(sums[i] + values[i]);
  }
}

/// 1 on cells of the box that belong to chosen surfaces and do not hang in the air.
std::vector<std::uint8_t> cells_of_object(const DepthWindow& window,
                                          const DepthComponents& labelled,
                                          const ComponentIds& chosen) {
  std::vector<std::uint8_t> all(window.size(), 0);
  for (const std::uint32_t id : chosen) {
    for_each_cell_of(window, labelled, id, [&](int x, int y) { all[window.cell(x, y)] = 1; });
  }
  const auto width = static_cast<std::size_t>(window.width());
  std::vector<std::uint8_t> firm(window.size(), 0);
  std::vector<std::uint8_t> column(width + 2, 0);  // sums over three rows, nothing on both sides
  for (int y = 0; y < window.height(); ++y) {
    const std::uint8_t* row = &all[window.cell(0, y)];
    std::copy(row, row + width, column.begin() + 1);
    if (y > 0) add_to(std::span(column).subspan(1, width), row - width);
    if (y + 1 < window.height()) add_to(std::span(column).subspan(1, width), row + width);
    std::uint8_t* into = &firm[window.cell(0, y)];
    for (std::size_t x = 0; x < width; ++x) {
      const int with_itself = column[x] + column[x + 1] + column[x + 2];
      into[x] = with_itself > kLeastNeighbours ? row[x] : std::uint8_t{0};
    }
  }
  return firm;
}

/// Whether the object may rather be what the box does not measure: a detector's box is tight around
/// its object, and these cells span little of it and are fewer than those without depth; what is
/// merely out of range has depth. A cup nearer than the sensor measures is not the table's edge.
bool is_beside_the_unmeasured(const RgbdFrame& frame,
                              const DepthWindow& window,
                              const std::vector<std::uint8_t>& is_object) {
  if (window.is_masked()) return false;
  PixelRect spanned;
  std::size_t num_object = 0;
  std::size_t num_unmeasured = 0;
  for (int y = window.box.v_begin; y < window.box.v_end; ++y) {
    for (int x = window.box.u_begin; x < window.box.u_end; ++x) {
      const std::size_t cell = window.cell(x, y);
      const float depth_m = frame.depth_m.at(window.pixel_u(x), window.pixel_v(y));
      num_unmeasured += is_measured(depth_m) ? 0U : 1U;
      if (is_object[cell] == 0) continue;
      ++num_object;
      spanned = united(spanned, {x, y, x + 1, y + 1});
    }
  }
  const double span = static_cast<double>(spanned.width()) * spanned.height();
  const double box = static_cast<double>(window.box.width()) * window.box.height();
  return span < kLeastSpan * box && num_object < num_unmeasured;
}

/// What a window shows, and 1 on the cells of the object.
struct FoundObject {
  DepthComponents surfaces;
  std::vector<std::uint8_t> is_object;
};

FoundObject find_object(const RgbdFrame& frame,
                        const DepthWindow& window,
                        const std::vector<Plane>& planes,
                        const std::vector<std::uint8_t>& plane_of_cell,
                        const ForegroundOptions& options) {
  const auto found_in = [&](DepthComponents surfaces, const ComponentIds& chosen) {
    std::vector<std::uint8_t> is_object = cells_of_object(window, surfaces, chosen);
    return FoundObject{std::move(surfaces), std::move(is_object)};
  };
  if (window.is_masked()) {
    DepthComponents surfaces = connected_components(window, kinds_in_mask(window, plane_of_cell));
    const ComponentIds chosen = masked_surfaces(window, surfaces, plane_of_cell, planes, options);
    return found_in(std::move(surfaces), chosen);
  }
  DepthComponents surfaces = surfaces_of(window, plane_of_cell, options);
  const ComponentIds chosen = choose_surfaces(frame, window, surfaces, planes, options);
  return found_in(std::move(surfaces), chosen);
}

/// The measured pixels of the box in the object's cells, on the same surface as their cell.
std::vector<std::uint32_t> pixels_of(const RgbdFrame& frame,
                                     const Detection& detection,
                                     const DepthWindow& window,
                                     const std::vector<std::uint8_t>& is_object) {
  std::vector<std::uint32_t> pixels;
  const PixelRect box =
      detection.mask ? window.rect
                     : pixels_in(detection.box_px, frame.camera.width_px, frame.camera.height_px);
  const auto take = [&](std::size_t cell, std::size_t pixel) {
    if (detection.mask && detection.mask->pixels()[pixel] == 0) return;
    const float depth_m = frame.depth_m.pixels()[pixel];
    const bool on_surface = std::abs(depth_m - window.depth_m[cell]) <= window.step_m[cell];
    if (is_measured(depth_m) && on_surface) pixels.push_back(static_cast<std::uint32_t>(pixel));
  };
  for (int v = box.v_begin; v < box.v_end; ++v) {
    for (int u = box.u_begin; u < box.u_end;) {  // cell by cell
      const std::size_t cell = window.cell_of_pixel(u, v);
      const int end = std::min(box.u_end, window.end_of_cell(u));
      for (; is_object[cell] != 0 && u < end; ++u) take(cell, frame.depth_m.index(u, v));
      u = end;
    }
  }
  return pixels;
}

/// One point per voxel, the voxels as small as wanted or as large as the number of points asks.
std::vector<Eigen::Vector3f> points_of(const DepthWindow& window,
                                       const std::vector<std::uint8_t>& is_object,
                                       const Eigen::Matrix3f& gravity_aligned_from_camera,
                                       const ForegroundOptions& options) {
  std::vector<Eigen::Vector3f> all =
      unmeasured_top(window, is_object, gravity_aligned_from_camera, kUnmeasuredSpacingM);
  double area_m2 = 0.0;
  const double cell_slope =
      window.width() > 1 ? static_cast<double>(window.slope_x[1] - window.slope_x[0]) : 0.0;
  for (int y = window.box.v_begin; y < window.box.v_end; ++y) {
    for (int x = window.box.u_begin; x < window.box.u_end; ++x) {
      if (is_object[window.cell(x, y)] == 0) continue;
      all.push_back(window.point_in_camera(x, y));
      const double edge_m = cell_slope * static_cast<double>(all.back().z());
      area_m2 += edge_m * edge_m;
    }
  }
  const auto most = static_cast<std::size_t>(options.max_points);
  double spacing_m = std::max(options.point_spacing_m, std::sqrt(area_m2 / options.max_points));
  const auto widen_for = [&](std::size_t count) {
    const double excess = static_cast<double>(count) / static_cast<double>(most);
    if (count > most) spacing_m *= 1.05 * std::sqrt(excess);
  };
  // The first spacing mostly leaves too many: to count them is less work than to thin.
  widen_for(count_voxels(all, spacing_m));
  for (;;) {
    std::vector<Eigen::Vector3f> thinned = voxel_grid(all, spacing_m).centroids;
    if (thinned.size() <= most) return thinned;
    widen_for(thinned.size());
  }
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
        cells_.push_back(window.cell_of_pixel(u, v));
      }
    }
  }

  /// `label_of(cell)` is the label of a cell; pixels of a label >= 0 are counted.
  template <class LabelOf>
  void step(const char* name, std::size_t num_segments, LabelOf label_of) {
    if (recorder_ == nullptr) return;
    std::size_t num_points = 0;
    for (const std::size_t cell : cells_) num_points += label_of(cell) >= 0 ? 1U : 0U;
    recorder_->record(name, num_points, num_segments, pixels_, [&](std::size_t i) {
      return label_of(cells_[i]);
    });
  }

 private:
  StepRecorder* recorder_;
  std::vector<std::uint32_t> pixels_;
  std::vector<std::size_t> cells_;
};

}  // namespace

Result<Segment> segment_by_foreground(const RgbdFrame& frame,
                                      const Detection& detection,
                                      std::span<const Detection> others,
                                      const GeometricSegmentationOptions& options,
                                      StepRecorder* recorder) {
  const ForegroundOptions& foreground = options.foreground;
  const DepthWindow window = make_depth_window(frame, detection, others, options);
  if (window.box.empty()) return nothing_left(detection.mask ? "mask" : "window");
  Notes notes(recorder, frame, window);
  const auto if_measured = [&](std::size_t cell, std::int32_t label) {
    return window.depth_m[cell] > 0.0F ? label : kLabelAbsent;
  };
  notes.step("window", 0, [&](std::size_t cell) { return if_measured(cell, 1); });

  const Eigen::Matrix3f gravity_aligned_from_camera =
      frame.map_from_camera.isometry().linear().cast<float>();
  const std::vector<Plane> planes = background_planes(window, upright_view(frame), foreground);
  const std::vector<std::uint8_t> kind =
      without_slices(window, planes, plane_of_cells(window, planes, foreground));
  notes.step(
      "planes", planes.size(), [&](std::size_t cell) { return if_measured(cell, kind[cell]); });

  FoundObject found = find_object(frame, window, planes, kind, foreground);
  BackgroundCells background =
      background_surfaces(window, found.surfaces, found.is_object, foreground);
  const auto grown = grown_planes(window, planes, kind, found.is_object, foreground);
  if (grown != kind) found = find_object(frame, window, planes, grown, foreground);
  if (window.is_masked()) {
    notes.step("mask", 1, [&](std::size_t cell) {
      return if_measured(cell, window.may_be_object(cell) ? 1 : kLabelAbsent);
    });
  }
  const DepthComponents& labelled = found.surfaces;
  notes.step("surfaces", labelled.components.size(), [&](std::size_t cell) {
    return if_measured(cell, static_cast<std::int32_t>(labelled.of_cell[cell]) + 1);
  });
  const std::vector<std::uint8_t>& is_object = found.is_object;
  notes.step(
      "object", 1, [&](std::size_t cell) { return is_object[cell] != 0 ? 1 : kLabelAbsent; });

  if (is_beside_the_unmeasured(frame, window, is_object)) return nothing_left("object");
  std::vector<std::uint32_t> pixels = pixels_of(frame, detection, window, is_object);
  if (pixels.size() < static_cast<std::size_t>(foreground.min_pixels))
    return nothing_left("object");
  Segment segment = describe(frame,
                             std::move(pixels),
                             points_of(window, is_object, gravity_aligned_from_camera, foreground),
                             options);
  segment.background = std::move(background);
  return segment;
}

}  // namespace hypermap
