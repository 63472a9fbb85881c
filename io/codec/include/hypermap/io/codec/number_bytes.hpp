// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Numbers as bytes, little endian whatever the machine is.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

void append_uint32(std::string& bytes, std::uint32_t value);
/// Requires: at + 4 <= bytes.size().
[[nodiscard]] std::uint32_t uint32_at(std::string_view bytes, std::size_t at);

/// Floats of 32 bits, IEEE 754.
[[nodiscard]] std::string bytes_of_floats(std::span<const float> numbers);
/// Errors: kMalformedFile for a size that is no multiple of 4.
[[nodiscard]] Result<std::vector<float>> floats_of_bytes(std::string_view bytes);
/// Floats of 64 bits, IEEE 754. Errors: kMalformedFile for a size that is no multiple of 8.
[[nodiscard]] Result<std::vector<double>> doubles_of_bytes(std::string_view bytes);

/// The nearest float; infinity for what is beyond all of them.
[[nodiscard]] float rounded_to_float(double value);

}  // namespace hypermap
