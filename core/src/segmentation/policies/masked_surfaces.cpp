// SPDX-License-Identifier: BSD-3-Clause
#include "masked_surfaces.hpp"

#include "hypermap/core/segmentation/masks.hpp"
#include "segmentation/plane_test.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

namespace hypermap {
namespace {

/// The edge of a mask is off by no more than this share of the side of a square of its size.
constexpr double kEdgeShare = 0.1;
/// A strip along the edge has no more than this share of its cells farther in.
constexpr double kMostInside = 0.2;
/// A surface goes on outside when so much of its edge to the outside is no step.
constexpr double kLeastGoingOn = 0.5;
/// What rises from a plane is above it by this share of what the plane tolerates, in the mean.
constexpr double kLeastRise = 0.5;
/// Strips of more than this share of a mask are what it is about.
constexpr double kMostStrips = 0.5;
/// What is seen through the object has no more of an outline than this, and is less of the mask.
constexpr double kThroughMaxOutline = 0.3;
constexpr double kThroughMaxShare = 0.5;

/// Of a surface in the mask.
struct MaskCounts {
  std::uint32_t num_inside = 0;    ///< Cells farther from the mask's edge than it may be off.
  std::uint32_t num_borders = 0;   ///< Neighbours outside the mask.
  std::uint32_t num_going_on = 0;  ///< Those of them that the surface goes on through.
  double rise = 0.0;               ///< Sum over its cells, above its plane; unit: tolerances.

  [[nodiscard]] bool goes_on() const {
    return num_borders > 0 && num_going_on >= kLeastGoingOn * num_borders;
  }
};

/// Cells farther in the mask than its edge may be off.
MaskImage cells_inside(const DepthWindow& window) {
  const auto mask = window.in_mask.pixels();
  const auto size = static_cast<double>(std::count(mask.begin(), mask.end(), 1));
  const double by_size = std::round(kEdgeShare * std::sqrt(size));
  const int most = std::max(1, window.mask_tolerance);
  const double reach = std::clamp(by_size, 1.0, static_cast<double>(most));
  MaskImage cells = window.in_mask;
  for (std::uint8_t& cell : cells.pixels()) cell = cell == 0 ? 1 : 0;
  cells = widened(cells, static_cast<int>(reach));
  for (std::uint8_t& cell : cells.pixels()) cell = cell == 0 ? 1 : 0;
  return cells;
}

class MaskSurvey {
 public:
  MaskSurvey(const DepthWindow& window,
             const DepthComponents& labelled,
             const std::vector<std::uint8_t>& kind_of_cell,
             const std::vector<Plane>& planes,
             const ForegroundOptions& options)
      : window_(window),
        labelled_(labelled),
        kind_of_cell_(kind_of_cell),
        options_(options),
        inside_(cells_inside(window)),
        counts_(labelled.components.size()) {
    for (const Plane& plane : planes) tests_.push_back(test_of(plane, options));
  }

  std::vector<MaskCounts> run() && {
    for (int y = window_.box.v_begin; y < window_.box.v_end; ++y) {
      for (int x = window_.box.u_begin; x < window_.box.u_end; ++x) look_at(x, y);
    }
    return std::move(counts_);
  }

 private:
  void look_at(int x, int y) {
    const std::size_t cell = window_.cell(x, y);
    if (!window_.may_be_object(cell) || labelled_.of_cell[cell] == kNoComponent) return;
    MaskCounts& counts = counts_[labelled_.of_cell[cell]];
    counts.num_inside += inside_.pixels()[cell];
    if (kind_of_cell_[cell] != 0) counts.rise += rise(x, y, tests_[kind_of_cell_[cell] - 1U]);
    constexpr std::array<std::pair<int, int>, 4> kSteps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    for (const auto& [dx, dy] : kSteps) {
      if (!window_.in_mask.contains(x + dx, y + dy)) continue;
      const std::size_t other = window_.cell(x + dx, y + dy);
      if (window_.may_be_object(other)) continue;
      ++counts.num_borders;
      counts.num_going_on += is_one_surface(cell, other) ? 1U : 0U;
    }
  }

  /// How far the cell is before the plane, as the camera sees it.
  [[nodiscard]] double rise(int x, int y, const PlaneTest& test) const {
    const Eigen::Vector3f point = window_.point_in_camera(x, y);
    const float along_m = test.along_m(point.x(), point.y(), point.z());
    const float above_m =
        std::copysign(1.0F, test.plane.offset_m) * (along_m + test.plane.offset_m);
    const float noise_m = noise_at(point.z(), options_);
    return static_cast<double>(above_m / test.tolerance_m(along_m, point.z(), noise_m));
  }

  [[nodiscard]] bool is_one_surface(std::size_t cell, std::size_t other) const {
    const float depth_m = window_.depth_m[cell];
    const float other_m = window_.depth_m[other];
    if (other_m == 0.0F || kind_of_cell_[cell] != kind_of_cell_[other]) return false;
    return std::abs(depth_m - other_m) <= window_.step_m[depth_m < other_m ? cell : other];
  }

  const DepthWindow& window_;
  const DepthComponents& labelled_;
  const std::vector<std::uint8_t>& kind_of_cell_;
  const ForegroundOptions& options_;
  std::vector<PlaneTest> tests_;  // of the planes
  MaskImage inside_;
  std::vector<MaskCounts> counts_;
};

bool is_strip_of_the_outside(const DepthComponent& component, const MaskCounts& counts) {
  const bool rises = component.kind != 0 && counts.rise >= kLeastRise * component.num_in_box;
  return counts.goes_on() && !rises && counts.num_inside <= kMostInside * component.num_in_box;
}

bool is_seen_through(const DepthComponent& component, const MaskCounts& counts, double num_all) {
  const bool is_of_the_background = component.kind != 0 || counts.goes_on();
  return is_of_the_background && component.outline_share() < kThroughMaxOutline &&
         component.num_in_box < kThroughMaxShare * num_all;
}

}  // namespace

std::vector<std::uint8_t> kinds_in_mask(const DepthWindow& window,
                                        std::vector<std::uint8_t> kind_of_cell) {
  for (std::size_t cell = 0; cell < window.size(); ++cell) {
    if (!window.may_be_object(cell)) kind_of_cell[cell] = kOthersKind;
  }
  return kind_of_cell;
}

ComponentIds masked_surfaces(const DepthWindow& window,
                             const DepthComponents& labelled,
                             const std::vector<std::uint8_t>& kind_of_cell,
                             const std::vector<Plane>& planes,
                             const ForegroundOptions& options) {
  const std::vector<MaskCounts> counts =
      MaskSurvey(window, labelled, kind_of_cell, planes, options).run();
  const auto num_cells = [&](const ComponentIds& ids) {
    double sum = 0.0;
    for (const std::uint32_t id : ids) sum += labelled.components[id].num_in_box;
    return sum;
  };
  ComponentIds chosen;
  for (std::uint32_t id = 0; id < labelled.components.size(); ++id) {
    if (labelled.components[id].kind != kOthersKind) chosen.push_back(id);
  }
  const ComponentIds all = chosen;
  const double num_all = num_cells(all);
  std::erase_if(chosen, [&](std::uint32_t id) {
    return is_seen_through(labelled.components[id], counts[id], num_all);
  });
  ComponentIds strips;
  std::ranges::copy_if(chosen, std::back_inserter(strips), [&](std::uint32_t id) {
    return is_strip_of_the_outside(labelled.components[id], counts[id]);
  });
  if (num_cells(strips) > kMostStrips * num_all) return chosen;
  std::erase_if(chosen, [&](std::uint32_t id) { return std::ranges::binary_search(strips, id); });
  return chosen.empty() ? all : chosen;
}

}  // namespace hypermap
