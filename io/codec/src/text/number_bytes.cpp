// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/number_bytes.hpp"

#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

namespace hypermap {
namespace {

static_assert(std::numeric_limits<float>::is_iec559 && std::numeric_limits<double>::is_iec559);

template <class Unsigned>
Unsigned unsigned_at(std::string_view bytes, std::size_t at) {
  assert(at + sizeof(Unsigned) <= bytes.size());
  Unsigned value = 0;
  for (std::size_t i = sizeof(Unsigned); i > 0; --i) {
    value = (value << 8U) | static_cast<unsigned char>(bytes[at + i - 1]);
  }
  return value;
}

template <class Number, class Unsigned>
Result<std::vector<Number>> numbers_of_bytes(std::string_view bytes) {
  if (bytes.size() % sizeof(Number) != 0) {
    return fail(ErrorCode::kMalformedFile,
                "must have a multiple of " + std::to_string(sizeof(Number)) + " bytes, has " +
                    std::to_string(bytes.size()));
  }
  std::vector<Number> numbers;
  numbers.reserve(bytes.size() / sizeof(Number));
  for (std::size_t at = 0; at < bytes.size(); at += sizeof(Number)) {
    numbers.push_back(std::bit_cast<Number>(unsigned_at<Unsigned>(bytes, at)));
  }
  return numbers;
}

}  // namespace

void append_uint32(std::string& bytes, std::uint32_t value) {
  for (std::uint32_t shift = 0; shift < 32U; shift += 8U) {
    bytes += static_cast<char>(static_cast<unsigned char>((value >> shift) & 0xffU));
  }
}

std::uint32_t uint32_at(std::string_view bytes, std::size_t at) {
  return unsigned_at<std::uint32_t>(bytes, at);
}

std::string bytes_of_floats(std::span<const float> numbers) {
  std::string bytes;
  bytes.reserve(numbers.size() * sizeof(float));
  for (const float number : numbers) append_uint32(bytes, std::bit_cast<std::uint32_t>(number));
  return bytes;
}

Result<std::vector<float>> floats_of_bytes(std::string_view bytes) {
  return numbers_of_bytes<float, std::uint32_t>(bytes);
}

Result<std::vector<double>> doubles_of_bytes(std::string_view bytes) {
  return numbers_of_bytes<double, std::uint64_t>(bytes);
}

float rounded_to_float(double value) {
  constexpr auto kLargest = static_cast<double>(std::numeric_limits<float>::max());
  if (!std::isfinite(value) || std::abs(value) <= kLargest) return static_cast<float>(value);
  return value > 0.0 ? std::numeric_limits<float>::infinity()
                     : -std::numeric_limits<float>::infinity();
}

}  // namespace hypermap
