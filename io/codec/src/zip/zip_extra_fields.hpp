// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The extra fields of a header.
///
/// Source: PKWARE APPNOTE.TXT 6.3, sections 4.5.3 and 4.6.9.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <vector>

namespace hypermap::zip {

/// Extra fields must be well formed and must not change what the header says.
/// Errors: kMalformedFile.
[[nodiscard]] Result<void> check_extra(std::string_view extra, std::string_view name);

/// The numbers of a header, in the order of the extra field: size, packed size, offset of the local
/// header. One that is marked (`kZip64Marker32`) stands in the extra field.
/// Errors: kMalformedFile for an extra field that has more or less than the marked ones.
/// Requires: check_extra(extra).
[[nodiscard]] Result<std::vector<std::uint64_t>> wide_numbers(
    std::string_view extra, std::initializer_list<std::uint32_t> numbers);

}  // namespace hypermap::zip
