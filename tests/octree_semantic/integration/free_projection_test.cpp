// SPDX-License-Identifier: BSD-3-Clause
// Mode projective against its rule by the book: corner by corner, without bricks and pyramids.
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"
#include "integration/marking/corner_bits.hpp"
#include "integration/marking/depth_pyramid.hpp"
#include "octree_semantic/support/labelled_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

namespace hypermap::test {
namespace {

constexpr double kRange = 3.5;
constexpr double kEdge = 0.1;

TEST(CornerBits, AVoxelIsSetWhenOneOfItsEightCornersIs) {
  // Two bricks along each axis; the corners beyond them are not set.
  std::mt19937 random(5);
  std::array<BrickWords, 8> bricks{};
  std::set<std::array<unsigned, 3>> corners;
  for (std::size_t brick = 0; brick < 8; ++brick) {
    for (std::size_t cell = 0; cell < 512; ++cell) {
      if (random() % 40 != 0) continue;
      bricks[brick][cell / 64] |= std::uint64_t{1} << (cell % 64);
      std::array<unsigned, 3> at{};
      for (unsigned i = 0; i < 3; ++i) {
        at[i] = (gather_bits(cell >> i) & 7U) + (brick >> i & 1U ? 8U : 0U);
      }
      corners.insert(at);
    }
  }
  std::array<const BrickWords*, 8> pointers{};
  for (std::size_t i = 0; i < 8; ++i) pointers[i] = &bricks[i];
  const BrickWords voxels = voxels_of_corners(pointers);
  for (std::size_t cell = 0; cell < 512; ++cell) {
    bool expected = false;
    for (unsigned i = 0; i < 8; ++i) {
      std::array<unsigned, 3> at{};
      for (unsigned axis = 0; axis < 3; ++axis) {
        at[axis] = (gather_bits(cell >> axis) & 7U) + (i >> axis & 1U);
      }
      expected |= corners.contains(at);
    }
    EXPECT_EQ((voxels[cell / 64] >> (cell % 64) & 1U) != 0, expected) << cell;
  }
}

TEST(DepthPyramid, BoundsContainEveryRectangleAndAreTightOnTiles) {
  std::mt19937 random(9);
  constexpr int kWidth = 101;
  constexpr int kHeight = 67;
  std::vector<float> depth_m(static_cast<std::size_t>(kWidth * kHeight));
  for (float& value : depth_m) {
    value = random() % 50 == 0 ? std::numeric_limits<float>::infinity()
                               : static_cast<float>(random() % 1000) * 0.01F;
  }
  const std::vector<std::uint32_t> dropped{3, 77};
  DepthPyramid pyramid;
  pyramid.build(depth_m, kWidth, dropped, Workers());
  EXPECT_EQ(pyramid.clean()[77], 0.0F);
  const auto brute_force = [&](const PixelSpan& rect) {
    DepthBounds bounds{std::numeric_limits<float>::infinity(), 0.0F};
    for (int v = rect.v_min; v <= rect.v_max; ++v) {
      for (int u = rect.u_min; u <= rect.u_max; ++u) {
        const float value =
            pyramid.clean()[static_cast<std::size_t>(v) * kWidth + static_cast<std::size_t>(u)];
        bounds = {std::min(bounds.min_m, value), std::max(bounds.max_m, value)};
      }
    }
    return bounds;
  };
  for (int i = 0; i < 500; ++i) {
    const auto draw = [&](int size) {
      const std::pair<int, int> ends =
          std::minmax({static_cast<int>(random()) & 127, static_cast<int>(random()) & 127});
      return std::pair(std::min(ends.first, size - 1), std::min(ends.second, size - 1));
    };
    const auto [u_min, u_max] = draw(kWidth);
    const auto [v_min, v_max] = draw(kHeight);
    const PixelSpan rect{u_min, v_min, u_max, v_max};
    const DepthBounds expected = brute_force(rect);
    const DepthBounds bounds = pyramid.bounds(rect);
    EXPECT_LE(bounds.min_m, expected.min_m);
    EXPECT_GE(bounds.max_m, expected.max_m);
  }
  const PixelSpan tile{16, 24, 23, 31};
  EXPECT_EQ(pyramid.bounds(tile).min_m, brute_force(tile).min_m);
  EXPECT_EQ(pyramid.bounds(tile).max_m, brute_force(tile).max_m);
  EXPECT_EQ(pyramid.bounds().max_m, brute_force({0, 0, kWidth - 1, kHeight - 1}).max_m);
}

/// Whether the camera sees a point in front of what it measured.
bool sees(const RgbdFrame& frame, const Eigen::Vector3d& point) {
  const PointInCamera in_camera = frame.map_from_camera.inverse() * PointInMap{point};
  const auto pixel = frame.camera.project(in_camera);
  if (!pixel || in_camera.xyz.norm() > kRange) return false;
  const double u = std::floor(pixel->u_px + 0.5);
  const double v = std::floor(pixel->v_px + 0.5);
  if (!(u >= 0 && v >= 0 && u < frame.camera.width_px && v < frame.camera.height_px)) return false;
  const float depth_m = frame.depth_m.at(static_cast<int>(u), static_cast<int>(v));
  return std::isfinite(depth_m) && static_cast<double>(depth_m) > in_camera.xyz.z();
}

bool sees_a_corner(const RgbdFrame& frame, const Eigen::Vector3d& centre) {
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d side((i & 1) - 0.5, (i >> 1 & 1) - 0.5, (i >> 2) - 0.5);
    if (sees(frame, centre + side * kEdge)) return true;
  }
  return false;
}

TEST(FreeProjection, AgreesWithTheRuleCornerByCorner) {
  for (const LabelledFrame& labelled : room_frames(3, 320)) {
    const RgbdFrame& frame = labelled.frame;
    auto tree = SemanticOctree::create({.resolution_m = kEdge}).value();
    const auto report = FrameIntegrator().integrate(
        tree, frame, {}, {.mode = IntegrationMode::kProjective, .max_range_m = kRange});
    ASSERT_TRUE(report);
    const Eigen::Vector3d sensor = frame.map_from_camera.origin().xyz;
    const VoxelKey low = *tree.grid().key(PointInMap{sensor.array() - kRange - kEdge});
    const VoxelKey high = *tree.grid().key(PointInMap{sensor.array() + kRange + kEdge});
    std::size_t num_free = 0;
    std::size_t num_differing = 0;
    for (std::uint16_t x = low.x; x <= high.x; ++x) {
      for (std::uint16_t y = low.y; y <= high.y; ++y) {
        for (std::uint16_t z = low.z; z <= high.z; ++z) {
          const auto leaf = tree.at(VoxelKey{x, y, z});
          if (leaf && leaf->occupied) continue;
          const bool expected = sees_a_corner(frame, tree.grid().centre({x, y, z}).xyz);
          num_free += static_cast<std::size_t>(expected);
          num_differing += static_cast<std::size_t>(leaf.has_value() != expected);
        }
      }
    }
    // Single precision may take the pixel beside; the few rays next to the sensor add voxels.
    EXPECT_GT(num_free, 5'000U);
    EXPECT_LE(num_differing, num_free / 1000) << num_free;
  }
}

}  // namespace
}  // namespace hypermap::test
