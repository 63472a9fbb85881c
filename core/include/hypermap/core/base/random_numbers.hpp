// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Random numbers, the same on every machine: all that the libraries draw.
///
/// The standard library's distributions are avoided: their output is not specified.
#pragma once

#include <cstdint>
#include <utility>

namespace hypermap {

/// The golden ratio as a fraction of 2^64.
inline constexpr std::uint64_t kSplitMixIncrement = 0x9E3779B97F4A7C15U;

/// The finaliser of the splitmix64 generator: a bijection of 64-bit words that mixes every bit.
///
/// Source: G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators", 2014.
[[nodiscard]] constexpr std::uint64_t mix_bits(std::uint64_t x) noexcept {
  x += kSplitMixIncrement;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31U);
}

/// The value below which a standard normal variable falls with probability `p`.
///
/// Source: M. Wichura, "Algorithm AS 241: the percentage points of the normal distribution", 1988
/// (PPND16, relative accuracy 1e-16). Requires: 0 < p < 1.
[[nodiscard]] double normal_quantile(double p) noexcept;

/// The splitmix64 generator from state 0, for a sequence that one thread draws in order.
class SplitMix64 {
 public:
  constexpr std::uint64_t operator()() noexcept {
    return mix_bits(std::exchange(state_, state_ + kSplitMixIncrement));
  }

 private:
  std::uint64_t state_ = 0;
};

/// Numbers that depend only on what they are for, never on the order in which they are drawn.
///
/// A stream is named by a seed and up to three counters (frame, object, purpose); its n-th number
/// is a hash of name and n. So pixels and frames can be computed by any thread in any order and
/// give the same bytes. A small value; copies continue independently from where they are.
class CounterRng {
 public:
  /// The stream of `seed` for (a, b, c), which say what the numbers are for.
  constexpr CounterRng(std::uint64_t seed,
                       std::uint64_t a,
                       std::uint64_t b = 0,
                       std::uint64_t c = 0) noexcept
      : key_(mix_bits(mix_bits(mix_bits(mix_bits(seed) ^ a) ^ b) ^ c)) {}

  /// The number at position `counter` of the stream, without moving in it.
  [[nodiscard]] constexpr std::uint64_t bits_at(std::uint64_t counter) const noexcept {
    return mix_bits(key_ ^ mix_bits(counter));
  }
  /// Uniform in the open interval (0, 1): never 0, never 1.
  [[nodiscard]] constexpr double uniform_at(std::uint64_t counter) const noexcept {
    return (static_cast<double>(bits_at(counter) >> 11U) + 0.5) * 0x1.0p-53;
  }
  /// Standard normal.
  [[nodiscard]] double normal_at(std::uint64_t counter) const noexcept {
    return normal_quantile(uniform_at(counter));
  }

  /// The next number of the stream, uniform in (0, 1).
  [[nodiscard]] constexpr double uniform() noexcept { return uniform_at(next_++); }
  /// Uniform in (low, high).
  [[nodiscard]] constexpr double uniform(double low, double high) noexcept {
    return low + (high - low) * uniform();
  }
  /// The next number of the stream, standard normal.
  [[nodiscard]] double normal() noexcept { return normal_at(next_++); }
  /// Uniform in 0 .. count - 1. Requires: count > 0, below 2^32 (the bias is below 2^-32).
  [[nodiscard]] constexpr std::uint32_t below(std::uint32_t count) noexcept {
    return static_cast<std::uint32_t>(((bits_at(next_++) >> 32U) * count) >> 32U);
  }
  /// True with probability `p`.
  [[nodiscard]] constexpr bool chance(double p) noexcept { return uniform() < p; }

 private:
  std::uint64_t key_;
  std::uint64_t next_ = 0;
};

}  // namespace hypermap
