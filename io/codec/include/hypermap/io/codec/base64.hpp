// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Bytes as text of 64 letters. Source: RFC 4648 section 4, strictly: padded, no other letters, no
/// line ends, unused bits 0.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <string>
#include <string_view>

namespace hypermap {

[[nodiscard]] std::string encode_base64(std::string_view bytes);

/// Errors: kMalformedFile naming the position. Boundary: an empty text is no bytes.
[[nodiscard]] Result<std::string> decode_base64(std::string_view text);

}  // namespace hypermap
