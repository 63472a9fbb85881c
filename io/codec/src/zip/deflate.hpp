// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Packing and unpacking of members; zlib stops here.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace hypermap {

enum class Packing : std::uint8_t { kBest, kHuffmanOnly };

/// `content` as a raw deflate stream. Errors: kOutOfMemory.
[[nodiscard]] Result<std::string> pack(std::string_view content, Packing packing);

/// The content of a raw deflate stream, which must use all of `packed` and give exactly
/// `num_bytes`. Memory grows with what was really inflated. Errors: kMalformedFile, kOutOfMemory.
[[nodiscard]] Result<std::string> unpack(std::string_view packed, std::uint64_t num_bytes);

[[nodiscard]] std::uint32_t crc32_of(std::string_view content);

}  // namespace hypermap
