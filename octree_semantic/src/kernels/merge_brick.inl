// SPDX-License-Identifier: BSD-3-Clause
// Adds one frame's evidence to the occupancy of a brick.
#if defined(HYPERMAP_MERGE_BRICK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HYPERMAP_MERGE_BRICK_INL
#undef HYPERMAP_MERGE_BRICK_INL
#else
#define HYPERMAP_MERGE_BRICK_INL
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

using LogOddsLanes = hn::CappedTag<std::int16_t, 32>;

/// Updates the voxels of one vector and returns a bit for each that is occupied now.
HWY_INLINE std::uint64_t merge_lanes(std::int16_t* log_odds,
                                     std::uint64_t hit,
                                     std::uint64_t passed,
                                     const EvidenceSteps& steps) {
  const LogOddsLanes d;
  const auto added = hn::IfThenElse(mask_of(d, hit),
                                    hn::Set(d, steps.hit),
                                    hn::IfThenElseZero(mask_of(d, passed), hn::Set(d, steps.miss)));
  const auto sum = hn::SaturatedAdd(hn::Load(d, log_odds), added);
  const auto clamped =
      hn::Min(hn::Max(sum, hn::Set(d, steps.clamp_min)), hn::Set(d, steps.clamp_max));
  hn::Store(clamped, d, log_odds);
  return bits_of(d, hn::Not(hn::Lt(clamped, hn::Set(d, steps.occupied_from))));
}

inline MergeCounts merge_brick(const BrickArrays& brick,
                               const std::uint64_t* hit,
                               const std::uint64_t* passed,
                               const EvidenceSteps& steps) {
  const std::size_t lanes = hn::Lanes(LogOddsLanes());
  const std::uint64_t some = lanes == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << lanes) - 1;
  MergeCounts counts;
  std::uint64_t changed = 0;
  for (std::size_t word = 0; word < 8; ++word) {
    const std::uint64_t seen = hit[word] | passed[word];
    if (seen == 0) continue;
    std::uint64_t occupied = 0;
    for (std::size_t i = 0; i < 64; i += lanes) {
      if (((seen >> i) & some) == 0) continue;
      occupied |=
          merge_lanes(brick.log_odds + word * 64 + i, hit[word] >> i, passed[word] >> i, steps)
          << i;
    }
    brick.known[word] |= seen;
    // Voxels that the frame did not see keep their bit.
    const std::uint64_t now = (brick.occupied[word] & ~seen) | (occupied & seen);
    changed |= now ^ brick.occupied[word];
    brick.occupied[word] = now;
    counts.num_hit += hwy::PopCount(hit[word]);
    counts.num_passed += hwy::PopCount(seen & ~hit[word]);
  }
  counts.changed = changed != 0;
  return counts;
}

}  // namespace HWY_NAMESPACE
}  // namespace hypermap::kernels
HWY_AFTER_NAMESPACE();

#endif
