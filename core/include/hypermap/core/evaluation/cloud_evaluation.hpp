// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How well the voxels of a map agree with a cloud whose points somebody labelled.
///
/// The rule (docs/EVALUATION.md, "Clouds"): that of voxel_evaluation.hpp, with the points of a
/// class in the place of the surfaces of its objects.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/evaluation/voxel_evaluation.hpp"
#include "hypermap/core/geometry/leaf.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

/// A cloud that is right. Frame: that of the map. Unit: metre.
struct TrueCloud {
  static constexpr std::uint32_t kNoTrueClass = 0xFFFF'FFFF;

  std::vector<Eigen::Vector3f> points = {};
  /// Of each point its class as a position in `class_names`, or kNoTrueClass.
  std::vector<std::uint32_t> class_of_point = {};
  std::vector<std::string> class_names = {};
  friend bool operator==(const TrueCloud&, const TrueCloud&) = default;
};

/// Errors: kInvalidArgument naming the field: not a class for each point, a class that is not
/// there, an empty name, a point that is not finite or beyond 1e6 m.
[[nodiscard]] Result<void> validate(const TrueCloud& cloud);

/// Distances from points to the occupied space of a map, 0 within a voxel. Unit: metre.
struct PointDistances {
  std::size_t n = 0;
  double mean_m = 0.0;
  double median_m = 0.0;
  double upper_m = 0.0;  ///< 95 % of the points are no farther.
  double max_m = 0.0;
};

struct CloudEvaluation {
  VoxelLabelCounts all;
  std::map<std::string, ClassVoxelCounts> classes;  ///< By canonical name.
  /// Of the cells of 5 cm that points lie in, by canonical name of their class; of all points.
  std::map<std::string, SurfaceCoverage> coverage_of_class;
  SurfaceCoverage coverage;
  /// Labelled voxels with no point within an edge: there the cloud says nothing. They are among
  /// those whose label is not right.
  std::size_t labelled_off_cloud = 0;
  std::size_t num_points = 0;
  std::size_t num_without_class = 0;  ///< Of these.
  /// From each point; none without points or occupied voxels.
  std::optional<PointDistances> distances;

  /// As precision, over the labelled voxels that points are near to.
  [[nodiscard]] std::optional<double> precision_at_cloud() const;
};

/// Compares occupied voxels with the cloud. Classes are compared by canonical_class_name. A voxel
/// is at a point when its centre is no farther from it than one edge; points without a class count
/// for coverage and distances alone. A cell is covered as in evaluate_voxels.
///
/// Requires: validate(cloud); leaves whose classes are in `classes`.
/// Errors: kInterrupted when `stop` says so.
/// Cost: points times the voxels near each.
[[nodiscard]] Result<CloudEvaluation> evaluate_cloud(const LeafSource& leaves,
                                                     const ClassRegistry& classes,
                                                     const TrueCloud& cloud,
                                                     const StopCheck& stop = {});

}  // namespace hypermap
