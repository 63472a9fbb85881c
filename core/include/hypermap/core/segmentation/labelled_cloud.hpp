// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One scan of a range sensor, and what somebody's network says of its points.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/core/segmentation/detection.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace hypermap {

/// An unorganised cloud seen from one place.
///
/// Points bear classes, instances or both. Points of one instance are an observation of an object;
/// points of a class alone label voxels without one.
struct LabelledCloud {
  static constexpr std::uint32_t kNoClassVector = 0xFFFF'FFFF;
  static constexpr std::uint32_t kNoInstance = 0;

  std::uint64_t index = 0;  ///< Position in the sequence, at most 2^63 - 1.
  std::string name;         ///< For messages.
  Stamp stamp;
  PointInMap sensor;
  std::vector<Eigen::Vector3f> points_in_map;  ///< What is not finite is no measurement.
  /// What points may show, each once: all classes sorted by id, summing to 1.
  std::vector<std::vector<ClassEvidence>> class_vectors;
  /// Per point its position in `class_vectors` or kNoClassVector; empty when no point has a class.
  std::vector<std::uint32_t> class_vector_of_point;
  /// Per point a number of this scan or kNoInstance; empty when no point is of an instance.
  std::vector<std::uint32_t> instance_of_point;
  DetectorId detector;  ///< Whose words these are.
};

/// Errors: kInvalidArgument naming the field: `index` beyond its range, a sensor that is not
/// finite, class vectors as of validate(Detection), lists that have neither no entry nor one per
/// point, a position that is not there, an instance none of whose points has a class.
[[nodiscard]] Result<void> validate(const LabelledCloud& cloud);

}  // namespace hypermap
