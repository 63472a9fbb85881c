// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Packing and unpacking of members; libdeflate and zlib stop here.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace hypermap {

enum class Packing : std::uint8_t {
  kBest,         ///< By libdeflate, in half zlib's time, in memory for the content once more.
  kHuffmanOnly,  ///< By zlib, without repetitions: an eighth of the content at least.
};

/// `content` as a raw deflate stream. Errors: kOutOfMemory.
[[nodiscard]] Result<std::string> pack(std::string_view content, Packing packing);

/// The content of a raw deflate stream, which must use all of `packed` and give exactly
/// `num_bytes`. Memory: up to 512 MiB what `packed` can stand for at most is taken at once, beyond
/// that it grows with what was really inflated. Errors: kMalformedFile, kOutOfMemory, kInterrupted
/// when `budget` is told to stop.
[[nodiscard]] Result<std::string> unpack(std::string_view packed,
                                         std::uint64_t num_bytes,
                                         const LoadBudget& budget);

/// At most the first `max_bytes` bytes that a raw deflate stream, which may be cut, stands for.
/// Errors: kMalformedFile, kOutOfMemory.
[[nodiscard]] Result<std::string> unpack_start(std::string_view packed, std::size_t max_bytes);

}  // namespace hypermap
