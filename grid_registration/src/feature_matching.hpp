// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which places of two images look alike.
#pragma once

#include "grid_image.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace hypermap {

/// A place of each image, (column, row).
struct FeatureMatch {
  std::size_t feature = 0;  ///< Of the moving image; several matches may be of one.
  Eigen::Vector2d moving = Eigen::Vector2d::Zero();
  Eigen::Vector2d fixed = Eigen::Vector2d::Zero();
};

struct FeatureMatches {
  std::size_t num_moving = 0;  ///< Features that each image has.
  std::size_t num_fixed = 0;
  std::vector<FeatureMatch> matches;
};

/// ORB features of what is occupied, each of the moving image with the few of the fixed one that
/// look most like it: corners of rooms look alike, so the best alone is often wrong. What is
/// unknown counts as free, so that the edge of what was seen is no feature.
[[nodiscard]] FeatureMatches matched_features(const GridImage& moving,
                                              const GridImage& fixed,
                                              int max_features);

}  // namespace hypermap
