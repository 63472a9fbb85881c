// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Members of a zip file from an untrusted source.
///
/// Readers of zip files disagree about damaged ones: local and central headers may say different
/// things, bytes may belong to no member or to two. Here the file must say one thing only. It is
/// parsed by our own code over zlib's inflate, since libzip, even with ZIP_CHECKCONS, accepts
/// overlapping members, gaps, case collisions, device entries and any ratio.
///
/// Source: PKWARE APPNOTE.TXT 6.3, sections 4.3 and 4.4.
/// Scope: one disk, methods stored and deflated, no encryption; zip64 where each number of 64 bits
/// stands for one that is marked, and nowhere else.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/byte_source.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// What an archive may ask of us. Every error of code kLimit names the limit.
struct ZipLimits {
  std::uint64_t max_archive_bytes = std::uint64_t{4} << 30;  ///< The file itself.
  std::size_t max_entries = 1024;                            ///< Folder entries included.
  std::uint64_t max_entry_bytes = std::uint64_t{2} << 30;    ///< One member, inflated.
  std::uint64_t max_total_bytes = std::uint64_t{8} << 30;    ///< All members, inflated.
  /// Inflated over packed size; checked for members larger than `ratio_free_bytes`.
  std::uint64_t max_ratio = 200;
  std::uint64_t ratio_free_bytes = std::uint64_t{1} << 20;
};

/// One member as its headers describe it.
struct ZipMember {
  std::string name;  ///< Relative, with '/'; UTF-8; never "..", see `check_member_name`.
  std::uint64_t num_bytes = 0;
  std::uint64_t num_packed_bytes = 0;
  std::uint32_t crc32 = 0;
  bool deflated = false;
  std::uint64_t data_offset = 0;
};

/// An archive whose structure was found sound; members are inflated when they are asked for.
class ZipReader {
 public:
  /// Checks the whole structure: end record, central directory, local headers and descriptors, that
  /// members tile the file without gap or overlap, names, methods, sizes and ratios. Nothing is
  /// inflated.
  /// Errors: kMalformedFile; kUnsupported (encrypted, another method); kLimit; kIo. `entry`
  /// names the member where there is one.
  /// Cost: O(entries log entries); reads headers only.
  [[nodiscard]] static Result<ZipReader> create(std::shared_ptr<const ByteSource> source,
                                                const ZipLimits& limits = {});

  /// Members, folder entries left out, in the order of the central directory.
  [[nodiscard]] const std::vector<ZipMember>& members() const noexcept { return members_; }
  [[nodiscard]] bool contains(std::string_view name) const { return index_of_.contains(name); }
  /// Null when there is no such member.
  [[nodiscard]] const ZipMember* find(std::string_view name) const;

  /// The content of a member, read to its last byte and checked against size and CRC-32.
  /// Errors: kNotFound; kLimit when it is larger than `max_bytes`, checked before anything is
  /// inflated; kMalformedFile when data, size and CRC-32 do not fit each other; kIo; kOutOfMemory;
  /// kInterrupted when `budget` is told to stop, of which nothing is drawn.
  [[nodiscard]] Result<std::string> read(std::string_view name,
                                         std::uint64_t max_bytes = std::uint64_t{2} << 30,
                                         const LoadBudget& budget = {}) const;

  /// At most the first `max_bytes` bytes of a member, not checked against its CRC-32: enough for a
  /// header, not for content.
  /// Errors: kNotFound; kMalformedFile; kIo; kOutOfMemory.
  [[nodiscard]] Result<std::string> read_start(std::string_view name, std::size_t max_bytes) const;

 private:
  ZipReader(std::shared_ptr<const ByteSource> source, std::vector<ZipMember> members);

  std::shared_ptr<const ByteSource> source_;
  std::vector<ZipMember> members_;
  std::map<std::string, std::size_t, std::less<>> index_of_;
};

/// Whether `name` may stand for a member: 1 to 255 bytes of UTF-8 without control characters,
/// relative, '/' between parts that are neither empty nor "." nor "..", no backslash, no drive.
/// A folder's entry ends with '/'. Errors: kMalformedFile with the reason and the name.
[[nodiscard]] Result<void> check_member_name(std::string_view name);

}  // namespace hypermap
