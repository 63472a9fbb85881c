// SPDX-License-Identifier: BSD-3-Clause
#include "grid_image.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hypermap {
namespace {

std::vector<float> gaussian(double sigma_cells) {
  const int reach = std::max(1, static_cast<int>(std::ceil(3.0 * sigma_cells)));
  std::vector<float> weights;
  weights.reserve(2 * static_cast<std::size_t>(reach) + 1);
  double sum = 0.0;
  for (int i = -reach; i <= reach; ++i) sum += std::exp(-0.5 * i * i / (sigma_cells * sigma_cells));
  for (int i = -reach; i <= reach; ++i) {
    weights.push_back(
        static_cast<float>(std::exp(-0.5 * i * i / (sigma_cells * sigma_cells)) / sum));
  }
  return weights;
}

/// Along the rows of a plane: `out` is that moved and weighted.
Plane blurred_down(const Plane& plane, const std::vector<float>& weights) {
  const auto reach = static_cast<Eigen::Index>(weights.size() / 2);
  Plane sum = Plane::Zero(plane.rows(), plane.cols());
  for (Eigen::Index row = 0; row < plane.rows(); ++row) {
    for (Eigen::Index i = -reach; i <= reach; ++i) {
      if (row + i < 0 || row + i >= plane.rows()) continue;
      sum.row(row) += weights[static_cast<std::size_t>(i + reach)] * plane.row(row + i);
    }
  }
  return sum;
}

}  // namespace

GridImage image_of(const LogOddsGrid& grid) {
  const GridGeometry& geometry = grid.geometry();
  GridImage image{Plane::Zero(geometry.rows, geometry.cols),
                  Plane::Zero(geometry.rows, geometry.cols)};
  for (int row = 0; row < geometry.rows; ++row) {
    for (int col = 0; col < geometry.cols; ++col) {
      if (grid.at({col, row}) == 0) continue;
      const double p = grid.log_odds({col, row}).probability().value();
      image.value(row, col) = static_cast<float>(2.0 * p - 1.0);
      image.known(row, col) = 1.0F;
    }
  }
  return image;
}

Plane blurred(const Plane& plane, double sigma_cells) {
  const std::vector<float> weights = gaussian(sigma_cells);
  const Plane down = blurred_down(plane, weights);
  return blurred_down(down.transpose(), weights).transpose();
}

GridImage smoothed(const GridImage& image, double sigma_cells) {
  constexpr float kLeast = 1e-6F;
  const Plane share = blurred(image.known, sigma_cells);
  const Plane sum = blurred(image.value, sigma_cells);
  return {image.known * sum / share.max(kLeast), image.known};
}

bool is_inside(const Plane& plane, const Eigen::Vector2d& at) {
  return at.x() >= 0.0 && at.y() >= 0.0 && at.x() < static_cast<double>(plane.cols() - 1) &&
         at.y() < static_cast<double>(plane.rows() - 1);  // false for NaN
}

PlaneSample sampled(const Plane& plane, const Eigen::Vector2d& at) {
  const auto col = static_cast<Eigen::Index>(at.x());
  const auto row = static_cast<Eigen::Index>(at.y());
  const double x = at.x() - static_cast<double>(col);
  const double y = at.y() - static_cast<double>(row);
  const auto v00 = static_cast<double>(plane(row, col));
  const auto v10 = static_cast<double>(plane(row, col + 1));
  const auto v01 = static_cast<double>(plane(row + 1, col));
  const auto v11 = static_cast<double>(plane(row + 1, col + 1));
  return {(1 - y) * ((1 - x) * v00 + x * v10) + y * ((1 - x) * v01 + x * v11),
          {(1 - y) * (v10 - v00) + y * (v11 - v01), (1 - x) * (v01 - v00) + x * (v11 - v10)}};
}

Eigen::Matrix3d frame_from_cells(const GridGeometry& geometry) {
  const Eigen::Vector2d origin = from_cells(geometry, {0.5, 0.5});
  const Eigen::Vector2d along_x = from_cells(geometry, {1.5, 0.5}) - origin;
  const Eigen::Vector2d along_y = from_cells(geometry, {0.5, 1.5}) - origin;
  Eigen::Matrix3d matrix;
  matrix << along_x.x(), along_y.x(), origin.x(),  //
      along_x.y(), along_y.y(), origin.y(),        //
      0.0, 0.0, 1.0;
  return matrix;
}

Eigen::Vector2d middle_of_known(const GridImage& image) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double count = 0.0;
  for (int row = 0; row < image.rows(); ++row) {
    for (int col = 0; col < image.cols(); ++col) {
      if (image.known(row, col) == 0.0F) continue;
      sum += Eigen::Vector2d(col, row);
      count += 1.0;
    }
  }
  return sum / count;
}

}  // namespace hypermap
