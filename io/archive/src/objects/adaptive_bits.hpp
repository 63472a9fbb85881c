// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Bits as the bytes of one number, each at the cost of how unlikely it was: arithmetic coding with
/// probabilities that are learned on the way, in integers alone.
///
/// Source: I. Witten, R. Neal, J. Cleary, "Arithmetic Coding for Data Compression", CACM 30 (1987).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace hypermap {

/// How probable it is that the next bit of a kind is 1, from those of the kind so far.
class BitModel {
 public:
  /// In 1 / 65536, never 0 nor 1.
  [[nodiscard]] std::uint32_t probability_of_one() const noexcept { return one_; }

  /// The first bits count most, later ones a sixtieth.
  void update(bool bit) noexcept {
    const std::int64_t error = (bit ? kCertain : 65536 - kCertain) - std::int64_t{one_};
    one_ = static_cast<std::uint16_t>(one_ + error * kRates[num_seen_] / 65536);
    if (num_seen_ + 1U < kRates.size()) ++num_seen_;
  }

 private:
  static constexpr std::int64_t kCertain = 65520;
  static constexpr std::array<std::int32_t, 60> kRates = [] {
    std::array<std::int32_t, 60> rates{};
    for (std::size_t i = 0; i < rates.size(); ++i)
      rates.at(i) = static_cast<std::int32_t>(655'360 / (10 * i + 16));
    return rates;
  }();

  std::uint16_t one_ = 32768;
  std::uint16_t num_seen_ = 0;
};

/// The numbers that the bits so far leave: [low, low + width]. Without branches that depend on
/// bits, which are hard to foresee.
class BitInterval {
 public:
  /// How many numbers but one stand for 1; less than the width.
  [[nodiscard]] std::uint32_t split(std::uint32_t probability_of_one) const noexcept {
    return static_cast<std::uint32_t>(std::uint64_t{width_} * probability_of_one >> 16U);
  }
  void take(bool bit, std::uint32_t split) noexcept {
    const std::uint32_t if_zero = std::uint32_t{bit} - 1U;  // all bits or none
    low_ += (split + 1U) & if_zero;
    width_ = split + ((width_ - 2U * split - 1U) & if_zero);
  }
  /// Whether all numbers begin with one byte, which `shift` then drops.
  [[nodiscard]] bool has_first_byte() const noexcept {
    return (low_ ^ (low_ + width_)) >> 24U == 0;
  }
  [[nodiscard]] std::uint8_t first_byte() const noexcept {
    return static_cast<std::uint8_t>(low_ >> 24U);
  }
  void shift() noexcept {
    low_ <<= 8U;
    width_ = width_ << 8U | 0xFFU;
  }

 private:
  std::uint32_t low_ = 0;
  std::uint32_t width_ = 0xFFFF'FFFF;
};

/// Probability of a bit of which nothing is known.
inline constexpr std::uint32_t kEvenOdds = 32768;

/// How many bits a cursor of an encoder or decoder codes at most.
inline constexpr std::size_t kBitsOfCursor = 64;

/// Bits are coded by cursors, values of a few words that a loop keeps in registers: what `cursor`
/// returns goes back by `keep` before the next one is asked for.
class BitEncoder {
 public:
  class Cursor {
   public:
    /// Both return the bit.
    bool code(BitModel& model, bool bit) noexcept {
      (void)code_even(bit, model.probability_of_one());
      model.update(bit);
      return bit;
    }
    bool code_even(bool bit, std::uint32_t probability_of_one = kEvenOdds) noexcept {
      interval_.take(bit, interval_.split(probability_of_one));
      for (; interval_.has_first_byte(); interval_.shift())
        *end_++ = static_cast<char>(interval_.first_byte());
      return bit;
    }

   private:
    friend BitEncoder;
    BitInterval interval_;
    char* end_ = nullptr;
  };

  [[nodiscard]] Cursor cursor() {
    constexpr std::size_t kMostBytes = 4 * kBitsOfCursor;  // a bit drops the whole number at most
    if (bytes_.size() - num_bytes_ < kMostBytes) bytes_.resize(2 * bytes_.size() + kMostBytes);
    cursor_.end_ = bytes_.data() + num_bytes_;
    return cursor_;
  }
  void keep(const Cursor& cursor) noexcept {
    cursor_ = cursor;
    num_bytes_ = static_cast<std::size_t>(cursor.end_ - bytes_.data());
  }
  /// The bytes: of the last one all that is needed to stay within the interval, with zeros behind.
  [[nodiscard]] std::string finish() {
    bytes_.resize(num_bytes_);
    bytes_ += static_cast<char>(cursor_.interval_.first_byte() + 1U);
    return std::move(bytes_);
  }

 private:
  std::string bytes_;  // with room behind the last one
  std::size_t num_bytes_ = 0;
  Cursor cursor_;
};

/// The bits again, when it is asked in the same order with the same models. Boundary: bytes that
/// end too early go on with zeros, of which `num_bytes_used` tells.
class BitDecoder {
 public:
  using Cursor = BitDecoder;

  explicit BitDecoder(std::string_view bytes) : bytes_(bytes) {
    for (int i = 0; i < 4; ++i) take_byte();
  }
  [[nodiscard]] Cursor cursor() const noexcept { return *this; }
  void keep(const Cursor& cursor) noexcept { *this = cursor; }

  /// What is given as the bit does not matter.
  bool code(BitModel& model, bool /*bit*/) noexcept {
    const bool bit = code_even(false, model.probability_of_one());
    model.update(bit);
    return bit;
  }
  bool code_even(bool /*bit*/, std::uint32_t probability_of_one = kEvenOdds) noexcept {
    const std::uint32_t split = interval_.split(probability_of_one);
    const bool bit = offset_ <= split;
    interval_.take(bit, split);
    offset_ -= (split + 1U) & (std::uint32_t{bit} - 1U);
    for (; interval_.has_first_byte(); interval_.shift()) take_byte();
    return bit;
  }
  /// How many bytes an encoder has made of the bits so far.
  [[nodiscard]] std::size_t num_bytes_used() const noexcept { return num_taken_ - 3; }

 private:
  void take_byte() noexcept {
    const bool is_there = num_taken_ < bytes_.size();
    offset_ = offset_ << 8U | (is_there ? static_cast<unsigned char>(bytes_[num_taken_]) : 0U);
    ++num_taken_;
  }

  std::string_view bytes_;
  std::size_t num_taken_ = 0;
  std::uint32_t offset_ = 0;  // of the number from the interval's lowest
  BitInterval interval_;
};

}  // namespace hypermap
