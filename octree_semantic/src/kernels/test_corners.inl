// SPDX-License-Identifier: BSD-3-Clause
// Visibility test of the corners of a brick's voxels.
#if defined(HYPERMAP_TEST_CORNERS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HYPERMAP_TEST_CORNERS_INL
#undef HYPERMAP_TEST_CORNERS_INL
#else
#define HYPERMAP_TEST_CORNERS_INL
#endif

#include "kernels/kernels.hpp"
#include "kernels/mask_bits.inl"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace hypermap::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using CornerFloats = hn::CappedTag<float, 16>;

/// One vector of corners from corner `i` on, as bits.
template <bool kCheckRange>
HWY_INLINE std::uint64_t test_lanes(const CornerProjection& projection,
                                   const float* first,
                                   std::size_t i) {
  const CornerFloats d;
  const hn::Rebind<std::int32_t, CornerFloats> di;
  const auto x = hn::Add(hn::Set(d, first[0]), hn::Load(d, projection.x + i));
  const auto y = hn::Add(hn::Set(d, first[1]), hn::Load(d, projection.y + i));
  const auto z = hn::Add(hn::Set(d, first[2]), hn::Load(d, projection.z + i));
  const auto zero = hn::Zero(d);
  const auto per_z = hn::Div(hn::Set(d, 1.0F), z);
  const auto u = hn::Add(hn::Mul(x, per_z), hn::Set(d, projection.u0));
  const auto v = hn::Add(hn::Mul(y, per_z), hn::Set(d, projection.v0));
  const auto in_columns = hn::And(hn::Ge(u, zero), hn::Lt(u, hn::Set(d, projection.width)));
  const auto in_rows = hn::And(hn::Ge(v, zero), hn::Lt(v, hn::Set(d, projection.height)));
  auto visible = hn::And(hn::Gt(z, zero), hn::And(in_columns, in_rows));
  if constexpr (kCheckRange) {
    const auto metric_x = hn::Mul(x, hn::Set(d, projection.per_fx));
    const auto metric_y = hn::Mul(y, hn::Set(d, projection.per_fy));
    const auto squared =
        hn::Add(hn::Add(hn::Mul(metric_x, metric_x), hn::Mul(metric_y, metric_y)), hn::Mul(z, z));
    visible = hn::And(visible, hn::Le(squared, hn::Set(d, projection.max_squared_m2)));
  }
  if (hn::AllFalse(d, visible)) return 0;
  const auto column = hn::ConvertTo(di, hn::IfThenElseZero(visible, u));
  const auto row = hn::ConvertTo(di, hn::IfThenElseZero(visible, v));
  const auto pixel = hn::Add(hn::Mul(row, hn::Set(di, projection.width_px)), column);
  const auto depth_m = hn::GatherIndex(d, projection.depth_m, pixel);
  return bits_of(d, hn::And(visible, hn::Lt(z, depth_m)));
}

template <bool kCheckRange>
HWY_INLINE void test_brick(const CornerProjection& projection,
                          const float* first,
                          std::uint64_t* visible) {
  const std::size_t lanes = hn::Lanes(CornerFloats());
  for (std::size_t word = 0; word < 8; ++word) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < 64; i += lanes) {
      bits |= test_lanes<kCheckRange>(projection, first, word * 64 + i) << i;
    }
    visible[word] = bits;
  }
}

inline void test_corners(const CornerProjection& projection,
                        const float* first,
                        bool check_range,
                        std::uint64_t* visible) {
  if (check_range) {
    test_brick<true>(projection, first, visible);
  } else {
    test_brick<false>(projection, first, visible);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace hypermap::kernels
HWY_AFTER_NAMESPACE();

#endif
