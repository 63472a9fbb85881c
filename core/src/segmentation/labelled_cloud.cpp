// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/labelled_cloud.hpp"

#include "frame_index.hpp"

#include <set>
#include <string>
#include <utility>

namespace hypermap {
namespace {

Result<void> check_class_vectors(const LabelledCloud& cloud) {
  for (std::size_t i = 0; i < cloud.class_vectors.size(); ++i) {
    auto checked = validate_class_scores(cloud.class_vectors[i]);
    if (checked) continue;
    checked.error().field = "class_vectors[" + std::to_string(i) + "]";
    return checked;
  }
  return {};
}

Result<void> check_per_point(const std::vector<std::uint32_t>& list,
                             const LabelledCloud& cloud,
                             const char* field) {
  const std::size_t num_points = cloud.points_in_map.size();
  if (list.empty() || list.size() == num_points) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must have no entry or one for each of " + std::to_string(num_points) +
                  " points, has " + std::to_string(list.size()),
              field);
}

Result<void> check_positions(const LabelledCloud& cloud) {
  for (const std::uint32_t position : cloud.class_vector_of_point) {
    if (position == LabelledCloud::kNoClassVector) continue;
    if (position < cloud.class_vectors.size()) continue;
    return fail(ErrorCode::kInvalidArgument,
                "must be below " + std::to_string(cloud.class_vectors.size()) + ", one is " +
                    std::to_string(position),
                "class_vector_of_point");
  }
  return {};
}

Result<void> check_instances(const LabelledCloud& cloud) {
  std::set<std::uint32_t> without_class(cloud.instance_of_point.begin(),
                                        cloud.instance_of_point.end());
  without_class.erase(LabelledCloud::kNoInstance);
  if (!cloud.class_vector_of_point.empty()) {
    for (std::size_t i = 0; i < cloud.instance_of_point.size(); ++i) {
      if (cloud.class_vector_of_point[i] != LabelledCloud::kNoClassVector) {
        without_class.erase(cloud.instance_of_point[i]);
      }
    }
  }
  if (without_class.empty()) return {};
  return fail(ErrorCode::kInvalidArgument,
              "one point of each instance must have a class, none has of instance " +
                  std::to_string(*without_class.begin()),
              "instance_of_point");
}

}  // namespace

Result<void> validate(const LabelledCloud& cloud) {
  HYPERMAP_TRY(check_frame_index(cloud.index));
  if (!cloud.sensor.xyz.allFinite()) {
    return fail(ErrorCode::kInvalidArgument, "must be finite", "sensor");
  }
  HYPERMAP_TRY(check_class_vectors(cloud));
  HYPERMAP_TRY(check_per_point(cloud.class_vector_of_point, cloud, "class_vector_of_point"));
  HYPERMAP_TRY(check_per_point(cloud.instance_of_point, cloud, "instance_of_point"));
  HYPERMAP_TRY(check_positions(cloud));
  return check_instances(cloud);
}

}  // namespace hypermap
