// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The content of a member, checked.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/zip_reader.hpp"

#include <string>

namespace hypermap::zip {

/// Requires: sizes within limits, data_offset set.
/// Errors: kMalformedFile when data, size and CRC-32 do not fit each other; those of the source and
/// of `unpack`.
[[nodiscard]] Result<std::string> content_of(const ByteSource& source,
                                             const ZipMember& member,
                                             const LoadBudget& budget);

}  // namespace hypermap::zip
