// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/box_carving.hpp"

#include "geometry/point_votes.hpp"
#include "matched_points.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

PixelBox widened(const PixelBox& box, double share) {
  const double u_px = share * box.width_px();
  const double v_px = share * box.height_px();
  return {box.u_min_px - u_px, box.v_min_px - v_px, box.u_max_px + u_px, box.v_max_px + v_px};
}

bool is_in(const PixelBox& box, const PixelPoint& at) {
  return at.u_px >= box.u_min_px && at.u_px <= box.u_max_px && at.v_px >= box.v_min_px &&
         at.v_px <= box.v_max_px;
}

/// Cells of one object as a frame sees them.
class CellsInFrame {
 public:
  CellsInFrame(const RgbdFrame& frame, const OccupancyVotes& points)
      : frame_(frame), camera_from_map_(frame.map_from_camera.inverse()), points_(points) {}

  /// Positions of the cells that are shown outside the box.
  [[nodiscard]] std::vector<std::size_t> shown_outside(const PixelBox& box) const {
    return shown_where([&box](const PixelPoint& at) { return !is_in(box, at); });
  }
  /// Positions of the cells that are shown amid the background.
  [[nodiscard]] std::vector<std::size_t> shown_on(const BackgroundCells& background) const {
    return shown_where([&background](const PixelPoint& at) {
      const Eigen::Vector2i pixel = pixel_of(at);
      return background.surrounds(pixel.x(), pixel.y());
    });
  }
  [[nodiscard]] bool is_agreed(std::size_t position) const {
    return points_.standings()[position] == CellStanding::kAgreed;
  }
  [[nodiscard]] bool is_stray(std::size_t position) const {
    return points_.standings()[position] == CellStanding::kStray;
  }
  [[nodiscard]] std::size_t num_agreed_shown() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < points_.state().votes.size(); ++i) {
      if (!is_agreed(i)) continue;
      const PointInCamera cell = in_camera(i);
      const auto at = frame_.camera.project(cell);
      count += at && is_shown(cell, *at) ? 1U : 0U;
    }
    return count;
  }

 private:
  /// Positions of the cells that are shown at places in the image of which `is_asked_for` holds.
  template <class IsAskedFor>
  [[nodiscard]] std::vector<std::size_t> shown_where(const IsAskedFor& is_asked_for) const {
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < points_.state().votes.size(); ++i) {
      const PointInCamera cell = in_camera(i);
      const auto at = frame_.camera.project(cell);
      // Of most it does not: depth is not asked for then.
      if (at && is_asked_for(*at) && is_shown(cell, *at)) shown.push_back(i);
    }
    return shown;
  }
  [[nodiscard]] PointInCamera in_camera(std::size_t position) const {
    const OccupancyVotesState& state = points_.state();
    return camera_from_map_ * PointInMap{centre_of(state.votes[position].cell, state.edge_m)};
  }
  /// Whether its depth is measured at the pixel.
  [[nodiscard]] bool is_shown(const PointInCamera& cell, const PixelPoint& at) const {
    const auto depth_m = measured_depth_m(frame_, at);
    return depth_m &&
           std::abs(*depth_m - cell.xyz.z()) <= reach_m(points_.state().edge_m, cell.xyz.z());
  }

  const RgbdFrame& frame_;
  Transform<frame::Camera, frame::Map> camera_from_map_;
  const OccupancyVotes& points_;
};

/// Positions of the cells that are shown outside the box; none where the box shows a part, or where
/// no agreed cell is outside: strays alone change nothing that anybody asks for.
std::vector<std::size_t> cells_outside(const CellsInFrame& cells,
                                       const PixelBox& box,
                                       double max_share) {
  std::vector<std::size_t> outside = cells.shown_outside(box);
  if (outside.empty()) return outside;
  const auto num_outside = std::ranges::count_if(
      outside, [&](std::size_t position) { return cells.is_agreed(position); });
  const auto is_part = [&] {
    const double most = max_share * static_cast<double>(cells.num_agreed_shown());
    return static_cast<double>(num_outside) > most;
  };
  if (num_outside == 0 || is_part()) outside.clear();
  return outside;
}

/// Positions of the cells that are shown on surfaces which run on beyond the box; none where all of
/// them are strays, which change nothing that anybody asks for.
std::vector<std::size_t> cells_on(const CellsInFrame& cells, const BackgroundCells& background) {
  if (background.is_background.empty()) return {};
  std::vector<std::size_t> on = cells.shown_on(background);
  if (std::ranges::all_of(on, [&](std::size_t position) { return cells.is_stray(position); }))
    on.clear();
  return on;
}

/// The positions that either has; both ascend.
std::vector<std::size_t> united(const std::vector<std::size_t>& a,
                                const std::vector<std::size_t>& b) {
  std::vector<std::size_t> both;
  both.reserve(a.size() + b.size());
  std::ranges::set_union(a, b, std::back_inserter(both));
  return both;
}

/// Positions of the cells that the frame shows to be something else than the observation.
std::vector<std::size_t> denied_cells(const CellsInFrame& cells,
                                      const Observation& observation,
                                      const BoxCarvingOptions& carving) {
  const PixelBox box = widened(observation.box_px, carving.margin_share);
  std::vector<std::size_t> outside = cells_outside(cells, box, carving.max_share);
  if (carving.rule != BoxCarvingRule::kBoxesAndBackground) return outside;
  return united(outside, cells_on(cells, observation.segment.background));
}

}  // namespace

std::size_t carve_by_boxes(ObjectMap& objects,
                           const RgbdFrame& frame,
                           std::span<const Observation> observations,
                           const AssociationReport& association,
                           const AssociationOptions& options) {
  const BoxCarvingOptions& carving = options.carving;
  if (carving.rule == BoxCarvingRule::kNone) return 0;
  std::size_t num_denied = 0;
  for (const ObjectId id : association.matched) {
    const auto observation = only_observation_of(id, association);
    if (!observation) continue;
    const auto denied = denied_cells(
        CellsInFrame(frame, objects.at(id).points), observations[*observation], carving);
    if (denied.empty()) continue;
    objects.modify(id, [&](Object& object) {
      object.points.deny(denied);
      follow_points(object, options);
    });
    num_denied += denied.size();
  }
  return num_denied;
}

}  // namespace hypermap
