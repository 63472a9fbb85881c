// SPDX-License-Identifier: BSD-3-Clause
// Rows of a depth image: to points, and what is in them.
#if defined(HYPERMAP_DEPTH_ROWS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HYPERMAP_DEPTH_ROWS_INL
#undef HYPERMAP_DEPTH_ROWS_INL
#else
#define HYPERMAP_DEPTH_ROWS_INL
#endif

#include "kernels/kernels.hpp"

#include <hwy/highway.h>

#include <cstddef>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace hypermap::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr float kLargestDepth = std::numeric_limits<float>::max();
constexpr float kTooFar = 1e30F;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

using Doubles = hn::CappedTag<double, 8>;
using Floats = hn::Rebind<float, Doubles>;  // as many

/// A depth that is no infinity and no NaN.
template <class D, class V>
HWY_INLINE auto is_finite_depth(D d, V depth_m) {
  return hn::Le(hn::Abs(depth_m), hn::Set(d, kLargestDepth));
}

/// One coordinate of the points: (per_column * column + row) * depth + sensor.
template <class V>
HWY_INLINE auto coordinate(const RowRays& rays, std::size_t axis, V column, V depth_m) {
  const Doubles d;
  const auto along =
      hn::Add(hn::Mul(hn::Set(d, rays.per_column[axis]), column), hn::Set(d, rays.row[axis]));
  const auto point = hn::Add(hn::Mul(along, depth_m), hn::Set(d, rays.sensor[axis]));
  return hn::DemoteTo(Floats(), point);
}

/// The points of one vector of pixels that begins at pixel `u`.
HWY_INLINE RowCounts unproject_lanes(const RowRays& rays,
                                     std::size_t u,
                                     const float* depth_m,
                                     const PointRow& points) {
  const Doubles d;
  const Floats df;
  const auto depth = hn::LoadU(df, depth_m);
  const auto column = hn::Sub(hn::Iota(d, static_cast<double>(u)), hn::Set(d, rays.centre_column));
  const auto finite = is_finite_depth(df, depth);
  const auto positive = hn::Gt(depth, hn::Zero(df));
  const auto measured = hn::And(finite, positive);
  // Infinite depths are not computed with: they would only make NaNs of several kinds; nor those
  // that single precision may not hold when turned: their squares are infinite as it is.
  const auto clamped = hn::Min(hn::IfThenElseZero(finite, depth), hn::Set(df, kTooFar));
  const auto wide = hn::PromoteTo(d, hn::Max(clamped, hn::Set(df, -kTooFar)));
  const auto nan = hn::Set(df, kNan);
  hn::StoreU(hn::IfThenElse(measured, coordinate(rays, 0, column, wide), nan), df, points.x + u);
  hn::StoreU(coordinate(rays, 1, column, wide), df, points.y + u);
  hn::StoreU(coordinate(rays, 2, column, wide), df, points.z + u);
  const std::size_t num_finite = hn::CountTrue(df, finite);
  return {num_finite - hn::CountTrue(df, measured), hn::Lanes(df) - num_finite};
}

inline RowCounts unproject_row(const RowRays& rays,
                               const float* depth_m,
                               std::size_t size,
                               const PointRow& points) {
  const std::size_t lanes = hn::Lanes(Floats());
  RowCounts counts;
  const auto add = [&counts](const RowCounts& more) {
    counts.num_not_measured += more.num_not_measured;
    counts.num_not_finite += more.num_not_finite;
  };
  std::size_t u = 0;
  for (; u + lanes <= size; u += lanes) add(unproject_lanes(rays, u, depth_m + u, points));
  const std::size_t padded = (size + kBlock - 1) / kBlock * kBlock;
  for (; u < padded; u += lanes) {
    float rest[8] = {};
    const std::size_t num_rest = u < size ? size - u : 0;
    for (std::size_t i = 0; i < num_rest; ++i) rest[i] = depth_m[u + i];
    add(unproject_lanes(rays, u, rest, points));
    counts.num_not_measured -= lanes - num_rest;
  }
  return counts;
}

inline float farthest(const float* depth_m, std::size_t size) {
  const hn::CappedTag<float, 16> d;
  const std::size_t lanes = hn::Lanes(d);
  auto largest = hn::Zero(d);
  std::size_t i = 0;
  for (; i + lanes <= size; i += lanes) {
    const auto depth = hn::LoadU(d, depth_m + i);
    largest = hn::Max(largest, hn::IfThenElseZero(is_finite_depth(d, depth), depth));
  }
  float result = hn::GetLane(hn::MaxOfLanes(d, largest));
  for (; i < size; ++i) {
    if (depth_m[i] > result && depth_m[i] <= kLargestDepth) result = depth_m[i];
  }
  return result;
}

inline void summarise_row(const float* depth_m, std::size_t size, const ColumnSummary& summary) {
  const hn::CappedTag<float, 16> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t u = 0;
  for (; u + lanes <= size; u += lanes) {
    const auto depth = hn::LoadU(d, depth_m + u);
    const auto measured = hn::And(is_finite_depth(d, depth), hn::Gt(depth, hn::Zero(d)));
    const auto clean = hn::IfThenElseZero(measured, depth);
    hn::StoreU(clean, d, summary.clean + u);
    hn::StoreU(hn::Min(hn::LoadU(d, summary.min + u), clean), d, summary.min + u);
    hn::StoreU(hn::Max(hn::LoadU(d, summary.max + u), clean), d, summary.max + u);
    const auto one = hn::IfThenElseZero(measured, hn::Set(d, 1.0F));
    hn::StoreU(hn::Add(hn::LoadU(d, summary.num_measured + u), one), d, summary.num_measured + u);
  }
  for (; u < size; ++u) {
    const bool measured = depth_m[u] > 0.0F && depth_m[u] <= kLargestDepth;
    const float clean = measured ? depth_m[u] : 0.0F;
    summary.clean[u] = clean;
    summary.min[u] = clean < summary.min[u] ? clean : summary.min[u];
    summary.max[u] = clean > summary.max[u] ? clean : summary.max[u];
    summary.num_measured[u] += measured ? 1.0F : 0.0F;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace hypermap::kernels
HWY_AFTER_NAMESPACE();

#endif
