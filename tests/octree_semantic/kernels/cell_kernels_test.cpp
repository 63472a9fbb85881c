// SPDX-License-Identifier: BSD-3-Clause
// Which cells points lie in: every instruction set against the definition and the scalar code.
#include "kernels/kernels.hpp"
#include "octree_semantic/support/every_kernel_set.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace hypermap::kernels {
namespace {

class CellKernels : public EverySet {};
INSTANTIATE_TEST_SUITE_P(OfThisProcessor,
                         CellKernels,
                         ::testing::ValuesIn(all_sets()),
                         [](const auto& set_info) { return std::string(set_info.param.name); });

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

TEST_P(CellKernels, FindsTheCellsOfTheDefinitionOnFacesAndFarFromTheOriginToo) {
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

TEST_P(CellKernels, FindsTheSameCells) {
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
      if (random_() % 8 == 0) x[i] = std::numeric_limits<float>::quiet_NaN();
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

}  // namespace
}  // namespace hypermap::kernels
