// SPDX-License-Identifier: BSD-3-Clause
// Rays that march from voxel to voxel, and occlusion rays that intersect a box: every instruction
// set of this processor against walks by the definition.
#include "kernels/kernels.hpp"
#include "octree_semantic/support/every_kernel_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace hypermap::kernels {
namespace {

class RayKernels : public EverySet {};
INSTANTIATE_TEST_SUITE_P(OfThisProcessor,
                         RayKernels,
                         ::testing::ValuesIn(all_sets()),
                         [](const auto& set_info) { return std::string(set_info.param.name); });

/// A window of bricks, and rays from one voxel of it as whole numbers of voxels and steps.
struct RayWorld {
  static constexpr std::int64_t kBricks[3] = {5, 3, 4};
  static constexpr std::size_t kNumBricks = 60;

  static std::int64_t cell(const std::array<int, 3>& voxel) {
    std::int64_t brick = 0;
    std::int64_t place = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      brick = brick * kBricks[i] + voxel[i] / 8;
      for (int bit = 0; bit < 3; ++bit) {
        place |= static_cast<std::int64_t>((voxel[i] >> bit) & 1)
                 << (3 * bit + static_cast<int>(i));
      }
    }
    return brick * 512 + place;
  }

  std::array<int, 3> first{17, 12, 15};
  std::array<int, 3> last{};
  std::array<int, 3> step{};
  std::array<double, 3> next{};
  std::array<double, 3> per_voxel{};
  double limit = 0.0;

  /// A way that ends at a voxel on it, or at the limit.
  explicit RayWorld(std::mt19937& random) {
    std::uniform_real_distribution<double> distance(0.01, 1.0);
    for (std::size_t i = 0; i < 3; ++i) {
      step[i] = static_cast<int>(random() % 3) - 1;
      if (i == 2 && step[0] == 0 && step[1] == 0) step[2] = 1;
      const double never = std::numeric_limits<double>::max();
      per_voxel[i] = step[i] == 0 ? never : distance(random);
      next[i] = step[i] == 0 ? never : per_voxel[i] * distance(random);
      if (random() % 5 == 0 && step[i] != 0) next[i] = 0.5;  // ties
    }
    limit = 3.0 * distance(random);
    last = {-1, -1, -1};
    const std::vector<std::array<int, 3>> all = way();
    if (random() % 2 == 0 && all.size() > 1) {
      last = all[1 + random() % (all.size() - 1)];
      limit = 1e9;
    }
  }

  /// The voxels on the way, one after another.
  [[nodiscard]] std::vector<std::array<int, 3>> way() const {
    std::vector<std::array<int, 3>> voxels;
    std::array<int, 3> at = first;
    std::array<double, 3> to = next;
    do {
      voxels.push_back(at);
      const std::size_t nearer_of_xy = to[0] < to[1] ? 0 : 1;
      const std::size_t axis = to[nearer_of_xy] < to[2] ? nearer_of_xy : 2;
      at[axis] += step[axis];
      to[axis] += per_voxel[axis];
      for (std::size_t i = 0; i < 3; ++i) {
        if (at[i] < 0 || at[i] >= 8 * kBricks[i]) return voxels;
      }
    } while (at != last && *std::min_element(to.begin(), to.end()) <= limit);
    return voxels;
  }

  /// Ends at the edge of the window at the latest.
  [[nodiscard]] MarchedRay ray() const {
    MarchedRay ray;
    const std::vector<std::array<int, 3>> all = way();
    const std::int64_t stride[3] = {kBricks[1] * kBricks[2], kBricks[2], 1};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int64_t axis = kAxisBits << i;
      ray.next[i] = next[i];
      ray.per_voxel[i] = per_voxel[i];
      ray.place[i] = cell(first) & axis;
      ray.step[i] = step[i] == 0 ? 0 : step[i] > 0 ? -axis : -(std::int64_t{1} << i);
      ray.behind[i] = step[i] > 0 ? 0 : axis;
      ray.brick_step[i] = std::int64_t{step[i]} * 512 * stride[i];
    }
    ray.brick = cell(first) & ~std::int64_t{511};
    ray.limit = limit;
    ray.last_cell = last[0] < 0 ? -1 : cell(last);
    return ray;
  }
};

TEST_P(RayKernels, MarchesThroughTheVoxelsOfAWalkStepByStep) {
  for (const std::size_t size : {1U, 2U, 7U, 8U, 9U, 31U, 256U}) {
    std::vector<MarchedRay> rays;
    std::vector<std::uint64_t> expected(RayWorld::kNumBricks * 8);
    std::vector<std::uint8_t> expected_touched(RayWorld::kNumBricks);
    while (rays.size() < size) {
      const RayWorld world(random_);
      const auto way = world.way();
      // Long ones would leave the window; a ray has two voxels at least.
      if (way.size() > 11 || way.size() < 2) continue;
      rays.push_back(world.ray());
      for (const auto& voxel : way) {
        const auto cell = static_cast<std::size_t>(RayWorld::cell(voxel));
        expected[cell / 64] |= std::uint64_t{1} << (cell % 64);
        expected_touched[cell / 512] = 1;
      }
    }
    std::vector<std::uint64_t> words(expected.size());
    std::vector<std::uint8_t> touched(expected_touched.size());
    set().march_rays(rays.data(), rays.size(), {words.data(), touched.data()});
    EXPECT_EQ(words, expected) << size;
    EXPECT_EQ(touched, expected_touched) << size;
  }
}

RayPacket random_rays(std::mt19937& random) {
  std::uniform_real_distribution<float> within(-20.0F, 20.0F);
  RayPacket rays;
  for (std::size_t lane = 0; lane < kRayLanes; ++lane) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      rays.origin[axis][lane] = within(random);
      // Now and then along an axis, and on a face.
      const float direction = random() % 5 == 0 ? 0.0F : within(random);
      rays.direction[axis][lane] = direction;
      rays.inverse[axis][lane] = direction == 0.0F ? 1e30F : 1.0F / direction;
      if (random() % 5 == 0) rays.origin[axis][lane] = std::round(rays.origin[axis][lane]);
    }
    rays.end[lane] = std::abs(within(random)) / 20.0F;
  }
  return rays;
}

/// By the definition: is some of the way between all pairs of faces?
bool intersects(const RayPacket& rays, std::size_t lane, const BoxFaces& box) {
  float first = 0.0F;
  float last = rays.end[lane];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float low = (box.low[axis] - rays.origin[axis][lane]) * rays.inverse[axis][lane];
    const float high = (box.high[axis] - rays.origin[axis][lane]) * rays.inverse[axis][lane];
    first = std::max(first, std::min(low, high));
    last = std::min(last, std::max(low, high));
  }
  return first <= last;
}

TEST_P(RayKernels, FindsTheLinesThatMeetABox) {
  int num_meeting = 0;
  for (int round = 0; round < 500; ++round) {
    const RayPacket rays = random_rays(random_);
    BoxFaces box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = static_cast<float>(static_cast<int>(random_() % 30) - 20);
      box.high[axis] = box.low[axis] + static_cast<float>(1 + random_() % 20);
    }
    for (const std::size_t num_lanes : {4U, 8U, 16U}) {
      std::vector<std::int32_t> valid(num_lanes);
      std::uint32_t expected = 0;
      for (std::size_t lane = 0; lane < num_lanes; ++lane) {
        valid[lane] = random_() % 4 == 0 ? 0 : -1;
        if (valid[lane] != 0 && intersects(rays, lane, box)) expected |= 1U << lane;
      }
      EXPECT_EQ(set().intersect_box(rays, box, valid.data(), num_lanes), expected);
      num_meeting += std::popcount(expected);
    }
  }
  EXPECT_GT(num_meeting, 200);
}

TEST(RayKernelsByHand, ALineMeetsABoxOnItsWayAndNotBehindItsEnd) {
  // From (0, 2.5, 2.5) along x to a box from x = 4 to 6.
  RayPacket rays;
  for (std::size_t lane = 0; lane < 4; ++lane) {
    rays.direction[0][lane] = 1.0F;
    rays.inverse[0][lane] = 1.0F;
    for (std::size_t axis = 1; axis < 3; ++axis) {
      rays.origin[axis][lane] = 2.5F;
      rays.inverse[axis][lane] = 1e30F;
    }
    rays.end[lane] = 10.0F;
  }
  rays.end[1] = 3.9F;            // ends before it
  rays.origin[1][2] = 3.5F;      // passes beside it
  rays.direction[0][3] = -1.0F;  // goes away from it
  rays.inverse[0][3] = -1.0F;
  const BoxFaces box{{4, 2, 2}, {6, 3, 3}};
  const std::array<std::int32_t, 4> all{-1, -1, -1, -1};
  EXPECT_EQ(best_kernels().intersect_box(rays, box, all.data(), 4), 0b0001U);
  const std::array<std::int32_t, 4> not_the_first{0, -1, -1, -1};
  EXPECT_EQ(best_kernels().intersect_box(rays, box, not_the_first.data(), 4), 0U);
}

TEST(RayKernelsByHand, ARayStepsFromBrickToBrickAndLeavesItsLastVoxelOut) {
  // Along -x from x = 9 to x = 6, over the face between two bricks, in a window of two.
  MarchedRay ray;
  const std::int64_t first = 512 + 1;
  const std::int64_t brick_step = -512;
  ray = {.next = {0.5, 1e9, 1e9},
         .per_voxel = {1.0, 1e9, 1e9},
         .limit = 100.0,
         .place = {1, 0, 0},
         .step = {-1, 0, 0},
         .behind = {0b001'001'001, 0, 0},
         .brick_step = {brick_step, 0, 0},
         .brick = first & ~std::int64_t{511},
         .last_cell = 0b001'001'000};  // x = 6
  std::uint64_t words[16] = {};
  std::uint8_t touched[2] = {};
  scalar_kernels().march_rays(&ray, 1, {words, touched});
  EXPECT_EQ(words[8], 0b11U) << "x = 9 and x = 8";
  EXPECT_EQ(words[1], std::uint64_t{1} << (0b001'001'001 - 64)) << "x = 7";
  EXPECT_EQ(words[0] | words[2] | words[9], 0U);
  EXPECT_EQ(touched[0] + touched[1], 2);
}

}  // namespace
}  // namespace hypermap::kernels
