// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The end record of zip64: numbers of 64 bits for those that 32 or 16 cannot hold.
///
/// Source: PKWARE APPNOTE.TXT 6.3, sections 4.3.14 and 4.3.15.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "zip_directory.hpp"

#include <cstdint>

namespace hypermap::zip {

/// The end record of zip64, which with its locator lies right before that of `end_offset`.
/// `narrow` is what that one says, with markers where it cannot say it.
/// Errors: kMalformedFile when they are not there, say something else or describe several disks.
[[nodiscard]] Result<EndRecord> read_wide_end(const ByteSource& source,
                                              std::uint64_t end_offset,
                                              const EndRecord& narrow);

}  // namespace hypermap::zip
