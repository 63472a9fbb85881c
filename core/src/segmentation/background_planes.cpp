// SPDX-License-Identifier: BSD-3-Clause
#include "background_planes.hpp"

#include "floor_plane.hpp"
#include "hypermap/core/base/random_numbers.hpp"
#include "hypermap/core/segmentation/masks.hpp"
#include "plane_fit.hpp"
#include "plane_points.hpp"
#include "plane_test.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace hypermap {
namespace {

constexpr std::size_t kMaxSamples = 500;
constexpr int kHorizontalTries = 24;
constexpr int kVerticalTries = 40;
constexpr int kFreeTries = 40;
constexpr int kRefinements = 3;
/// Floors, tables and walls are level or upright; other planes have to be clearly better.
constexpr double kFreePlaneWeight = 0.75;
/// Cosine of 3 degrees, what the up axis of a map may be off.
constexpr float kLeanCos = 0.9986F;
constexpr std::size_t kLeastSupport = 20;
/// A floor is no farther from where it is known to be: a voxel of 10 cm, and the sensor's errors.
constexpr float kKnownFloorM = 0.08F;

/// The measured cells outside the mask, and not so near that they may be the object's.
std::vector<std::uint32_t> cells_around_mask(const DepthWindow& window) {
  const MaskImage near_mask = widened(window.in_mask, window.mask_tolerance);
  std::vector<std::uint32_t> cells;
  for (std::size_t cell = 0; cell < window.size(); ++cell) {
    if (near_mask.pixels()[cell] == 0 && window.depth_m[cell] > 0.0F)
      cells.push_back(static_cast<std::uint32_t>(cell));
  }
  return cells;
}

/// The measured cells outside the box.
std::vector<std::uint32_t> cells_around_box(const DepthWindow& window) {
  std::vector<std::uint32_t> cells;
  for (int y = 0; y < window.height(); ++y) {
    const auto look_at = [&](int begin, int end) {
      for (std::size_t cell = window.cell(begin, y); cell < window.cell(end, y); ++cell) {
        if (window.depth_m[cell] > 0.0F) cells.push_back(static_cast<std::uint32_t>(cell));
      }
    };
    const PixelRect& box = window.tolerant_box;
    const bool crosses_box = y >= box.v_begin && y < box.v_end;
    look_at(0, crosses_box ? box.u_begin : window.width());
    if (crosses_box) look_at(box.u_end, window.width());
  }
  return cells;
}

std::vector<std::uint32_t> measured_cells(const DepthWindow& window) {
  std::vector<std::uint32_t> cells;
  for (std::size_t cell = 0; cell < window.size(); ++cell) {
    if (window.depth_m[cell] > 0.0F) cells.push_back(static_cast<std::uint32_t>(cell));
  }
  return cells;
}

/// The points of some cells, evenly chosen.
PlanePoints points_of(const DepthWindow& window,
                      const std::vector<std::uint32_t>& cells,
                      const ForegroundOptions& options) {
  PlanePoints points;
  const std::size_t count = std::min(cells.size(), kMaxSamples);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t cell = cells[i * cells.size() / count];
    const auto width = static_cast<std::size_t>(window.width());
    points.add(
        window.point_in_camera(static_cast<int>(cell % width), static_cast<int>(cell / width)),
        noise_at(window.depth_m[cell], options));
  }
  return points;
}

/// Measured points around the object.
PlanePoints surroundings(const DepthWindow& window, const ForegroundOptions& options) {
  return points_of(
      window, window.is_masked() ? cells_around_mask(window) : cells_around_box(window), options);
}

std::optional<Plane> plane_through(const Eigen::Vector3f& a,
                                   const Eigen::Vector3f& b,
                                   const Eigen::Vector3f& c) {
  const Eigen::Vector3f normal = (b - a).cross(c - a);
  const float length = normal.norm();
  if (!(length > 1e-6F)) return std::nullopt;
  return Plane{normal / length, -normal.dot(a) / length};
}

/// Least squares through the points on `plane`.
Plane refined(const Plane& plane, const PlanePoints& points, const ForegroundOptions& options) {
  const PlaneTest test = test_of(plane, options);
  PlaneFit fit;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points.lies_on(test, i)) fit.add(points[i]);
  }
  return fit.plane().value_or(plane);
}

/// The best of planes that were tried.
class PlaneSelection {
 public:
  PlaneSelection(const PlanePoints& points, const ForegroundOptions& options)
      : points_(points), options_(options) {}

  /// `plane_weight` times its support is what counts.
  void consider(const Plane& plane, double plane_weight = 1.0) {
    const double value = plane_weight * static_cast<double>(support_to_win(plane, plane_weight));
    if (value <= best_value_) return;
    best_ = plane;
    best_value_ = value;
    plane_weight_ = plane_weight;
  }

  /// Moves the best plane into the middle of its points while that gains support. To turn a level
  /// or upright plane by more than the map may lean has to gain more: it may join two parallel
  /// faces.
  void refine() {
    const Eigen::Vector3f normal = best_.normal;
    for (int round = 0; round < kRefinements; ++round) {
      const Plane next = refined(best_, points_, options_);
      const bool turns = std::abs(next.normal.dot(normal)) < kLeanCos;
      consider(next, turns ? kFreePlaneWeight : plane_weight_);
    }
  }

  [[nodiscard]] const Plane& best() const { return best_; }

 private:
  /// How many points lie on the plane; less when even all that are left would not make it the best.
  [[nodiscard]] std::size_t support_to_win(const Plane& plane, double plane_weight) const {
    constexpr std::size_t kAtOnce = 64;
    const PlaneTest test = test_of(plane, options_);
    std::size_t support = 0;
    for (std::size_t i = 0; i < points_.size(); i += kAtOnce) {
      const double most = plane_weight * static_cast<double>(support + points_.size() - i);
      if (most <= best_value_) break;
      support += points_.count(test, i, std::min(i + kAtOnce, points_.size()));
    }
    return support;
  }

  const PlanePoints& points_;
  const ForegroundOptions& options_;
  Plane best_;
  double best_value_ = 0.0;
  double plane_weight_ = 1.0;
};

Plane best_plane(const PlanePoints& points,
                 const Eigen::Vector3f& up_in_camera,
                 const ForegroundOptions& options,
                 SplitMix64& random) {
  PlaneSelection selection(points, options);
  const auto any_point = [&]() -> Eigen::Vector3f { return points[random() % points.size()]; };
  for (int i = 0; i < kHorizontalTries; ++i) {
    selection.consider({up_in_camera, -up_in_camera.dot(any_point())});
  }
  for (int i = 0; i < kVerticalTries; ++i) {
    const Eigen::Vector3f a = any_point();
    const auto plane = plane_through(a, any_point(), a + up_in_camera);
    if (plane) selection.consider(*plane);
  }
  for (int i = 0; i < kFreeTries; ++i) {
    const Eigen::Vector3f a = any_point();
    const Eigen::Vector3f b = any_point();
    const auto plane = plane_through(a, b, any_point());
    if (plane) selection.consider(*plane, kFreePlaneWeight);
  }
  selection.refine();
  return selection.best();
}

/// What is left of a plane at twice its thickness is its own noise, not another plane.
void erase_plane(const Plane& plane, const ForegroundOptions& options, PlanePoints& points) {
  PlaneTest test = test_of(plane, options);
  test.scale = 2.0F;
  points.erase_on(test);
}

/// The floor among all that the window shows, below a table that fills it: only where it is known
/// to be, since a bed that fills the window is level, too.
std::optional<Plane> known_floor(const DepthWindow& window,
                                 const std::vector<Plane>& planes,
                                 const UprightView& view,
                                 const ForegroundOptions& options) {
  if (!view.floor_height_m) return std::nullopt;
  const auto is_known_floor = [&](const Plane& plane) {
    const float rise = plane.normal.dot(view.up);
    return std::abs(rise) >= kLeanCos &&
           std::abs(plane.offset_m / rise + *view.floor_height_m) <= kKnownFloorM;
  };
  if (std::ranges::any_of(planes, is_known_floor)) return std::nullopt;
  const PlanePoints all = points_of(window, measured_cells(window), options);
  PlanePoints left = all;
  for (const Plane& plane : planes) erase_plane(plane, options, left);
  const auto floor = floor_around(all, left, view.up, kLeastSupport, options);
  return floor && is_known_floor(*floor) ? floor : std::nullopt;
}

}  // namespace

UprightView upright_view(const RgbdFrame& frame) {
  const Eigen::Isometry3d& map_from_camera = frame.map_from_camera.isometry();
  UprightView view;
  view.up = map_from_camera.linear().row(2).transpose().cast<float>();
  if (frame.floor_height_m) {
    view.floor_height_m =
        static_cast<float>(*frame.floor_height_m - map_from_camera.translation().z());
  }
  return view;
}

std::vector<Plane> background_planes(const DepthWindow& window,
                                     const UprightView& view,
                                     const ForegroundOptions& options) {
  const PlanePoints all = surroundings(window, options);
  PlanePoints points = all;
  const auto least = std::max(
      kLeastSupport,
      static_cast<std::size_t>(options.plane_min_share * static_cast<double>(points.size())));
  std::vector<Plane> planes;
  SplitMix64 random;  // the same window gives the same planes
  while (planes.size() < static_cast<std::size_t>(options.max_planes) && points.size() >= least) {
    const Plane plane = best_plane(points, view.up, options, random);
    if (points.count(test_of(plane, options), 0, points.size()) < least) break;
    planes.push_back(plane);
    erase_plane(plane, options, points);
  }
  if (options.max_planes == 0) return planes;
  auto floor = floor_around(all, points, view.up, kLeastSupport, options);
  if (!floor) floor = known_floor(window, planes, view, options);
  if (floor) planes.push_back(*floor);
  return planes;
}

std::vector<std::uint8_t> plane_of_cells(const DepthWindow& window,
                                         const std::vector<Plane>& planes,
                                         const ForegroundOptions& options) {
  std::vector<std::uint8_t> kinds(window.size(), 0);
  const auto width = static_cast<std::size_t>(window.width());
  std::vector<float> noise_m(width);
  std::vector<std::int32_t> kind(width);
  for (int row = 0; row < window.height(); ++row) {
    const float* depth_m = &window.depth_m[window.cell(0, row)];
    const float slope_y = window.slope_y[static_cast<std::size_t>(row)];
    for (std::size_t i = 0; i < width; ++i) noise_m[i] = noise_at(depth_m[i], options);
    std::fill(kind.begin(), kind.end(), 0);
    for (std::size_t number = planes.size(); number > 0; --number) {  // the first one counts
      const PlaneTest test = test_of(planes[number - 1], options);
      for (std::size_t i = 0; i < width; ++i) {
        const float z = depth_m[i];  // 0 makes no number of the test, which then fails
        const bool on = test.holds(window.slope_x[i] * z, slope_y * z, z, noise_m[i]);
        kind[i] = on ? static_cast<std::int32_t>(number) : kind[i];
      }
    }
    std::copy(kind.begin(), kind.end(), &kinds[window.cell(0, row)]);
  }
  return kinds;
}

}  // namespace hypermap
