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

/// The cell of a point, by the definition; kNoVoxel for none.
std::uint32_t cell_by_definition(const CellGrid& grid, const std::array<float, 3>& point) {
  std::array<std::int32_t, 3> offset{};
  float squared = 0.0F;
  for (std::size_t i = 0; i < 3; ++i) {
    squared += (point[i] - grid.sensor[i]) * (point[i] - grid.sensor[i]);
  }
  if (!(squared <= grid.outer_max_squared)) return kNoVoxel;
  for (std::size_t i = 0; i < 3; ++i) {
    const double voxels = std::floor(static_cast<double>(point[i]) * grid.voxels_per_m);
    if (!(voxels - grid.corner[i] >= grid.first[i] && voxels - grid.corner[i] < grid.end[i])) {
      return kNoVoxel;
    }
    offset[i] = static_cast<std::int32_t>(voxels - grid.corner[i]);
  }
  const std::int32_t brick =
      offset[0] / 8 * grid.stride[0] + offset[1] / 8 * grid.stride[1] + offset[2] / 8;
  std::uint32_t cell = static_cast<std::uint32_t>(brick) * 512;
  for (unsigned bit = 0; bit < 3; ++bit) {
    for (unsigned i = 0; i < 3; ++i) {
      cell |= (static_cast<std::uint32_t>(offset[i]) >> bit & 1U) << (3 * bit + i);
    }
  }
  return cell;
}

TEST_P(KernelsOfEverySet, FindsTheCellsOfTheDefinitionOnFacesAndFarFromTheOriginToo) {
  // A window of 16 bricks an edge, from the map's origin to the end of its volume.
  for (const int corner : {-64, 1000, 32640, -32768}) {
    CellGrid grid{.voxels_per_m = 1.0 / 0.03,
                  .first = {0, 0, 0},
                  .end = {128, 128, 128},
                  .stride = {16 * 16, 16},
                  .max_squared = 100.0F,
                  .outer_max_squared = 100.0F};
    for (std::size_t i = 0; i < 3; ++i) {
      grid.corner[i] = corner;
      grid.sensor[i] = static_cast<float>(0.03 * (corner + 64));
    }
    constexpr std::size_t kSize = 6400;
    std::array<std::vector<float>, 3> points;
    std::uniform_real_distribution<float> in_voxels(0.0F, 130.0F);
    for (std::vector<float>& along : points) {
      for (std::size_t i = 0; i < kSize; ++i) {
        if (i / 16 % 2 == 0) {  // whole vectors of points that lie anywhere
          along.push_back(0.03F * (static_cast<float>(corner) + in_voxels(random_)));
          continue;
        }
        // On a face, or one of the floats beside it, or within a voxel.
        const auto face = static_cast<float>(0.03 * (corner + static_cast<int>(random_() % 130)));
        const std::array choices{
            face, std::nextafter(face, 1e9F), std::nextafter(face, -1e9F), face + 0.017F};
        along.push_back(choices[random_() % 40 < 3 ? random_() % 3 : 3]);
      }
    }
    std::vector<std::uint32_t> cells(kSize);
    std::vector<std::uint64_t> bits(kSize / kBlock);
    static_cast<void>(set().find_cells(grid,
                                       {points[0].data(), points[1].data(), points[2].data()},
                                       kSize,
                                       cells.data(),
                                       {bits.data(), bits.data(), bits.data()}));
    for (std::size_t i = 0; i < kSize; ++i) {
      ASSERT_EQ(cells[i], cell_by_definition(grid, {points[0][i], points[1][i], points[2][i]}))
          << corner << ", point " << i;
    }
  }
}

TEST_P(KernelsOfEverySet, FindsTheSameCells) {
  CellGrid grid{.voxels_per_m = 1.0 / 0.05,
                .corner = {-80, -72, -64},
                .first = {8, 0, 0},
                .end = {160, 136, 128},
                .stride = {17 * 16, 16},
                .sensor = {0.1F, 0.2F, -0.3F},
                .max_squared = 9.0F,
                .outer_max_squared = 9.3F};
  std::uniform_real_distribution<float> coordinate(-4.5F, 4.5F);
  for (const std::size_t size : {64U, 128U, 640U}) {
    std::vector<float> x(size);
    std::vector<float> y(size);
    std::vector<float> z(size);
    for (std::size_t i = 0; i < size; ++i) {
      if (i > 0 && random_() % 3 != 0) {  // runs of neighbours
        x[i] = x[i - 1];
        y[i] = y[i - 1];
        z[i] = z[i - 1];
        continue;
      }
      x[i] = coordinate(random_);
      y[i] = coordinate(random_);
      z[i] = coordinate(random_);
      if (random_() % 8 == 0) x[i] = kNan;
      if (random_() % 8 == 0) y[i] = 1e25F;
      if (random_() % 8 == 0) z[i] = std::round(z[i] * 20.0F) / 20.0F;  // on a face
    }
    const auto found = [&](const Kernels& kernels, float outer_max_squared) {
      grid.outer_max_squared = outer_max_squared;
      std::vector<std::uint32_t> cells(size);
      std::vector<std::uint64_t> bits(3 * size / kBlock);
      const CellCounts counts =
          kernels.find_cells(grid,
                             {x.data(), y.data(), z.data()},
                             size,
                             cells.data(),
                             {bits.data(), &bits[size / kBlock], &bits[2 * size / kBlock]});
      for (const std::uint64_t word : bits) {
        cells.push_back(static_cast<std::uint32_t>(word));
        cells.push_back(static_cast<std::uint32_t>(word >> 32U));
      }
      cells.push_back(static_cast<std::uint32_t>(counts.num_with_cell));
      cells.push_back(static_cast<std::uint32_t>(counts.num_within_range));
      return cells;
    };
    for (const float outer : {9.3F, std::numeric_limits<float>::max()}) {
      const auto cells = found(set(), outer);
      EXPECT_EQ(cells, found(scalar_, outer));
      EXPECT_GT(cells.back(), 0U);
    }
  }
}

TEST_P(KernelsOfEverySet, SeesTheSameCorners) {
  std::vector<float> picture = depths(64UL * 48UL, random_);
  for (float& depth_m : picture) {
    if (!(depth_m > 0.0F && depth_m < 100.0F)) depth_m = 0.0F;
  }
  CornerProjection projection{.depth_m = picture.data(),
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
      set().see_corners(projection, first, check_range, ours.data());
      scalar_.see_corners(projection, first, check_range, theirs.data());
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
