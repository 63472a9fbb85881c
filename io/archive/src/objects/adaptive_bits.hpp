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

/// The numbers that the bits so far leave: [low, high].
class BitInterval {
 public:
  /// The last number of the part that stands for 1.
  [[nodiscard]] std::uint32_t split(std::uint32_t probability_of_one) const noexcept {
    const std::uint32_t width = high_ - low_;
    return low_ + (width >> 16U) * probability_of_one +
           ((width & 0xFFFFU) * probability_of_one >> 16U);
  }
  void take(bool bit, std::uint32_t last_of_one) noexcept {
    low_ = bit ? low_ : last_of_one + 1;
    high_ = bit ? last_of_one : high_;
  }
  /// Whether all numbers begin with one byte, which `shift` then drops.
  [[nodiscard]] bool has_first_byte() const noexcept { return (low_ ^ high_) >> 24U == 0; }
  [[nodiscard]] std::uint8_t first_byte() const noexcept {
    return static_cast<std::uint8_t>(low_ >> 24U);
  }
  void shift() noexcept {
    low_ <<= 8U;
    high_ = high_ << 8U | 0xFFU;
  }

 private:
  std::uint32_t low_ = 0;
  std::uint32_t high_ = 0xFFFF'FFFF;
};

/// Probability of a bit of which nothing is known.
inline constexpr std::uint32_t kEvenOdds = 32768;

class BitEncoder {
 public:
  /// Both return the bit.
  bool code(BitModel& model, bool bit) {
    (void)code_even(bit, model.probability_of_one());
    model.update(bit);
    return bit;
  }
  bool code_even(bool bit, std::uint32_t probability_of_one = kEvenOdds) {
    interval_.take(bit, interval_.split(probability_of_one));
    for (; interval_.has_first_byte(); interval_.shift())
      bytes_ += static_cast<char>(interval_.first_byte());
    return bit;
  }
  /// The bytes: of the last one all that is needed to stay within the interval, with zeros behind.
  [[nodiscard]] std::string finish() {
    bytes_ += static_cast<char>(interval_.first_byte() + 1U);
    return std::move(bytes_);
  }

 private:
  BitInterval interval_;
  std::string bytes_;
};

/// The bits again, when it is asked in the same order with the same models. Boundary: bytes that
/// end too early go on with zeros, of which `num_bytes_used` tells.
class BitDecoder {
 public:
  explicit BitDecoder(std::string_view bytes) : bytes_(bytes) {
    for (int i = 0; i < 4; ++i) take_byte();
  }
  /// What is given as the bit does not matter.
  bool code(BitModel& model, bool /*bit*/) {
    const bool bit = code_even(false, model.probability_of_one());
    model.update(bit);
    return bit;
  }
  bool code_even(bool /*bit*/, std::uint32_t probability_of_one = kEvenOdds) {
    const std::uint32_t last_of_one = interval_.split(probability_of_one);
    const bool bit = number_ <= last_of_one;
    interval_.take(bit, last_of_one);
    for (; interval_.has_first_byte(); interval_.shift()) take_byte();
    return bit;
  }
  /// How many bytes an encoder has made of the bits so far.
  [[nodiscard]] std::size_t num_bytes_used() const noexcept { return num_taken_ - 3; }

 private:
  void take_byte() noexcept {
    const bool is_there = num_taken_ < bytes_.size();
    number_ = number_ << 8U | (is_there ? static_cast<unsigned char>(bytes_[num_taken_]) : 0U);
    ++num_taken_;
  }

  std::string_view bytes_;
  std::size_t num_taken_ = 0;
  std::uint32_t number_ = 0;
  BitInterval interval_;
};

}  // namespace hypermap
