// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Checksums, of archive members and in bare files of ours.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace hypermap {

/// CRC-32 as zip and PNG have it. `before` is that of the text on which `content` follows.
[[nodiscard]] std::uint32_t crc32_of(std::string_view content, std::uint32_t before = 0);

/// Eight hexadecimal digits, in lower case.
[[nodiscard]] std::string checksum_text(std::uint32_t crc);

}  // namespace hypermap
