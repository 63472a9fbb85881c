// SPDX-License-Identifier: BSD-3-Clause
#include "feature_matching.hpp"

#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include <algorithm>
#include <cmath>

namespace hypermap {
namespace {

/// A feature's patch, and the rim around the image that gives those at its border one.
constexpr int kPatchPx = 31;
constexpr int kRimPx = 40;
constexpr double kSigmaPx = 1.2;
constexpr int kMaxNeighbours = 4;
constexpr float kMaxDistance = 80.0F;  // of 256 bits

struct OrbFeatures {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
};

/// What is occupied, 0 to 255, with a rim of nothing.
cv::Mat occupied_image(const GridImage& image) {
  const Plane soft = blurred(image.value.max(0.0F), kSigmaPx);
  cv::Mat pixels = cv::Mat::zeros(image.rows() + 2 * kRimPx, image.cols() + 2 * kRimPx, CV_8U);
  const float brightest = std::max(soft.maxCoeff(), 1e-6F);
  for (int row = 0; row < image.rows(); ++row) {
    for (int col = 0; col < image.cols(); ++col) {
      pixels.at<std::uint8_t>(row + kRimPx, col + kRimPx) =
          cv::saturate_cast<std::uint8_t>(255.0F * soft(row, col) / brightest);
    }
  }
  return pixels;
}

OrbFeatures features_of(const GridImage& image, int max_features) {
  constexpr float kScale = 1.2F;
  constexpr int kLevels = 4;
  constexpr int kFastThreshold = 10;
  const auto orb = cv::ORB::create(max_features,
                                   kScale,
                                   kLevels,
                                   kPatchPx,
                                   0,
                                   2,
                                   cv::ORB::HARRIS_SCORE,
                                   kPatchPx,
                                   kFastThreshold);
  OrbFeatures features;
  orb->detectAndCompute(
      occupied_image(image), cv::noArray(), features.points, features.descriptors);
  return features;
}

Eigen::Vector2d place_of(const cv::KeyPoint& point) {
  return Eigen::Vector2d(static_cast<double>(point.pt.x), static_cast<double>(point.pt.y)) -
         Eigen::Vector2d::Constant(kRimPx);
}

}  // namespace

FeatureMatches matched_features(const GridImage& moving, const GridImage& fixed, int max_features) {
  const OrbFeatures of_moving = features_of(moving, max_features);
  const OrbFeatures of_fixed = features_of(fixed, max_features);
  FeatureMatches found{of_moving.points.size(), of_fixed.points.size(), {}};
  if (of_moving.points.empty() || of_fixed.points.empty()) return found;
  std::vector<std::vector<cv::DMatch>> nearest;
  cv::BFMatcher(cv::NORM_HAMMING)
      .knnMatch(of_moving.descriptors, of_fixed.descriptors, nearest, kMaxNeighbours);
  for (const std::vector<cv::DMatch>& candidates : nearest) {
    for (const cv::DMatch& match : candidates) {
      if (match.distance > kMaxDistance) continue;
      const auto feature = static_cast<std::size_t>(match.queryIdx);
      found.matches.push_back(
          {feature,
           place_of(of_moving.points[feature]),
           place_of(of_fixed.points[static_cast<std::size_t>(match.trainIdx)])});
    }
  }
  return found;
}

}  // namespace hypermap
