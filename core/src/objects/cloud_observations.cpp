// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/cloud_observations.hpp"

#include "segmentation/voxel_grid.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace hypermap {
namespace {

using PointIndices = std::vector<std::uint32_t>;

std::uint32_t class_vector_of(const LabelledCloud& cloud, std::uint32_t point) {
  const auto& positions = cloud.class_vector_of_point;
  return positions.empty() ? LabelledCloud::kNoClassVector : positions[point];
}

/// The mean of the class vectors of those points that have one.
std::vector<ClassEvidence> mean_of_class_vectors(const LabelledCloud& cloud,
                                                 const PointIndices& points) {
  std::map<ClassId, double> sums;
  double total = 0.0;
  for (const std::uint32_t point : points) {
    const std::uint32_t position = class_vector_of(cloud, point);
    if (position == LabelledCloud::kNoClassVector) continue;
    for (const auto& [id, probability] : cloud.class_vectors[position]) {
      sums[id] += probability.value();
      total += probability.value();
    }
  }
  std::vector<ClassEvidence> mean;
  mean.reserve(sums.size());
  for (const auto& [id, sum] : sums) mean.push_back({id, Probability(std::min(1.0, sum / total))});
  return mean;
}

Segment segment_of(const LabelledCloud& cloud,
                   PointIndices points,
                   const CloudObservationOptions& options) {
  std::vector<Eigen::Vector3f> all;
  all.reserve(points.size());
  double nearest_m = std::numeric_limits<double>::infinity();
  double farthest_m = 0.0;
  for (const std::uint32_t point : points) {
    all.push_back(cloud.points_in_map[point]);
    const double distance_m = (all.back().cast<double>() - cloud.sensor.xyz).norm();
    nearest_m = std::min(nearest_m, distance_m);
    farthest_m = std::max(farthest_m, distance_m);
  }
  Segment segment;
  segment.points_in_map = voxel_grid(all, options.leaf_size_m).centroids;
  segment.pixel_indices = std::move(points);
  segment.box = bounding_box(segment.points_in_map);
  segment.centroid_in_map = segment.box.centre();
  segment.box_confidence =
      box_confidence(farthest_m - nearest_m, options.depth_slack_m, 0.0, options.max_range_m);
  segment.distance_m = (segment.centroid_in_map - cloud.sensor.xyz).norm();
  return segment;
}

Observation observation_of(const LabelledCloud& cloud,
                           PointIndices points,
                           const CloudObservationOptions& options) {
  Observation out;
  out.class_scores = mean_of_class_vectors(cloud, points);
  if (const auto best = best_class(out.class_scores)) out.score = best->probability;
  out.segment = segment_of(cloud, std::move(points), options);
  out.detector = cloud.detector;
  out.bearing_rad = bearing_from_object_rad(out.segment.centroid_in_map, cloud.sensor.xyz);
  out.distance_m = out.segment.distance_m;
  out.stamp = cloud.stamp;
  out.frame_index = cloud.index;
  return out;
}

}  // namespace

CloudObservations observe_cloud(const LabelledCloud& cloud,
                                const CloudObservationOptions& options) {
  std::map<std::uint32_t, PointIndices> points_of_instance;
  std::map<std::uint32_t, PointIndices> points_of_class;
  for (std::uint32_t i = 0; i < cloud.points_in_map.size(); ++i) {
    const Eigen::Vector3d way = cloud.points_in_map[i].cast<double>() - cloud.sensor.xyz;
    if (!(way.norm() <= options.max_range_m)) continue;  // NaN as well
    const std::uint32_t instance =
        cloud.instance_of_point.empty() ? LabelledCloud::kNoInstance : cloud.instance_of_point[i];
    const std::uint32_t class_vector = class_vector_of(cloud, i);
    if (instance != LabelledCloud::kNoInstance) {
      points_of_instance[instance].push_back(i);
    } else if (class_vector != LabelledCloud::kNoClassVector) {
      points_of_class[class_vector].push_back(i);
    }
  }
  CloudObservations seen;
  for (auto& [instance, points] : points_of_instance) {
    Observation observation = observation_of(cloud, std::move(points), options);
    // What had a class lies beyond the range.
    if (!observation.class_scores.empty()) seen.instances.push_back(std::move(observation));
  }
  for (auto& [class_vector, points] : points_of_class) {
    seen.classes.push_back({class_vector, std::move(points)});
  }
  return seen;
}

}  // namespace hypermap
