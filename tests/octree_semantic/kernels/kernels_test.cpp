// SPDX-License-Identifier: BSD-3-Clause
// Every instruction set of this processor against the scalar code, bit for bit.
#include "kernels/kernels.hpp"

#include "octree_semantic/support/every_kernel_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

namespace hypermap::kernels {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

template <class T>
std::vector<std::uint8_t> bytes_of(const std::vector<T>& values) {
  std::vector<std::uint8_t> bytes(values.size() * sizeof(T));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// Depths of a row with everything that may stand in one.
std::vector<float> depths(std::size_t size, std::mt19937& random) {
  std::uniform_real_distribution<float> depth(0.1F, 12.0F);
  const std::vector<float> odd{
      0.0F, -0.0F, -1.0F, kNan, kInfinity, -kInfinity, 1e30F, 3e38F, 1e-40F, 1e19F};
  std::vector<float> row(size);
  for (float& value : row) {
    value = random() % 4 == 0 ? odd[random() % odd.size()] : depth(random);
  }
  return row;
}

RowRays some_rays() {
  return {{0.0011, -0.0013, 0.0004}, {0.3, 0.91, -0.2}, {1.234567, -7.1, 0.333}, 319.37};
}

class KernelsOfEverySet : public EverySet {};
INSTANTIATE_TEST_SUITE_P(OfThisProcessor,
                         KernelsOfEverySet,
                         ::testing::ValuesIn(all_sets()),
                         [](const auto& set_info) { return std::string(set_info.param.name); });

constexpr std::size_t kSizes[] = {1, 2, 3, 7, 8, 15, 16, 17, 63, 64, 65, 320, 639, 640, 641};

TEST_P(KernelsOfEverySet, UnprojectsRowsToTheSameBits) {
  for (const std::size_t size : kSizes) {
    const std::vector<float> row = depths(size, random_);
    const std::size_t padded = (size + kBlock - 1) / kBlock * kBlock;
    const auto points = [&](const Kernels& kernels) {
      std::vector<float> xyz(3 * padded, -1.0F);
      const RowCounts counts =
          kernels.unproject_row(some_rays(),
                                row.data(),
                                size,
                                {xyz.data(), xyz.data() + padded, xyz.data() + 2 * padded});
      xyz.push_back(static_cast<float>(counts.num_not_measured));
      xyz.push_back(static_cast<float>(counts.num_not_finite));
      return xyz;
    };
    EXPECT_EQ(bytes_of(points(set())), bytes_of(points(scalar_))) << size;
  }
}

TEST_P(KernelsOfEverySet, SummarisesRowsToTheSameBits) {
  for (const std::size_t size : kSizes) {
    const std::vector<float> first = depths(size, random_);
    const std::vector<float> second = depths(size, random_);
    const auto summary = [&](const Kernels& kernels) {
      std::vector<float> all(4 * size, 0.0F);
      std::fill_n(all.begin() + static_cast<std::ptrdiff_t>(size), size, kInfinity);
      const ColumnSummary columns{
          all.data(), all.data() + size, all.data() + 2 * size, all.data() + 3 * size};
      kernels.summarise_row(first.data(), size, columns);
      kernels.summarise_row(second.data(), size, columns);
      all.push_back(kernels.farthest(first.data(), size));
      return all;
    };
    EXPECT_EQ(bytes_of(summary(set())), bytes_of(summary(scalar_))) << size;
  }
}

TEST_P(KernelsOfEverySet, SeesTheSameCorners) {
  std::vector<float> image = depths(64UL * 48UL, random_);
  for (float& depth_m : image) {
    if (!(depth_m > 0.0F && depth_m < 100.0F)) depth_m = 0.0F;
  }
  CornerProjection projection{.depth_m = image.data(),
                              .width_px = 64,
                              .width = 64.0F,
                              .height = 48.0F,
                              .u0 = 32.0F,
                              .v0 = 24.0F,
                              .max_squared_m2 = 16.0F,
                              .per_fx = 1.0F / 60.0F,
                              .per_fy = 1.0F / 61.0F};
  for (std::size_t i = 0; i < 512; ++i) {
    projection.x[i] = 60.0F * 0.05F * static_cast<float>(i % 8);
    projection.y[i] = 61.0F * 0.05F * static_cast<float>(i / 8 % 8);
    const std::size_t layer = i / 64;
    projection.z[i] = 0.05F * static_cast<float>(layer);
  }
  std::uniform_real_distribution<float> place(-2.0F, 2.0F);
  int num_seen = 0;
  for (int brick = 0; brick < 200; ++brick) {
    const float z = brick % 8 == 0 ? -0.2F : 1.5F + place(random_);
    const float first[3] = {60.0F * place(random_), 61.0F * place(random_), z};
    for (const bool check_range : {false, true}) {
      std::vector<std::uint64_t> ours(8);
      std::vector<std::uint64_t> theirs(8);
      set().test_corners(projection, first, check_range, ours.data());
      scalar_.test_corners(projection, first, check_range, theirs.data());
      EXPECT_EQ(ours, theirs);
      for (const std::uint64_t word : ours) num_seen += std::popcount(word);
    }
  }
  EXPECT_GT(num_seen, 1000);
}

TEST_P(KernelsOfEverySet, MergesBricksToTheSameBits) {
  const EvidenceSteps steps{847, -405, -2000, 3511, 0};
  struct alignas(64) LogOddsOfBrick {
    std::int16_t values[512];
  };
  for (int round = 0; round < 50; ++round) {
    LogOddsOfBrick ours{};
    std::vector<std::uint64_t> known(8);
    std::vector<std::uint64_t> occupied(8);
    std::vector<std::uint64_t> hit(8);
    std::vector<std::uint64_t> passed(8);
    const auto bits = [&] { return (std::uint64_t{random_()} << 32U | random_()) & random_(); };
    for (std::size_t i = 0; i < 8; ++i) {
      if (random_() % 3 != 0) hit[i] = bits() & bits();
      if (random_() % 3 != 0) passed[i] = bits();
      known[i] = bits();
      occupied[i] = known[i] & bits();
    }
    for (std::int16_t& value : ours.values) {
      value = static_cast<std::int16_t>(static_cast<int>(random_() % 5512) - 2000);
    }
    LogOddsOfBrick theirs = ours;
    auto their_known = known;
    auto their_occupied = occupied;
    const MergeCounts counts = set().merge_brick(
        {known.data(), occupied.data(), ours.values}, hit.data(), passed.data(), steps);
    const MergeCounts expected =
        scalar_.merge_brick({their_known.data(), their_occupied.data(), theirs.values},
                            hit.data(),
                            passed.data(),
                            steps);
    EXPECT_TRUE(std::equal(ours.values, ours.values + 512, theirs.values));
    EXPECT_EQ(known, their_known);
    EXPECT_EQ(occupied, their_occupied);
    EXPECT_EQ(counts.num_hit, expected.num_hit);
    EXPECT_EQ(counts.num_passed, expected.num_passed);
    EXPECT_EQ(counts.changed, expected.changed);
  }
}

TEST(Kernels, MergingAddsAndClampsAndCounts) {
  // OctoMap, Eq. (4) and (5): a hit adds 0.847, a miss 0.405 less, within -2 .. 3.511.
  alignas(64) std::int16_t log_odds[512] = {0, 3000, -100, -1900, 500};
  std::uint64_t known[8] = {};
  std::uint64_t occupied[8] = {0b10010};
  const std::uint64_t hit[8] = {0b00011};
  const std::uint64_t passed[8] = {0b01111};
  const MergeCounts counts = scalar_kernels().merge_brick(
      {known, occupied, log_odds}, hit, passed, {847, -405, -2000, 3511, 0});
  EXPECT_EQ(log_odds[0], 847);
  EXPECT_EQ(log_odds[1], 3511);
  EXPECT_EQ(log_odds[2], -505);
  EXPECT_EQ(log_odds[3], -2000);
  EXPECT_EQ(log_odds[4], 500);
  EXPECT_EQ(known[0], 0b01111U);
  EXPECT_EQ(occupied[0], 0b10011U) << "what the frame did not see stays occupied";
  EXPECT_EQ(counts.num_hit, 2U);
  EXPECT_EQ(counts.num_passed, 2U);
  EXPECT_TRUE(counts.changed);
}

}  // namespace
}  // namespace hypermap::kernels
