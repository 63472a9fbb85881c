// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Zip files whose bytes depend on their members alone.
///
/// Source: PKWARE APPNOTE.TXT 6.3, sections 4.3 and 4.4.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/zip_reader.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// A member as it will lie in the file.
struct PackedMember {
  ZipMember member;   ///< Without its place.
  std::string bytes;  ///< As `member` says, deflated or not.
};

/// What ZipWriter::add does of it by itself, so that several members can be packed at a time.
/// Errors: those of ZipWriter::add but the limits on all members together. Threads: from any.
[[nodiscard]] Result<PackedMember> packed_member(std::string_view name,
                                                 std::string_view content,
                                                 const ZipLimits& limits);

/// Collects members in the order in which they are added. Every stamp is 1980-01-01 00:00, every
/// mode rw-r--r--; members are deflated unless storing them is smaller.
class ZipWriter {
 public:
  explicit ZipWriter(const ZipLimits& limits = {}) : limits_(limits) {}

  /// Errors: those that ZipReader would give for such a member: kMalformedFile for the name,
  /// kLimit; kOutOfMemory. Boundary: a member that would deflate beyond the reader's limit on
  /// ratios is packed by Huffman codes alone (at most 8:1), so that the reader lets it pass.
  [[nodiscard]] Result<void> add(std::string_view name, std::string_view content);
  /// Errors: kLimit for the limits on all members together; kOutOfMemory.
  /// Requires: packed within this writer's limits.
  [[nodiscard]] Result<void> add(PackedMember packed);

  /// The archive. Leaves the writer empty.
  /// Errors: kMalformedFile when two names are equal but for the case of their letters, or one is
  /// also the folder of another; kLimit when the archive is larger than the limit; kOutOfMemory.
  [[nodiscard]] Result<std::string> finish();

 private:
  ZipLimits limits_;
  std::vector<ZipMember> members_;
  std::uint64_t total_bytes_ = 0;
  std::string archive_;
};

}  // namespace hypermap
