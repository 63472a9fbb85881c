// SPDX-License-Identifier: BSD-3-Clause
// From points to the cells of a window.
#if defined(HYPERMAP_FIND_CELLS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HYPERMAP_FIND_CELLS_INL
#undef HYPERMAP_FIND_CELLS_INL
#else
#define HYPERMAP_FIND_CELLS_INL
#endif

#include "kernels/kernels.hpp"
#include "kernels/mask_bits.inl"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace hypermap::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr float kLargestSquare = std::numeric_limits<float>::max();

using CellDoubles = hn::CappedTag<double, 8>;
using CellFloats = hn::Rebind<float, CellDoubles>;
using CellInts = hn::Rebind<std::int32_t, CellDoubles>;
using CellWords = hn::Rebind<std::uint32_t, CellDoubles>;

/// Voxels from the window's corner along one axis.
template <class V>
HWY_INLINE auto offset_along(const CellGrid& grid, std::size_t axis, V point) {
  const CellDoubles d;
  const auto voxels = hn::Mul(hn::Set(d, grid.voxels_per_m), hn::PromoteTo(d, point));
  return hn::DemoteTo(CellInts(), hn::Sub(hn::Floor(voxels), hn::Set(d, grid.corner[axis])));
}

template <class V>
HWY_INLINE auto is_inside(const CellGrid& grid, std::size_t axis, V offset) {
  const CellInts d;
  return hn::AndNot(hn::Lt(offset, hn::Set(d, grid.first[axis])),
                    hn::Lt(offset, hn::Set(d, grid.end[axis])));
}

/// Bits 0, 1, 2 of an offset to bits 0, 3, 6.
template <class V>
HWY_INLINE auto spread_in_brick(V offset) {
  const CellInts d;
  const auto low = hn::And(offset, hn::Set(d, 1));
  const auto middle = hn::ShiftLeft<2>(hn::And(offset, hn::Set(d, 2)));
  const auto high = hn::ShiftLeft<4>(hn::And(offset, hn::Set(d, 4)));
  return hn::Or(low, hn::Or(middle, high));
}

template <class V>
HWY_INLINE auto cell_at(const CellGrid& grid, V x, V y, V z) {
  const CellInts d;
  const auto brick_x = hn::Mul(hn::ShiftRight<3>(x), hn::Set(d, grid.stride[0]));
  const auto brick_y = hn::Mul(hn::ShiftRight<3>(y), hn::Set(d, grid.stride[1]));
  const auto brick = hn::Add(hn::Add(brick_x, brick_y), hn::ShiftRight<3>(z));
  const auto in_brick =
      hn::Or(spread_in_brick(x),
             hn::Or(hn::ShiftLeft<1>(spread_in_brick(y)), hn::ShiftLeft<2>(spread_in_brick(z))));
  return hn::BitCast(CellWords(), hn::Or(hn::ShiftLeft<9>(brick), in_brick));
}

/// Bits of some lanes.
struct LaneBits {
  std::uint64_t far = 0;
  std::uint64_t lost = 0;
};

/// One vector of points from point `i` on.
HWY_INLINE LaneBits find_lanes(const CellGrid& grid,
                               const PointRow& points,
                               std::size_t i,
                               std::uint32_t* cells,
                               CellCounts& counts) {
  const CellFloats df;
  const CellInts di;
  const CellWords dw;
  const auto sensor_x = hn::Set(df, grid.sensor[0]);
  const auto sensor_y = hn::Set(df, grid.sensor[1]);
  const auto sensor_z = hn::Set(df, grid.sensor[2]);
  const auto x = hn::LoadU(df, points.x + i);
  const auto y = hn::LoadU(df, points.y + i);
  const auto z = hn::LoadU(df, points.z + i);
  const auto to_x = hn::Sub(x, sensor_x);
  const auto to_y = hn::Sub(y, sensor_y);
  const auto to_z = hn::Sub(z, sensor_z);
  const auto squared =
      hn::Add(hn::Add(hn::Mul(to_x, to_x), hn::Mul(to_y, to_y)), hn::Mul(to_z, to_z));
  const auto near = hn::Le(squared, hn::Set(df, grid.outer_max_squared));
  // Far points are replaced by the sensor: every number below is a small one.
  const auto offset_x = offset_along(grid, 0, hn::IfThenElse(near, x, sensor_x));
  const auto offset_y = offset_along(grid, 1, hn::IfThenElse(near, y, sensor_y));
  const auto offset_z = offset_along(grid, 2, hn::IfThenElse(near, z, sensor_z));
  const auto inside = hn::And(is_inside(grid, 0, offset_x),
                              hn::And(is_inside(grid, 1, offset_y), is_inside(grid, 2, offset_z)));
  const auto has_cell = hn::And(hn::RebindMask(di, near), inside);
  const auto cell = cell_at(grid,
                            hn::IfThenElseZero(has_cell, offset_x),
                            hn::IfThenElseZero(has_cell, offset_y),
                            hn::IfThenElseZero(has_cell, offset_z));
  hn::StoreU(
      hn::IfThenElse(hn::RebindMask(dw, has_cell), cell, hn::Set(dw, kNoVoxel)), dw, cells + i);

  const auto within = hn::Le(squared, hn::Set(df, grid.max_squared));
  counts.num_with_cell += hn::CountTrue(di, has_cell);
  counts.num_within_range += hn::CountTrue(di, hn::And(hn::RebindMask(di, within), has_cell));
  const auto measured = hn::Eq(x, x);
  const auto finite = hn::Le(squared, hn::Set(df, kLargestSquare));
  const std::uint64_t measured_bits = bits_of(df, measured);
  const std::uint64_t far_bits = measured_bits & bits_of(df, finite) & ~bits_of(df, near);
  return {far_bits, measured_bits & ~far_bits & ~bits_of(di, has_cell)};
}

/// Where a cell differs from the one before it and is one.
inline void find_starts(const std::uint32_t* cells, std::size_t size, std::uint64_t* starts) {
  const CellWords d;
  const std::size_t lanes = hn::Lanes(d);
  const auto none = hn::Set(d, kNoVoxel);
  // The first lanes have nothing before them.
  std::uint32_t shifted[8] = {kNoVoxel};
  for (std::size_t i = 1; i < lanes; ++i) shifted[i] = cells[i - 1];
  for (std::size_t block = 0; block < size; block += kBlock) {
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < kBlock; i += lanes) {
      const std::size_t at = block + i;
      const auto cell = hn::LoadU(d, cells + at);
      const auto before = hn::LoadU(d, at == 0 ? shifted : cells + at - 1);
      const auto starts_here = hn::AndNot(hn::Eq(cell, before), hn::Ne(cell, none));
      word |= bits_of(d, starts_here) << i;
    }
    starts[block / kBlock] = word;
  }
}

inline CellCounts find_cells(const CellGrid& grid,
                             const PointRow& points,
                             std::size_t size,
                             std::uint32_t* cells,
                             const CellBits& bits) {
  const std::size_t lanes = hn::Lanes(CellFloats());
  CellCounts counts;
  for (std::size_t block = 0; block < size; block += kBlock) {
    std::uint64_t far = 0;
    std::uint64_t lost = 0;
    for (std::size_t i = 0; i < kBlock; i += lanes) {
      const LaneBits found = find_lanes(grid, points, block + i, cells, counts);
      far |= found.far << i;
      lost |= found.lost << i;
    }
    bits.far[block / kBlock] = far;
    bits.lost[block / kBlock] = lost;
  }
  find_starts(cells, size, bits.starts);
  return counts;
}

}  // namespace HWY_NAMESPACE
}  // namespace hypermap::kernels
HWY_AFTER_NAMESPACE();

#endif
