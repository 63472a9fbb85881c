// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What stands before the numbers of a NumPy file. Source: numpy.lib.format.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace hypermap {

struct NpyHeader {
  bool is_double = false;         ///< Else float of 32 bits; both little endian.
  std::uint64_t num_numbers = 0;  ///< Of shape (N,) or (1, N).
  std::size_t num_header_bytes = 0;
};

[[nodiscard]] bool is_npy(std::string_view bytes);

/// Errors: kMalformedFile for a header that is cut or no header; kUnsupported for another version,
/// type or shape. Requires: is_npy(bytes).
[[nodiscard]] Result<NpyHeader> parse_npy_header(std::string_view bytes);

}  // namespace hypermap
