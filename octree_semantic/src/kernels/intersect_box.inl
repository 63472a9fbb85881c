// SPDX-License-Identifier: BSD-3-Clause
// Intersection of occlusion rays with a box.
#if defined(HYPERMAP_INTERSECT_BOX_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HYPERMAP_INTERSECT_BOX_INL
#undef HYPERMAP_INTERSECT_BOX_INL
#else
#define HYPERMAP_INTERSECT_BOX_INL
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

/// The rays of one vector: slab test over the three axes.
template <class D>
HWY_INLINE std::uint64_t intersect_lanes(const RayPacket& rays,
                                    const BoxFaces& box,
                                    const std::int32_t* valid,
                                    std::size_t lane) {
  const D d;
  const hn::RebindToSigned<D> di;
  auto first = hn::Zero(d);
  auto last = hn::Load(d, rays.end + lane);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto origin = hn::Load(d, rays.origin[axis] + lane);
    const auto inverse = hn::Load(d, rays.inverse[axis] + lane);
    const auto to_low = hn::Mul(hn::Sub(hn::Set(d, box.low[axis]), origin), inverse);
    const auto to_high = hn::Mul(hn::Sub(hn::Set(d, box.high[axis]), origin), inverse);
    first = hn::Max(first, hn::Min(to_low, to_high));
    last = hn::Min(last, hn::Max(to_low, to_high));
  }
  const auto active = hn::Ne(hn::LoadU(di, valid + lane), hn::Zero(di));
  return bits_of(d, hn::And(hn::RebindMask(d, active), hn::Le(first, last)));
}

template <class D>
HWY_INLINE std::uint32_t intersect_with(const RayPacket& rays,
                                   const BoxFaces& box,
                                   const std::int32_t* valid,
                                   std::size_t num_lanes) {
  std::uint64_t hits = 0;
  for (std::size_t lane = 0; lane < num_lanes; lane += hn::Lanes(D())) {
    hits |= intersect_lanes<D>(rays, box, valid, lane) << lane;
  }
  return static_cast<std::uint32_t>(hits);
}

inline std::uint32_t intersect_box(const RayPacket& rays,
                              const BoxFaces& box,
                              const std::int32_t* valid,
                              std::size_t num_lanes) {
  if (num_lanes == 16) return intersect_with<hn::CappedTag<float, 16>>(rays, box, valid, 16);
  if (num_lanes == 8) return intersect_with<hn::CappedTag<float, 8>>(rays, box, valid, 8);
  return intersect_with<hn::CappedTag<float, 4>>(rays, box, valid, 4);
}

}  // namespace HWY_NAMESPACE
}  // namespace hypermap::kernels
HWY_AFTER_NAMESPACE();

#endif
