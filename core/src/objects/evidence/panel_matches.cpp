// SPDX-License-Identifier: BSD-3-Clause
#include "panel_matches.hpp"

#include "hypermap/core/objects/visibility_histogram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hypermap {
namespace {

/// Columns and rows of panels, both ends included.
struct PanelRectangle {
  int first_column = std::numeric_limits<int>::max();
  int last_column = -1;
  int first_row = std::numeric_limits<int>::max();
  int last_row = -1;

  void include(int column, int row) {
    first_column = std::min(first_column, column);
    last_column = std::max(last_column, column);
    first_row = std::min(first_row, row);
    last_row = std::max(last_row, row);
  }
  [[nodiscard]] bool contains(int column, int row) const {
    return column >= first_column && column <= last_column && row >= first_row && row <= last_row;
  }
};

/// From a camera to the nearest and to the farthest point of a box.
struct DistanceRange {
  double nearest_m = 0.0;
  double farthest_m = 0.0;
};

DistanceRange distances_of(const Box& box, const Eigen::Vector3d& camera_in_map) {
  const Eigen::Vector3d nearest = camera_in_map.cwiseMax(box.min_in_map).cwiseMin(box.max_in_map);
  DistanceRange range{.nearest_m = (nearest - camera_in_map).norm()};
  for (const Eigen::Vector3d& corner : box.corners()) {
    range.farthest_m = std::max(range.farthest_m, (corner - camera_in_map).norm());
  }
  return range;
}

}  // namespace

SphericalAngles angles_from_camera(const Eigen::Vector3d& point_in_map,
                                   const Eigen::Vector3d& camera_in_map,
                                   double heading_rad) {
  const Eigen::Vector3d way = point_in_map - camera_in_map;
  return {.azimuth_rad = angle_difference_rad(std::atan2(way.y(), way.x()), heading_rad),
          .elevation_rad = std::atan2(way.z(), way.head<2>().norm())};
}

double angular_distance_rad(const SphericalAngles& corner, const SphericalAngles& panel) {
  const double azimuth_rad = angle_difference_rad(corner.azimuth_rad, panel.azimuth_rad);
  const double elevation_rad = angle_difference_rad(corner.elevation_rad, panel.elevation_rad);
  return std::sqrt(azimuth_rad * azimuth_rad + elevation_rad * elevation_rad);
}

PanelMatches::PanelMatches(const BinnedDepthMap& depth)
    : camera_in_map_(depth.camera_centre().xyz),
      heading_rad_(std::atan2(depth.camera_axis_in_map().y(), depth.camera_axis_in_map().x())) {
  for (int row = 0; row < depth.rows(); ++row) {
    for (int column = 0; column < depth.columns(); ++column) {
      const DepthPanel& panel = depth.at(column, row);
      if (panel.num_points == 0) continue;
      const Eigen::Vector3d middle = panel.box.centre();
      places_.push_back({.column = column,
                         .row = row,
                         .angles = angles_from_camera(middle, camera_in_map_, heading_rad_),
                         .distance_m = (middle - camera_in_map_).norm()});
    }
  }
}

const PanelMatches::Place& PanelMatches::nearest(const Eigen::Vector3d& corner_in_map) const {
  const SphericalAngles corner = angles_from_camera(corner_in_map, camera_in_map_, heading_rad_);
  const Place* best = nullptr;
  double best_rad = std::numeric_limits<double>::infinity();
  for (const Place& place : places_) {
    // Of angles of elevation the difference alone is no less than what both are apart.
    if (std::abs(corner.elevation_rad - place.angles.elevation_rad) >= best_rad) continue;
    const double apart_rad = angular_distance_rad(corner, place.angles);
    if (!(apart_rad < best_rad)) continue;
    best = &place;
    best_rad = apart_rad;
  }
  return *best;
}

PanelCounts PanelMatches::count(const Box& box, double tolerance_m) const {
  PanelCounts counts;
  if (places_.empty()) return counts;
  PanelRectangle rectangle;
  for (const Eigen::Vector3d& corner : box.corners()) {
    const Place& match = nearest(corner);
    rectangle.include(match.column, match.row);
  }
  const DistanceRange box_range = distances_of(box, camera_in_map_);
  for (const Place& place : places_) {
    if (!rectangle.contains(place.column, place.row)) continue;
    if (place.distance_m < box_range.nearest_m - tolerance_m) {
      ++counts.before;
    } else if (place.distance_m > box_range.farthest_m + tolerance_m) {
      ++counts.after;
    } else {
      ++counts.inside;
    }
  }
  return counts;
}

}  // namespace hypermap
