// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the headers of a zip file say, and whether they say one thing.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/zip_reader.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hypermap::zip {

/// Where the central directory lies. It ends where the end record begins, that of zip64 where there
/// is one.
struct EndRecord {
  std::size_t num_entries = 0;
  std::uint64_t directory_offset = 0;
  std::uint64_t directory_bytes = 0;
  std::uint64_t end_offset = 0;
};

/// A member as the central directory describes it.
struct Entry {
  ZipMember member;
  std::uint16_t flags = 0;
  std::uint64_t header_offset = 0;
  bool is_folder = false;
};

[[nodiscard]] Result<EndRecord> read_end_record(const ByteSource& source, const ZipLimits& limits);
[[nodiscard]] Result<std::vector<Entry>> read_directory(const ByteSource& source,
                                                        const EndRecord& end,
                                                        const ZipLimits& limits);
/// Checks the local headers and data descriptors against the directory, sets the data offsets, and
/// checks that the members fill the file up to the directory, each byte once.
[[nodiscard]] Result<void> read_local_headers(const ByteSource& source,
                                              const EndRecord& end,
                                              std::vector<Entry>& entries);

/// Whether sizes are within the limits. Errors: kLimit naming the limit.
[[nodiscard]] Result<void> check_size(const ZipMember& member, const ZipLimits& limits);

/// Errors: kUnsupported for encrypted entries and flags that are not known.
[[nodiscard]] Result<void> check_flags(std::uint16_t flags);

}  // namespace hypermap::zip
