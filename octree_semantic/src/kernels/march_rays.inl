// SPDX-License-Identifier: BSD-3-Clause
// Walks rays from voxel to voxel, one in each lane.
#if defined(HYPERMAP_MARCH_RAYS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HYPERMAP_MARCH_RAYS_INL
#undef HYPERMAP_MARCH_RAYS_INL
#else
#define HYPERMAP_MARCH_RAYS_INL
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

using DistanceLanes = hn::CappedTag<double, 8>;
using CellLanes = hn::RebindToSigned<DistanceLanes>;

/// The rays that are under way, by lanes.
struct RayLanes {
  static constexpr std::size_t kMax = hn::MaxLanes(DistanceLanes());
  HWY_ALIGN double next[3][kMax];
  HWY_ALIGN double per_voxel[3][kMax];
  HWY_ALIGN double limit[kMax];
  HWY_ALIGN std::int64_t place[3][kMax];
  HWY_ALIGN std::int64_t step[3][kMax];
  HWY_ALIGN std::int64_t behind[3][kMax];
  HWY_ALIGN std::int64_t brick_step[3][kMax];
  HWY_ALIGN std::int64_t brick[kMax];
  HWY_ALIGN std::int64_t cell[kMax];
  HWY_ALIGN std::int64_t last_cell[kMax];

  void start(std::size_t lane, const MarchedRay& ray) {
    for (std::size_t i = 0; i < 3; ++i) {
      next[i][lane] = ray.next[i];
      per_voxel[i][lane] = ray.per_voxel[i];
      place[i][lane] = ray.place[i];
      step[i][lane] = ray.step[i];
      behind[i][lane] = ray.behind[i];
      brick_step[i][lane] = ray.brick_step[i];
    }
    limit[lane] = ray.limit;
    brick[lane] = ray.brick;
    cell[lane] = ray.brick + (ray.place[0] | ray.place[1] | ray.place[2]);
    last_cell[lane] = ray.last_cell;
  }
  /// Stays where the ray begins, which is marked anyway, and never ends.
  void park(std::size_t lane, const MarchedRay& ray) {
    start(lane, ray);
    for (std::size_t i = 0; i < 3; ++i) {
      next[i][lane] = 0.0;
      per_voxel[i][lane] = 0.0;
      step[i][lane] = 0;
      brick_step[i][lane] = 0;
    }
    limit[lane] = std::numeric_limits<double>::max();
    last_cell[lane] = -1;
  }
};

/// Which rays a lane takes: neighbours follow each other in one lane, for those side by side would
/// write to the same words, and one would wait for the other.
struct LaneQueue {
  std::size_t next;
  std::size_t end;
};

/// One axis of all lanes.
template <class Distances, class Cells>
struct AxisWalk {
  Distances next;
  Distances per_voxel;
  Cells place;
  Cells step;
  Cells behind;
  Cells brick_step;

  AxisWalk(const RayLanes& lanes, std::size_t axis)
      : next(hn::Load(DistanceLanes(), lanes.next[axis])),
        per_voxel(hn::Load(DistanceLanes(), lanes.per_voxel[axis])),
        place(hn::Load(CellLanes(), lanes.place[axis])),
        step(hn::Load(CellLanes(), lanes.step[axis])),
        behind(hn::Load(CellLanes(), lanes.behind[axis])),
        brick_step(hn::Load(CellLanes(), lanes.brick_step[axis])) {}

  /// Steps the lanes of `along`. Returns by how much their bricks' first cells change.
  template <class Mask>
  HWY_INLINE Cells advance(Mask along, Cells axis_bits) {
    next = hn::Add(next, hn::IfThenElseZero(along, per_voxel));
    const auto along_cells = hn::RebindMask(CellLanes(), along);
    // Bits of the other axes are no part of the number: carries run over them.
    place = hn::And(hn::Add(place, hn::IfThenElseZero(along_cells, step)), axis_bits);
    const auto left_brick = hn::And(along_cells, hn::Eq(place, behind));
    return hn::IfThenElseZero(left_brick, brick_step);
  }
  void store(RayLanes& lanes, std::size_t axis) const {
    hn::Store(next, DistanceLanes(), lanes.next[axis]);
    hn::Store(place, CellLanes(), lanes.place[axis]);
  }
};

/// Marks and steps until a ray ends. Returns a bit for each lane whose ray has ended.
inline std::uint64_t march_until_one_ends(RayLanes& lanes, const CellMarks& marks) {
  const DistanceLanes d;
  const CellLanes c;
  using Axis = AxisWalk<decltype(hn::Zero(d)), decltype(hn::Zero(c))>;
  Axis x(lanes, 0);
  Axis y(lanes, 1);
  Axis z(lanes, 2);
  const auto x_bits = hn::Set(c, kAxisBits);
  const auto y_bits = hn::Set(c, kAxisBits << 1);
  const auto z_bits = hn::Set(c, kAxisBits << 2);
  const auto limit = hn::Load(d, lanes.limit);
  const auto last_cell = hn::Load(c, lanes.last_cell);
  auto brick = hn::Load(c, lanes.brick);
  // Of its own: nothing that is marked could change it.
  std::uint64_t* const words = marks.words;
  std::uint8_t* const touched = marks.touched;
  for (;;) {
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
      const auto cell = static_cast<std::uint64_t>(lanes.cell[lane]);
      words[cell >> 6U] |= std::uint64_t{1} << (cell & 63U);
      touched[cell >> 9U] = 1;
    }
    const auto x_before_y = hn::Lt(x.next, y.next);
    const auto along_x = hn::And(x_before_y, hn::Lt(x.next, z.next));
    const auto along_y = hn::AndNot(x_before_y, hn::Lt(y.next, z.next));
    const auto along_z = hn::Not(hn::Or(along_x, along_y));
    brick = hn::Add(brick, x.advance(along_x, x_bits));
    brick = hn::Add(brick, y.advance(along_y, y_bits));
    brick = hn::Add(brick, z.advance(along_z, z_bits));
    const auto cell = hn::Add(brick, hn::Or(hn::Or(x.place, y.place), z.place));
    hn::Store(cell, c, lanes.cell);
    const auto is_beyond = hn::Gt(hn::Min(hn::Min(x.next, y.next), z.next), limit);
    const auto has_ended = hn::Or(hn::RebindMask(d, hn::Eq(cell, last_cell)), is_beyond);
    if (hn::AllFalse(d, has_ended)) continue;
    x.store(lanes, 0);
    y.store(lanes, 1);
    z.store(lanes, 2);
    hn::Store(brick, c, lanes.brick);
    return bits_of(d, has_ended);
  }
}

inline void march_rays(const MarchedRay* rays, std::size_t size, const CellMarks& marks) {
  if (size == 0) return;
  const std::size_t num_lanes = hn::Lanes(DistanceLanes());
  RayLanes lanes;
  LaneQueue queues[RayLanes::kMax];
  std::size_t num_under_way = 0;
  const auto take_next = [&](std::size_t lane) {
    LaneQueue& queue = queues[lane];
    if (queue.next == queue.end) return lanes.park(lane, rays[0]);
    lanes.start(lane, rays[queue.next++]);
    ++num_under_way;
  };
  for (std::size_t lane = 0; lane < num_lanes; ++lane) {
    queues[lane] = {lane * size / num_lanes, (lane + 1) * size / num_lanes};
    take_next(lane);
  }
  while (num_under_way != 0) {
    const std::uint64_t ended = march_until_one_ends(lanes, marks);
    for (std::size_t lane = 0; lane < num_lanes; ++lane) {
      if (((ended >> lane) & 1U) == 0) continue;
      --num_under_way;
      take_next(lane);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace hypermap::kernels
HWY_AFTER_NAMESPACE();

#endif
