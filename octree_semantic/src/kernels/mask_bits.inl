// SPDX-License-Identifier: BSD-3-Clause
// Masks of lanes as bits of a word.
#if defined(HYPERMAP_MASK_BITS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HYPERMAP_MASK_BITS_INL
#undef HYPERMAP_MASK_BITS_INL
#else
#define HYPERMAP_MASK_BITS_INL
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace hypermap::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The first lane's bit is the lowest. At most 32 lanes.
template <class D, class Mask>
HWY_INLINE std::uint64_t bits_of(D d, Mask mask) {
  static_assert(hn::MaxLanes(D()) <= 32);
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  const std::size_t lanes = hn::Lanes(d);
  if (lanes <= 8) return bytes[0] & ((1U << lanes) - 1U);
  if (lanes == 16) {
    std::uint16_t word = 0;
    std::memcpy(&word, bytes, sizeof(word));
    return word;
  }
  std::uint32_t word = 0;
  std::memcpy(&word, bytes, sizeof(word));
  return word;
}

/// Lanes whose bit is set, from the lowest on.
template <class D>
HWY_INLINE auto mask_of(D d, std::uint64_t bits) {
  std::uint8_t bytes[8];
  std::memcpy(bytes, &bits, sizeof(bytes));
  return hn::LoadMaskBits(d, bytes);
}

}  // namespace HWY_NAMESPACE
}  // namespace hypermap::kernels
HWY_AFTER_NAMESPACE();

#endif
