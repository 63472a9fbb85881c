// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Short ways to put frames into trees; a refusal fails the test.
#pragma once

#include "hypermap/octree_semantic/integration/frame_integrator.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace hypermap::test {

inline constexpr std::array kAllModes{
    IntegrationMode::kExact, IntegrationMode::kDiscretize, IntegrationMode::kProjective};

inline SemanticOctree empty_tree(double resolution_m = 0.1) {
  return SemanticOctree::create({.resolution_m = resolution_m}).value();
}

inline IntegrationReport integrate(SemanticOctree& tree,
                                   const RgbdFrame& frame,
                                   const IntegrationOptions& options,
                                   const std::vector<PixelLabels>& labels = {}) {
  const auto report = FrameIntegrator().integrate(tree, frame, labels, options);
  EXPECT_TRUE(report) << to_string(report.error());
  return report.value_or(IntegrationReport{});
}

}  // namespace hypermap::test
