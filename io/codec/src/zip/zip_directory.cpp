// SPDX-License-Identifier: BSD-3-Clause
#include "zip_directory.hpp"

#include "hypermap/io/codec/archive_size.hpp"
#include "zip64.hpp"
#include "zip_extra_fields.hpp"
#include "zip_format.hpp"
#include "zip_names.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace hypermap::zip {
namespace {

constexpr std::size_t kMaxZipCommentBytes = 0xffff;
constexpr std::uint64_t kMaxDirectoryBytes = std::uint64_t{16} << 20;

Unexpected malformed_directory(std::string what) {
  return fail(ErrorCode::kMalformedFile, std::move(what));
}

Unexpected in_entry(Unexpected error, std::string_view name) {
  error.value().entry = name;
  return error;
}

/// The one place where an end record with its comment reaches exactly to the end of the file.
Result<std::size_t> find_end(std::string_view tail) {
  std::size_t found = std::string_view::npos;
  for (std::size_t at = 0; at + kEndBytes <= tail.size(); ++at) {
    if (get32(tail, at) != kEndSignature) continue;
    if (at + kEndBytes + get16(tail, at + 20) != tail.size()) continue;
    if (found != std::string_view::npos) return malformed_directory("has two end records");
    found = at;
  }
  if (found == std::string_view::npos)
    return malformed_directory(
        "not a map archive: no zip end record at its end (cut, or bytes after it)");
  return found;
}

/// Only plain files and folders. Source: APPNOTE 4.4.2 and 4.4.15, upper half: mode of the system.
Result<void> check_kind(std::uint16_t made_by, std::uint32_t attributes, bool is_folder) {
  constexpr unsigned kUnix = 3;
  constexpr unsigned kMacOs = 19;
  const unsigned system = made_by >> 8U;
  if (system != kUnix && system != kMacOs) return {};
  const std::uint32_t kind = attributes >> 16U & 0170000U;
  if (kind == 0 || kind == (is_folder ? 0040000U : 0100000U)) return {};
  return malformed_directory("is a link, a device or another special file, expected a plain file");
}

Result<void> check_method(const Entry& entry, std::uint16_t method) {
  if (method != kStored && method != kDeflated)
    return fail(ErrorCode::kUnsupported,
                "compression method " + std::to_string(method) +
                    " is not supported, expected 0 (stored) or 8 (deflated)");
  const ZipMember& member = entry.member;
  if (method == kStored && member.num_bytes != member.num_packed_bytes)
    return malformed_directory("is stored, yet its two sizes differ");
  if (entry.is_folder && member.num_bytes != 0)
    return malformed_directory("is a folder with content");
  return {};
}

/// One central header at the front of `rest`, which is shortened by it.
Result<Entry> take_entry(std::string_view& rest) {
  if (rest.size() < kCentralBytes || get32(rest, 0) != kCentralSignature)
    return malformed_directory("central directory: no header where one is expected");
  const std::size_t name_bytes = get16(rest, 28);
  const std::size_t extra_bytes = get16(rest, 30);
  const std::size_t all = kCentralBytes + name_bytes + extra_bytes + get16(rest, 32);
  if (rest.size() < all)
    return malformed_directory("central directory: header reaches beyond its end");
  const std::string_view name = rest.substr(kCentralBytes, name_bytes);

  const std::string_view extra = rest.substr(kCentralBytes + name_bytes, extra_bytes);
  const std::uint16_t method = get16(rest, 10);
  Entry entry{.member = {.name = std::string(name),
                         .crc32 = get32(rest, 16),
                         .deflated = method == kDeflated},
              .flags = get16(rest, 8),
              .is_folder = name.ends_with('/')};
  const auto check_fields = [&]() -> Result<void> {
    HYPERMAP_TRY(check_member_name(name));
    if (get16(rest, 34) != 0) return malformed_directory("lies on another disk");
    HYPERMAP_TRY(check_extra(extra, name));
    HYPERMAP_ASSIGN_OR_RETURN(
        const auto numbers,
        wide_numbers(extra, {get32(rest, 24), get32(rest, 20), get32(rest, 42)}));
    entry.member.num_bytes = numbers[0];
    entry.member.num_packed_bytes = numbers[1];
    entry.header_offset = numbers[2];
    HYPERMAP_TRY(check_flags(entry.flags));
    HYPERMAP_TRY(check_method(entry, method));
    return check_kind(get16(rest, 4), get32(rest, 38), entry.is_folder);
  };
  if (auto checked = check_fields(); !checked)
    return in_entry(tl::make_unexpected(std::move(checked).error()), name);
  rest.remove_prefix(all);
  return entry;
}

/// How long the data descriptor at `at` is: with or without a signature, sizes of 64 bits where the
/// local header has those of zip64. `room`: bytes up to the directory.
/// Source: APPNOTE 4.3.9.
Result<std::size_t> check_descriptor(const ByteSource& source,
                                     std::uint64_t at,
                                     std::uint64_t room,
                                     const ZipMember& member,
                                     bool is_wide) {
  const std::size_t size_bytes = is_wide ? 8 : 4;
  const std::size_t num_bytes = 4 + 2 * size_bytes;
  const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(4 + num_bytes, room));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, source.read_at(at, wanted));
  const auto size_at = [&](std::size_t i) { return is_wide ? get64(bytes, i) : get32(bytes, i); };
  const auto agrees = [&](std::size_t i) {
    return bytes.size() >= i + num_bytes && get32(bytes, i) == member.crc32 &&
           size_at(i + 4) == member.num_packed_bytes &&
           size_at(i + 4 + size_bytes) == member.num_bytes;
  };
  if (agrees(4) && get32(bytes, 0) == kDescriptorSignature) return 4 + num_bytes;
  if (agrees(0)) return num_bytes;
  return malformed_directory("data descriptor and central header differ in size or CRC-32");
}

/// The end of the member's bytes, descriptor included, after its local header was checked.
/// Source: APPNOTE 4.3.7, 4.3.9.
Result<std::uint64_t> check_local_header(const ByteSource& source,
                                         std::uint64_t directory_offset,
                                         Entry& entry) {
  ZipMember& member = entry.member;
  if (entry.header_offset > directory_offset ||
      directory_offset - entry.header_offset < kLocalBytes)
    return malformed_directory("local header lies beyond the members");
  HYPERMAP_ASSIGN_OR_RETURN(const std::string header,
                            source.read_at(entry.header_offset, kLocalBytes));
  if (get32(header, 0) != kLocalSignature)
    return malformed_directory("no local header where one is said");
  const std::size_t name_bytes = get16(header, 26);
  const std::size_t extra_bytes = get16(header, 28);
  const std::uint64_t data_offset = entry.header_offset + kLocalBytes + name_bytes + extra_bytes;
  if (data_offset > directory_offset || directory_offset - data_offset < member.num_packed_bytes)
    return malformed_directory("data reach into the central directory");
  HYPERMAP_ASSIGN_OR_RETURN(
      const std::string names,
      source.read_at(entry.header_offset + kLocalBytes, name_bytes + extra_bytes));
  if (names.compare(0, name_bytes, member.name) != 0)
    return malformed_directory("local header names another member: '" +
                               printable(names.substr(0, name_bytes)) + "'");
  const std::string_view extra = std::string_view(names).substr(name_bytes);
  HYPERMAP_TRY(check_extra(extra, member.name));
  HYPERMAP_ASSIGN_OR_RETURN(const auto sizes,
                            wide_numbers(extra, {get32(header, 22), get32(header, 18)}));
  if (get16(header, 6) != entry.flags || (get16(header, 8) == kDeflated) != member.deflated ||
      (get16(header, 8) != kDeflated && get16(header, 8) != kStored))
    return malformed_directory("local and central header differ in flags or method");

  const bool has_descriptor = (entry.flags & kFlagDescriptor) != 0;
  const std::uint32_t crc32 = get32(header, 14);
  const bool agrees =
      crc32 == member.crc32 && sizes[0] == member.num_bytes && sizes[1] == member.num_packed_bytes;
  const bool left_open = has_descriptor && crc32 == 0 && sizes[0] == 0 && sizes[1] == 0;
  if (!left_open && !agrees)
    return malformed_directory("local and central header differ in size or CRC-32");
  member.data_offset = data_offset;
  const std::uint64_t data_end = data_offset + member.num_packed_bytes;
  if (!has_descriptor) return data_end;
  const bool is_wide = get32(header, 22) == kZip64Marker32 || get32(header, 18) == kZip64Marker32;
  HYPERMAP_ASSIGN_OR_RETURN(
      const std::size_t num_bytes,
      check_descriptor(source, data_end, directory_offset - data_end, member, is_wide));
  return data_end + num_bytes;
}

}  // namespace

Result<void> check_flags(std::uint16_t flags) {
  if ((flags & (kFlagEncrypted | kFlagStrongEncryption | kFlagMaskedHeader)) != 0)
    return fail(ErrorCode::kUnsupported, "encrypted entries are not supported");
  if ((flags & ~(kFlagsDeflateLevel | kFlagDescriptor | kFlagUtf8)) != 0)
    return fail(ErrorCode::kUnsupported, "unknown flags " + std::to_string(flags));
  return {};
}

Result<EndRecord> read_end_record(const ByteSource& source, const ZipLimits& limits) {
  HYPERMAP_TRY(check_archive_size(source.size(), limits));
  const std::uint64_t tail_bytes =
      std::min<std::uint64_t>(source.size(), kEndBytes + kMaxZipCommentBytes);
  HYPERMAP_ASSIGN_OR_RETURN(
      const std::string tail,
      source.read_at(source.size() - tail_bytes, static_cast<std::size_t>(tail_bytes)));
  HYPERMAP_ASSIGN_OR_RETURN(const std::size_t at, find_end(tail));
  const std::uint64_t end_offset = source.size() - tail_bytes + at;
  const std::uint16_t num_entries = get16(tail, at + 10);
  EndRecord end{.num_entries = num_entries,
                .directory_offset = get32(tail, at + 16),
                .directory_bytes = get32(tail, at + 12),
                .end_offset = end_offset};
  if (get16(tail, at + 4) != 0 || get16(tail, at + 6) != 0 || get16(tail, at + 8) != num_entries)
    return malformed_directory("archive in several parts");
  const bool is_wide = num_entries == kZip64Marker16 || end.directory_offset == kZip64Marker32 ||
                       end.directory_bytes == kZip64Marker32;
  if (is_wide) {
    HYPERMAP_ASSIGN_OR_RETURN(end, read_wide_end(source, end_offset, end));
  }
  if (end.num_entries > limits.max_entries)
    return fail(ErrorCode::kLimit,
                std::to_string(end.num_entries) + " entries, the limit is " +
                    std::to_string(limits.max_entries));
  if (end.directory_offset > end.end_offset ||
      end.end_offset - end.directory_offset != end.directory_bytes)
    return malformed_directory("central directory does not end where the end record begins");
  if (end.directory_bytes > kMaxDirectoryBytes)
    return fail(ErrorCode::kLimit,
                "central directory of " + std::to_string(end.directory_bytes) +
                    " bytes, the limit is " + std::to_string(kMaxDirectoryBytes));
  return end;
}

Result<std::vector<Entry>> read_directory(const ByteSource& source,
                                          const EndRecord& end,
                                          const ZipLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(
      const std::string directory,
      source.read_at(end.directory_offset, static_cast<std::size_t>(end.directory_bytes)));
  std::string_view rest = directory;
  std::vector<Entry> entries;
  MemberNames names;
  std::uint64_t total_bytes = 0;
  for (std::size_t i = 0; i < end.num_entries; ++i) {
    HYPERMAP_ASSIGN_OR_RETURN(Entry entry, take_entry(rest));
    HYPERMAP_TRY(names.add(entry.member.name));
    HYPERMAP_TRY(check_size(entry.member, limits));
    total_bytes += entry.member.num_bytes;
    entries.push_back(std::move(entry));
  }
  if (!rest.empty()) return malformed_directory("central directory holds more than it says");
  if (total_bytes > limits.max_total_bytes)
    return fail(ErrorCode::kLimit,
                "members of together " + std::to_string(total_bytes) + " bytes, the limit is " +
                    std::to_string(limits.max_total_bytes));
  return entries;
}

Result<void> read_local_headers(const ByteSource& source,
                                const EndRecord& end,
                                std::vector<Entry>& entries) {
  std::vector<Entry*> by_offset;
  by_offset.reserve(entries.size());
  for (Entry& entry : entries) by_offset.push_back(&entry);
  std::stable_sort(by_offset.begin(), by_offset.end(), [](const Entry* a, const Entry* b) {
    return a->header_offset < b->header_offset;
  });
  std::uint64_t filled_up_to = 0;
  for (Entry* entry : by_offset) {
    if (entry->header_offset < filled_up_to)
      return in_entry(malformed_directory("overlaps another entry"), entry->member.name);
    if (entry->header_offset > filled_up_to)
      return in_entry(malformed_directory("bytes before it belong to no entry"),
                      entry->member.name);
    auto checked = check_local_header(source, end.directory_offset, *entry);
    if (!checked)
      return in_entry(tl::make_unexpected(std::move(checked).error()), entry->member.name);
    filled_up_to = *checked;
  }
  if (filled_up_to != end.directory_offset)
    return malformed_directory("bytes before the central directory belong to no entry");
  return {};
}

Result<void> check_size(const ZipMember& member, const ZipLimits& limits) {
  const auto too_large = [&](std::string what) {
    return in_entry(fail(ErrorCode::kLimit, std::move(what)), member.name);
  };
  if (member.num_bytes > limits.max_entry_bytes)
    return too_large(std::to_string(member.num_bytes) + " bytes, the limit for an entry is " +
                     std::to_string(limits.max_entry_bytes));
  if (member.num_bytes > limits.ratio_free_bytes &&
      member.num_bytes / limits.max_ratio >= std::max<std::uint64_t>(member.num_packed_bytes, 1))
    return too_large(std::to_string(member.num_bytes) + " bytes packed into " +
                     std::to_string(member.num_packed_bytes) + ", the limit is a ratio of " +
                     std::to_string(limits.max_ratio) + ":1");
  return {};
}

}  // namespace hypermap::zip
