// SPDX-License-Identifier: BSD-3-Clause
// Every instruction set of this processor against the scalar code, bit for bit.
#include "kernels/kernels.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

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

/// The kernels of each set that this processor and compiler have.
std::vector<Kernels> all_sets() {
  std::vector<Kernels> sets;
  for (std::int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) {
    hwy::SetSupportedTargetsForTest(rest & -rest);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    const Kernels& set = best_kernels();
    const bool is_new = std::none_of(sets.begin(), sets.end(), [&](const Kernels& other) {
      return std::strcmp(other.name, set.name) == 0;
    });
    if (is_new) sets.push_back(set);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  return sets;
}

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

class EverySet : public ::testing::TestWithParam<Kernels> {
 protected:
  [[nodiscard]] const Kernels& set() const { return GetParam(); }
  const Kernels& scalar_ = scalar_kernels();
  std::mt19937 random_{11};
};
INSTANTIATE_TEST_SUITE_P(OfThisProcessor,
                         EverySet,
                         ::testing::ValuesIn(all_sets()),
                         [](const auto& set_info) { return std::string(set_info.param.name); });

constexpr std::size_t kSizes[] = {1, 2, 3, 7, 8, 15, 16, 17, 63, 64, 65, 320, 639, 640, 641};

TEST_P(EverySet, UnprojectsRowsToTheSameBits) {
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

TEST_P(EverySet, SummarisesRowsToTheSameBits) {
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

TEST_P(EverySet, FindsTheCellsOfTheDefinitionOnFacesAndFarFromTheOriginToo) {
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

TEST_P(EverySet, FindsTheSameCells) {
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

TEST_P(EverySet, SeesTheSameCorners) {
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

TEST_P(EverySet, MergesBricksToTheSameBits) {
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

TEST_P(EverySet, MarchesThroughTheVoxelsOfAWalkStepByStep) {
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

SightPacket some_sight_lines(std::mt19937& random) {
  std::uniform_real_distribution<float> within(-20.0F, 20.0F);
  SightPacket lines;
  for (std::size_t lane = 0; lane < kSightLanes; ++lane) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lines.origin[axis][lane] = within(random);
      // Now and then along an axis, and on a face.
      const float direction = random() % 5 == 0 ? 0.0F : within(random);
      lines.direction[axis][lane] = direction;
      lines.inverse[axis][lane] = direction == 0.0F ? 1e30F : 1.0F / direction;
      if (random() % 5 == 0) lines.origin[axis][lane] = std::round(lines.origin[axis][lane]);
    }
    lines.end[lane] = std::abs(within(random)) / 20.0F;
  }
  return lines;
}

/// By the definition: is some of the way between all pairs of faces?
bool meets(const SightPacket& lines, std::size_t lane, const BoxFaces& box) {
  float first = 0.0F;
  float last = lines.end[lane];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float low = (box.low[axis] - lines.origin[axis][lane]) * lines.inverse[axis][lane];
    const float high = (box.high[axis] - lines.origin[axis][lane]) * lines.inverse[axis][lane];
    first = std::max(first, std::min(low, high));
    last = std::min(last, std::max(low, high));
  }
  return first <= last;
}

TEST_P(EverySet, FindsTheLinesThatMeetABox) {
  int num_meeting = 0;
  for (int round = 0; round < 500; ++round) {
    const SightPacket lines = some_sight_lines(random_);
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
        if (valid[lane] != 0 && meets(lines, lane, box)) expected |= 1U << lane;
      }
      EXPECT_EQ(set().meet_box(lines, box, valid.data(), num_lanes), expected);
      num_meeting += std::popcount(expected);
    }
  }
  EXPECT_GT(num_meeting, 200);
}

TEST(Kernels, ALineMeetsABoxOnItsWayAndNotBehindItsEnd) {
  // From (0, 2.5, 2.5) along x to a box from x = 4 to 6.
  SightPacket lines;
  for (std::size_t lane = 0; lane < 4; ++lane) {
    lines.direction[0][lane] = 1.0F;
    lines.inverse[0][lane] = 1.0F;
    for (std::size_t axis = 1; axis < 3; ++axis) {
      lines.origin[axis][lane] = 2.5F;
      lines.inverse[axis][lane] = 1e30F;
    }
    lines.end[lane] = 10.0F;
  }
  lines.end[1] = 3.9F;            // ends before it
  lines.origin[1][2] = 3.5F;      // passes beside it
  lines.direction[0][3] = -1.0F;  // goes away from it
  lines.inverse[0][3] = -1.0F;
  const BoxFaces box{{4, 2, 2}, {6, 3, 3}};
  const std::array<std::int32_t, 4> all{-1, -1, -1, -1};
  EXPECT_EQ(best_kernels().meet_box(lines, box, all.data(), 4), 0b0001U);
  const std::array<std::int32_t, 4> not_the_first{0, -1, -1, -1};
  EXPECT_EQ(best_kernels().meet_box(lines, box, not_the_first.data(), 4), 0U);
}

TEST(Kernels, ARayStepsFromBrickToBrickAndLeavesItsLastVoxelOut) {
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
