// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The plane of least squares through points that come one by one.
#pragma once

#include "background_planes.hpp"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <optional>

namespace hypermap {

/// Sums over points. Frame: that of the points.
class PlaneFit {
 public:
  void add(const Eigen::Vector3f& point) {
    const Eigen::Vector3d exact = point.cast<double>();
    sum_ += exact;
    moments_ += exact * exact.transpose();
    count_ += 1.0;
  }
  /// Across the plane the points spread least. None through fewer than three.
  [[nodiscard]] std::optional<Plane> plane() const {
    if (count_ < 3.0) return std::nullopt;
    const Eigen::Vector3d mean = sum_ / count_;
    const Eigen::Matrix3d covariance = moments_ / count_ - mean * mean.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    const Eigen::Vector3d normal = solver.eigenvectors().col(0);
    return Plane{normal.cast<float>(), static_cast<float>(-normal.dot(mean))};
  }

 private:
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d moments_ = Eigen::Matrix3d::Zero();
  double count_ = 0.0;
};

}  // namespace hypermap
