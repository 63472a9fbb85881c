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

using CellFloats = hn::CappedTag<float, 16>;
using CellInts = hn::RebindToSigned<CellFloats>;
using CellWords = hn::RebindToUnsigned<CellFloats>;
using ExactDoubles = hn::CappedTag<double, 8>;
using ExactFloats = hn::Rebind<float, ExactDoubles>;
using ExactInts = hn::Rebind<std::int32_t, ExactDoubles>;

/// Voxels from the window's corner along one axis, by the definition: in double precision.
HWY_INLINE auto exact_offsets(const CellGrid& grid, std::size_t axis, hn::Vec<CellFloats> points) {
  const ExactDoubles d;
  alignas(64) float point[16];
  alignas(64) std::int32_t offset[16];
  hn::Store(points, CellFloats(), point);
  for (std::size_t i = 0; i < hn::Lanes(CellFloats()); i += hn::Lanes(d)) {
    const auto in_map = hn::PromoteTo(d, hn::Load(ExactFloats(), point + i));
    const auto voxels = hn::Floor(hn::Mul(hn::Set(d, grid.voxels_per_m), in_map));
    const auto from_corner = hn::Sub(voxels, hn::Set(d, grid.corner[axis]));
    hn::Store(hn::DemoteTo(ExactInts(), from_corner), ExactInts(), offset + i);
  }
  return hn::Load(CellInts(), offset);
}

struct QuickOffsets {
  hn::Vec<CellInts> offset;
  hn::Mask<CellFloats> certain;  ///< Where double precision cannot say otherwise.
};

/// The same in single precision. Two roundings of 2^-24 move a point by 1.2e-7 of its distance from
/// the map's origin: where no face lies within twice that, the voxel is the right one.
HWY_INLINE QuickOffsets quick_offsets(const CellGrid& grid,
                                      std::size_t axis,
                                      hn::Vec<CellFloats> points) {
  const CellFloats d;
  const auto voxels = hn::Mul(points, hn::Set(d, static_cast<float>(grid.voxels_per_m)));
  const auto floor = hn::Floor(voxels);
  const auto above_face = hn::Sub(voxels, floor);
  const auto below_face = hn::Sub(hn::Set(d, 1.0F), above_face);
  const auto error_bound = hn::Mul(hn::Abs(voxels), hn::Set(d, 2.5e-7F));
  const auto corner = hn::Set(CellInts(), static_cast<std::int32_t>(grid.corner[axis]));
  return {hn::Sub(hn::ConvertTo(CellInts(), floor), corner),
          hn::Gt(hn::Min(above_face, below_face), error_bound)};
}

HWY_INLINE auto is_inside(const CellGrid& grid, std::size_t axis, hn::Vec<CellInts> offset) {
  const CellInts d;
  return hn::AndNot(hn::Lt(offset, hn::Set(d, grid.first[axis])),
                    hn::Lt(offset, hn::Set(d, grid.end[axis])));
}

/// Bits 0, 1, 2 of an offset to bits 0, 3, 6.
HWY_INLINE auto spread_in_brick(hn::Vec<CellInts> offset) {
  const CellInts d;
  const auto low = hn::And(offset, hn::Set(d, 1));
  const auto middle = hn::ShiftLeft<2>(hn::And(offset, hn::Set(d, 2)));
  const auto high = hn::ShiftLeft<4>(hn::And(offset, hn::Set(d, 4)));
  return hn::Or(low, hn::Or(middle, high));
}

HWY_INLINE auto cell_at(const CellGrid& grid,
                        hn::Vec<CellInts> x,
                        hn::Vec<CellInts> y,
                        hn::Vec<CellInts> z) {
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
  const CellFloats d;
  const CellInts di;
  const CellWords dw;
  const auto sensor_x = hn::Set(d, grid.sensor[0]);
  const auto sensor_y = hn::Set(d, grid.sensor[1]);
  const auto sensor_z = hn::Set(d, grid.sensor[2]);
  const auto x = hn::LoadU(d, points.x + i);
  const auto y = hn::LoadU(d, points.y + i);
  const auto z = hn::LoadU(d, points.z + i);
  const auto to_x = hn::Sub(x, sensor_x);
  const auto to_y = hn::Sub(y, sensor_y);
  const auto to_z = hn::Sub(z, sensor_z);
  const auto squared =
      hn::Add(hn::Add(hn::Mul(to_x, to_x), hn::Mul(to_y, to_y)), hn::Mul(to_z, to_z));
  const auto near = hn::Le(squared, hn::Set(d, grid.outer_max_squared));
  // Far points are replaced by the sensor: every number below is a small one.
  const auto near_x = hn::IfThenElse(near, x, sensor_x);
  const auto near_y = hn::IfThenElse(near, y, sensor_y);
  const auto near_z = hn::IfThenElse(near, z, sensor_z);
  const QuickOffsets quick_x = quick_offsets(grid, 0, near_x);
  const QuickOffsets quick_y = quick_offsets(grid, 1, near_y);
  const QuickOffsets quick_z = quick_offsets(grid, 2, near_z);
  auto offset_x = quick_x.offset;
  auto offset_y = quick_y.offset;
  auto offset_z = quick_z.offset;
  const auto certain = hn::And(quick_x.certain, hn::And(quick_y.certain, quick_z.certain));
  if (!hn::AllFalse(d, hn::AndNot(certain, near))) {
    offset_x = exact_offsets(grid, 0, near_x);
    offset_y = exact_offsets(grid, 1, near_y);
    offset_z = exact_offsets(grid, 2, near_z);
  }
  const auto inside = hn::And(is_inside(grid, 0, offset_x),
                              hn::And(is_inside(grid, 1, offset_y), is_inside(grid, 2, offset_z)));
  const auto has_cell = hn::And(hn::RebindMask(di, near), inside);
  const auto cell = cell_at(grid,
                            hn::IfThenElseZero(has_cell, offset_x),
                            hn::IfThenElseZero(has_cell, offset_y),
                            hn::IfThenElseZero(has_cell, offset_z));
  hn::StoreU(
      hn::IfThenElse(hn::RebindMask(dw, has_cell), cell, hn::Set(dw, kNoVoxel)), dw, cells + i);

  const auto within = hn::Le(squared, hn::Set(d, grid.max_squared));
  counts.num_with_cell += hn::CountTrue(di, has_cell);
  counts.num_within_range += hn::CountTrue(di, hn::And(hn::RebindMask(di, within), has_cell));
  const auto measured = hn::Eq(x, x);
  const auto finite = hn::Le(squared, hn::Set(d, kLargestSquare));
  const std::uint64_t measured_bits = bits_of(d, measured);
  const std::uint64_t far_bits = measured_bits & bits_of(d, finite) & ~bits_of(d, near);
  return {far_bits, measured_bits & ~far_bits & ~bits_of(di, has_cell)};
}

/// Where a cell differs from the one before it and is one.
inline void find_starts(const std::uint32_t* cells, std::size_t size, std::uint64_t* starts) {
  const CellWords d;
  const std::size_t lanes = hn::Lanes(d);
  const auto none = hn::Set(d, kNoVoxel);
  // The first lanes have nothing before them.
  std::uint32_t shifted[16] = {kNoVoxel};
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
