// SPDX-License-Identifier: BSD-3-Clause
#include "rival_search.hpp"

#include <opencv2/core.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace hypermap {
namespace {

constexpr int kMaxSide = 256;
constexpr int kMaxWarpedSide = 2048;
constexpr double kMinOverlap = 0.3;  ///< Of the moving image's known cells: less is chance.

/// At half the resolution: means of the known cells of each square of four.
GridImage halved(const GridImage& image) {
  const int rows = (image.rows() + 1) / 2;
  const int cols = (image.cols() + 1) / 2;
  GridImage half{Plane::Zero(rows, cols), Plane::Zero(rows, cols)};
  Plane count = Plane::Zero(rows, cols);
  for (int row = 0; row < image.rows(); ++row) {
    for (int col = 0; col < image.cols(); ++col) {
      half.value(row / 2, col / 2) += image.value(row, col);
      count(row / 2, col / 2) += image.known(row, col);
    }
  }
  half.value /= count.max(1.0F);
  half.known = count.min(1.0F);
  return half;
}

/// From the cells of an image to those of it halved.
Eigen::Matrix3d half_from_whole() {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(0, 0) = matrix(1, 1) = 0.5;
  matrix(0, 2) = matrix(1, 2) = -0.25;
  return matrix;
}

/// By quarters of a turn about a point.
Eigen::Matrix3d quarter_turns(int num_quarters, const Eigen::Vector2d& about) {
  constexpr std::array<int, 4> kCos{1, 0, -1, 0};
  constexpr std::array<int, 4> kSin{0, 1, 0, -1};
  const double c = kCos[static_cast<std::size_t>(num_quarters)];
  const double s = kSin[static_cast<std::size_t>(num_quarters)];
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << c, -s, s, c;
  turn.topRightCorner<2, 1>() = about - turn.topLeftCorner<2, 2>() * about;
  return turn;
}

/// An image on the cells of another one, its first cell at `first` of them.
struct WarpedImage {
  GridImage image;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
};

WarpedImage warped(const GridImage& moving, const Eigen::Matrix3d& placement) {
  constexpr double kAllKnown = 0.999;
  const double cols = moving.cols() - 1.0;
  const double rows = moving.rows() - 1.0;
  Eigen::Vector2d min = moved(placement, {0.0, 0.0});
  Eigen::Vector2d max = min;
  for (const Eigen::Vector2d& corner :
       {Eigen::Vector2d(cols, 0), Eigen::Vector2d(0, rows), Eigen::Vector2d(cols, rows)}) {
    min = min.cwiseMin(moved(placement, corner));
    max = max.cwiseMax(moved(placement, corner));
  }
  WarpedImage result;
  result.first = min.array().floor();
  const Eigen::Vector2d size =
      (max - result.first).array().ceil().min(kMaxWarpedSide - 1.0).max(0.0) + 1.0;
  const auto width = static_cast<Eigen::Index>(size.x());
  const auto height = static_cast<Eigen::Index>(size.y());
  result.image = {Plane::Zero(height, width), Plane::Zero(height, width)};
  const Eigen::Matrix3d inverse = placement.inverse();
  for (Eigen::Index row = 0; row < height; ++row) {
    for (Eigen::Index col = 0; col < width; ++col) {
      const Eigen::Vector2d from =
          moved(inverse,
                result.first + Eigen::Vector2d(static_cast<double>(col), static_cast<double>(row)));
      if (!is_inside(moving.known, from)) continue;
      if (sampled(moving.known, from).value < kAllKnown) continue;
      result.image.value(row, col) = static_cast<float>(sampled(moving.value, from).value);
      result.image.known(row, col) = 1.0F;
    }
  }
  return result;
}

/// Padded, and transformed.
cv::Mat spectrum(const Plane& plane, const cv::Size& size) {
  cv::Mat padded = cv::Mat::zeros(size, CV_64F);
  for (int row = 0; row < plane.rows(); ++row) {
    for (int col = 0; col < plane.cols(); ++col) {
      padded.at<double>(row, col) = static_cast<double>(plane(row, col));
    }
  }
  cv::Mat transformed;
  cv::dft(padded, transformed);
  return transformed;
}

/// At (u, v), both modulo the size: the sum over cells of a(cell + (u, v)) b(cell).
cv::Mat correlation(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat product;
  cv::mulSpectrums(a, b, product, 0, true);
  cv::Mat sums;
  cv::idft(product, sums, cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
  return sums;
}

/// All sums that the correlation coefficient of two masked images takes, of each shift.
struct ShiftSums {
  cv::Mat count;
  cv::Mat fixed;
  cv::Mat moving;
  cv::Mat products;
  cv::Mat fixed_squares;
  cv::Mat moving_squares;
};

ShiftSums sums_of_shifts(const GridImage& moving, const GridImage& fixed) {
  const cv::Size size(cv::getOptimalDFTSize(moving.cols() + fixed.cols()),
                      cv::getOptimalDFTSize(moving.rows() + fixed.rows()));
  const cv::Mat moving_known = spectrum(moving.known, size);
  const cv::Mat fixed_known = spectrum(fixed.known, size);
  const cv::Mat moving_value = spectrum(moving.value * moving.known, size);
  const cv::Mat fixed_value = spectrum(fixed.value * fixed.known, size);
  return {correlation(fixed_known, moving_known),
          correlation(fixed_value, moving_known),
          correlation(fixed_known, moving_value),
          correlation(fixed_value, moving_value),
          correlation(spectrum(fixed.value.square() * fixed.known, size), moving_known),
          correlation(fixed_known, spectrum(moving.value.square() * moving.known, size))};
}

double explained_by(const ShiftSums& sums, int row, int col, double num_known) {
  const double n = std::round(sums.count.at<double>(row, col));
  if (n < 1.0 || n < kMinOverlap * num_known) return 0.0;
  const double fixed = sums.fixed.at<double>(row, col);
  const double moving = sums.moving.at<double>(row, col);
  const double spread_fixed = sums.fixed_squares.at<double>(row, col) - fixed * fixed / n;
  const double spread_moving = sums.moving_squares.at<double>(row, col) - moving * moving / n;
  constexpr double kLeastSpread = 1e-6;
  if (spread_fixed < kLeastSpread * n || spread_moving < kLeastSpread * n) return 0.0;
  const double agreement = (sums.products.at<double>(row, col) - fixed * moving / n) /
                           std::sqrt(spread_fixed * spread_moving);
  return agreement * std::sqrt(n / num_known);
}

/// What placements explain: the best within kRivalDistanceCells of no shift, and beyond.
struct NearAndFar {
  double near = 0.0;
  double far = 0.0;
};

NearAndFar best_shifts(const GridImage& moving,
                       const GridImage& fixed,
                       const Eigen::Matrix3d& placement,
                       int distance_cells,
                       const PlacementFilter& is_allowed) {
  const WarpedImage there = warped(moving, placement);
  const double num_known = static_cast<double>(there.image.known.sum());
  NearAndFar best;
  if (num_known == 0.0) return best;
  const ShiftSums sums = sums_of_shifts(there.image, fixed);
  for (int row = 1 - there.image.rows(); row < fixed.rows(); ++row) {
    for (int col = 1 - there.image.cols(); col < fixed.cols(); ++col) {
      // The shift is (col, row) from the cell of the fixed image that the first cell falls on.
      const int wrapped_row = row < 0 ? row + sums.count.rows : row;
      const int wrapped_col = col < 0 ? col + sums.count.cols : col;
      const Eigen::Vector2d shift = Eigen::Vector2d(col, row) - there.first;
      const bool is_near = shift.cwiseAbs().maxCoeff() <= distance_cells;
      double& best_of_kind = is_near ? best.near : best.far;
      const double explained = explained_by(sums, wrapped_row, wrapped_col, num_known);
      if (explained <= best_of_kind) continue;
      Eigen::Matrix3d shifted = Eigen::Matrix3d::Identity();
      shifted.topRightCorner<2, 1>() = shift;
      if (!is_near && !is_allowed(shifted * placement)) continue;
      best_of_kind = explained;
    }
  }
  return best;
}

}  // namespace

double best_rival_share(const GridImage& moving,
                        const GridImage& fixed,
                        const Eigen::Matrix3d& placement,
                        const PlacementFilter& is_allowed) {
  GridImage small_moving = moving;
  GridImage small_fixed = fixed;
  Eigen::Matrix3d small_from_whole = Eigen::Matrix3d::Identity();
  int distance_cells = kRivalDistanceCells;
  while (
      std::max({small_moving.cols(), small_moving.rows(), small_fixed.cols(), small_fixed.rows()}) >
      kMaxSide) {
    small_moving = halved(small_moving);
    small_fixed = halved(small_fixed);
    small_from_whole = half_from_whole() * small_from_whole;
    distance_cells = std::max(2, (distance_cells + 1) / 2);
  }
  small_moving = smoothed(small_moving, 1.0);
  small_fixed = smoothed(small_fixed, 1.0);
  const Eigen::Matrix3d whole_from_small = small_from_whole.inverse();
  const Eigen::Matrix3d small_placement = small_from_whole * placement * whole_from_small;
  const auto is_allowed_small = [&](const Eigen::Matrix3d& small) {
    return is_allowed(whole_from_small * small * small_from_whole);
  };
  const Eigen::Vector2d middle = middle_of_known(small_moving);
  NearAndFar best;
  for (int num_quarters = 0; num_quarters < 4; ++num_quarters) {
    const Eigen::Matrix3d turned = small_placement * quarter_turns(num_quarters, middle);
    const NearAndFar found = best_shifts(small_moving,
                                         small_fixed,
                                         turned,
                                         num_quarters == 0 ? distance_cells : -1,
                                         is_allowed_small);
    if (num_quarters == 0) best.near = found.near;
    best.far = std::max(best.far, found.far);
  }
  return best.near > 0.0 ? best.far / best.near : 1.0;
}

}  // namespace hypermap
