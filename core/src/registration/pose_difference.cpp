// SPDX-License-Identifier: BSD-3-Clause
#include "registration/pose_difference.hpp"

#include "registration/rotation_vector.hpp"

#include <Eigen/Cholesky>

namespace hypermap {

PoseDifference difference(const Eigen::Isometry3d& given,
                          const Eigen::Isometry3d& pose,
                          const PoseRefinementOptions& options) {
  Eigen::Matrix<double, 6, 1> error;
  error << rotation_vector(given.linear() * pose.linear().transpose()),
      given.translation() - pose.translation();
  Eigen::Matrix<double, 6, 6> slope = Eigen::Matrix<double, 6, 6>::Identity();
  slope.bottomLeftCorner<3, 3>() = -cross_matrix(pose.translation());
  Eigen::Matrix<double, 6, 1> precision;
  precision << Eigen::Vector3d::Constant(1.0 / (options.sigma_rad * options.sigma_rad)),
      Eigen::Vector3d::Constant(1.0 / (options.sigma_m * options.sigma_m));
  const Eigen::Matrix<double, 6, 6> weighted = slope.transpose() * precision.asDiagonal();
  return {.information = weighted * slope, .gradient = weighted * error};
}

Eigen::Isometry3d motion_of(const PoseDifference& difference) {
  const Eigen::Matrix<double, 6, 1> change =
      difference.information.ldlt().solve(difference.gradient);
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = rotation_of(change.head<3>());
  motion.translation() = change.tail<3>();
  return motion;
}

}  // namespace hypermap
