// SPDX-License-Identifier: BSD-3-Clause
#include "brick_merge.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace hypermap {
namespace {

constexpr std::size_t kLanes = 8;
using Lanes = std::array<MilliLogOdds, kLanes>;

/// For each byte of bits: all ones in the lanes whose bit is set.
constexpr std::array<Lanes, 256> make_lane_masks() {
  std::array<Lanes, 256> masks{};
  for (std::size_t byte = 0; byte < masks.size(); ++byte) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      masks[byte][lane] = ((byte >> lane) & 1U) != 0 ? MilliLogOdds{-1} : MilliLogOdds{0};
    }
  }
  return masks;
}
constexpr std::array<Lanes, 256> kLaneMasks = make_lane_masks();

/// Updates eight voxels and returns a bit for each that is at or above the threshold. The loops are
/// of fixed length, without branches, and become vector instructions.
std::uint64_t add_to_lanes(MilliLogOdds* log_odds,
                           std::uint64_t hit_byte,
                           std::uint64_t passed_byte,
                           const SensorModel& model) noexcept {
  const Lanes& hit = kLaneMasks[hit_byte];
  const Lanes& passed = kLaneMasks[passed_byte];
  for (std::size_t i = 0; i < kLanes; ++i) {
    const int evidence = (hit[i] & model.hit) | (passed[i] & model.miss);
    const auto sum = static_cast<MilliLogOdds>(log_odds[i] + evidence);
    log_odds[i] = std::min(std::max(sum, model.clamp_min), model.clamp_max);
  }
  std::uint64_t occupied = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    occupied |= static_cast<std::uint64_t>(log_odds[i] >= model.occupied_from ? 1U : 0U) << i;
  }
  return occupied;
}

}  // namespace

bool add_evidence(const BrickOccupancy& brick,
                  const std::uint64_t* hit,
                  const std::uint64_t* passed,
                  const SensorModel& model) noexcept {
  std::uint64_t changed = 0;
  for (std::size_t word = 0; word < 8; ++word) {
    const std::uint64_t only_passed = passed[word] & ~hit[word];
    const std::uint64_t seen = hit[word] | only_passed;
    if (seen == 0) continue;
    std::uint64_t occupied = 0;
    for (std::size_t shift = 0; shift < 64; shift += kLanes) {
      const std::uint64_t hit_byte = (hit[word] >> shift) & 0xFFU;
      const std::uint64_t passed_byte = (only_passed >> shift) & 0xFFU;
      if ((hit_byte | passed_byte) == 0) continue;
      MilliLogOdds* lanes = brick.log_odds + word * 64 + shift;
      occupied |= add_to_lanes(lanes, hit_byte, passed_byte, model) << shift;
    }
    brick.known[word] |= seen;
    // Voxels that the frame did not see keep their bit.
    const std::uint64_t now = (brick.occupied[word] & ~seen) | (occupied & seen);
    changed |= now ^ brick.occupied[word];
    brick.occupied[word] = now;
  }
  return changed != 0;
}

}  // namespace hypermap
