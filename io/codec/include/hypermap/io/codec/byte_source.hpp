// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Bytes that can be read from any place, of known length: a file that stays the one that was
/// opened, or memory.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace hypermap {

/// Where a reader of a format gets its bytes. Plugged by tests that let a disk die.
/// Threads: read_at may be called concurrently.
class ByteSource {
 public:
  ByteSource() = default;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;
  ByteSource(ByteSource&&) = delete;
  ByteSource& operator=(ByteSource&&) = delete;
  virtual ~ByteSource() = default;

  [[nodiscard]] virtual std::uint64_t size() const = 0;

  /// `num_bytes` bytes from `offset` on.
  /// Errors: kMalformedFile when they reach beyond the end (a file that shrank while it was read
  /// included); kIo with the system's words; kOutOfMemory.
  [[nodiscard]] virtual Result<std::string> read_at(std::uint64_t offset,
                                                    std::size_t num_bytes) const = 0;
};

/// Opens a regular file; what replaces it under its name later is not seen.
///
/// Errors: kIo when it cannot be opened, or is no regular file (a folder, FIFO or device is
/// never read); kLimit when it is larger than `max_bytes`. `file` is filled in.
[[nodiscard]] Result<std::unique_ptr<ByteSource>> open_file(const std::filesystem::path& path,
                                                            std::uint64_t max_bytes);

/// Bytes in memory. Requires: `bytes` outlives the source.
[[nodiscard]] std::unique_ptr<ByteSource> view_bytes(std::string_view bytes);

/// A whole file. Errors: those of open_file and ByteSource::read_at.
[[nodiscard]] Result<std::string> read_file(const std::filesystem::path& path,
                                            std::uint64_t max_bytes);

}  // namespace hypermap
