// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"
#include "octree_semantic/integration/integration_cases.hpp"
#include "octree_semantic/support/integrate.hpp"
#include "octree_semantic/support/labelled_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace hypermap::test {
namespace {

/// Voxels by the book: sets of keys, rays walked one after the other in double precision.
class NaiveMapper {
 public:
  void integrate(const VoxelGrid& grid,
                 const Eigen::Vector3d& sensor,
                 const std::vector<Eigen::Vector3f>& points,
                 double max_range_m) {
    std::set<VoxelKey> hit;
    std::set<VoxelKey> passed;
    for (const Eigen::Vector3f& point : points) {
      const Eigen::Vector3d way = point.cast<double>() - sensor;
      const double length = std::min(way.norm(), max_range_m);
      const Eigen::Vector3d direction = way.normalized();
      // Crossings of all planes of the grid, in order, give the voxels between them.
      std::vector<double> crossings{0.0};
      for (int axis = 0; axis < 3; ++axis) {
        const double from = sensor[axis] / grid.resolution_m();
        const double to = (sensor[axis] + direction[axis] * length) / grid.resolution_m();
        const auto first = static_cast<int>(std::ceil(std::min(from, to)));
        const auto last = static_cast<int>(std::floor(std::max(from, to)));
        for (int plane = first; plane <= last; ++plane) {
          crossings.push_back((plane - from) / (to - from) * length);
        }
      }
      crossings.push_back(length);
      std::sort(crossings.begin(), crossings.end());
      for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
        if (crossings[i + 1] - crossings[i] < 1e-7) continue;  // a corner
        const double middle = 0.5 * (crossings[i] + crossings[i + 1]);
        const auto key = grid.key(PointInMap{sensor + middle * direction});
        const bool last = i + 2 == crossings.size();
        if (!last) passed.insert(*key);
      }
      if (way.norm() <= max_range_m) hit.insert(*grid.key(PointInMap{point.cast<double>()}));
    }
    for (const VoxelKey& key : hit) add(key, 847);
    for (const VoxelKey& key : passed) {
      if (!hit.contains(key)) add(key, -405);
    }
  }
  [[nodiscard]] const std::map<VoxelKey, int>& voxels() const { return voxels_; }

 private:
  void add(const VoxelKey& key, int evidence) {
    voxels_[key] = std::clamp(voxels_[key] + evidence, -2000, 3511);
  }
  std::map<VoxelKey, int> voxels_;
};

TEST(FrameIntegrator, ExactModeAgreesWithANaiveMapperOnRandomScenes) {
  std::mt19937 random(23);
  std::uniform_real_distribution<float> within(-3.0F, 3.0F);
  SemanticOctree tree = empty_tree();
  FrameIntegrator integrator;
  NaiveMapper naive;
  for (int frame = 0; frame < 6; ++frame) {
    const Eigen::Vector3d sensor =
        Eigen::Vector3f(within(random), within(random), within(random)).cast<double>() * 0.3;
    const Eigen::Vector3d rounded = sensor.cast<float>().cast<double>();
    std::vector<Eigen::Vector3f> points;
    points.reserve(500);
    for (int i = 0; i < 500; ++i) {
      points.emplace_back(within(random), within(random), within(random));
    }
    ASSERT_TRUE(
        integrator.integrate_cloud(tree, {rounded}, points, {}, {IntegrationMode::kExact, 2.5, 1}));
    naive.integrate(tree.grid(), rounded, points, 2.5);
  }
  // A ray that grazes a corner within rounding may take either way: a few voxels of some 30,000.
  std::size_t num_differing = 0;
  for (const auto& [key, log_odds] : naive.voxels()) {
    const auto leaf = tree.stored_at(key);
    num_differing += !leaf || leaf->log_odds != log_odds ? 1U : 0U;
  }
  tree.for_each_stored_leaf([&](const StoredLeaf& leaf) {
    num_differing += naive.voxels().contains(leaf.key) ? 0U : 1U;
  });
  EXPECT_GT(naive.voxels().size(), 10'000U);
  EXPECT_LE(num_differing, naive.voxels().size() / 2000);
}

}  // namespace
}  // namespace hypermap::test
