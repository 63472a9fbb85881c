// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/zip_writer.hpp"

#include "deflate.hpp"
#include "hypermap/core/base/caught.hpp"
#include "hypermap/io/codec/checksum.hpp"
#include "zip_directory.hpp"
#include "zip_format.hpp"
#include "zip_names.hpp"

#include <exception>
#include <optional>
#include <utility>

namespace hypermap {
namespace {

using zip::put16;
using zip::put32;

constexpr std::uint32_t kVersionNeeded = 20;       // 2.0: deflate
constexpr std::uint32_t kMadeBy = 3U << 8U | 30U;  // Unix, so that the mode is read
constexpr std::uint32_t kMode = 0100644U << 16U;
constexpr std::uint32_t kDosTime = 0;              // 00:00
constexpr std::uint32_t kDosDate = 1U << 5U | 1U;  // 1980-01-01, the first day that zip knows

bool is_ascii(std::string_view name) {
  for (const char c : name)
    if (static_cast<unsigned char>(c) >= 0x80) return false;
  return true;
}

/// What local and central header share. Source: APPNOTE 4.3.7, from "version needed" to sizes.
void put_common(std::string& out, const ZipMember& member) {
  put16(out, kVersionNeeded);
  put16(out, is_ascii(member.name) ? 0 : zip::kFlagUtf8);
  put16(out, member.deflated ? zip::kDeflated : zip::kStored);
  put16(out, kDosTime);
  put16(out, kDosDate);
  put32(out, member.crc32);
  put32(out, static_cast<std::uint32_t>(member.num_packed_bytes));
  put32(out, static_cast<std::uint32_t>(member.num_bytes));
  put16(out, static_cast<std::uint32_t>(member.name.size()));
  put16(out, 0);  // extra field
}

std::uint64_t header_offset(const ZipMember& member) {
  return member.data_offset - zip::kLocalBytes - member.name.size();
}

void put_central(std::string& out, const ZipMember& member) {
  put32(out, zip::kCentralSignature);
  put16(out, kMadeBy);
  put_common(out, member);
  put16(out, 0);  // comment
  put16(out, 0);  // disk
  put16(out, 0);  // internal attributes
  put32(out, kMode);
  put32(out, static_cast<std::uint32_t>(header_offset(member)));
  out += member.name;
}

void put_end(std::string& out, std::size_t num_entries, std::size_t directory_offset) {
  const std::size_t directory_bytes = out.size() - directory_offset;
  put32(out, zip::kEndSignature);
  put16(out, 0);  // this disk
  put16(out, 0);  // disk of the directory
  put16(out, static_cast<std::uint32_t>(num_entries));
  put16(out, static_cast<std::uint32_t>(num_entries));
  put32(out, static_cast<std::uint32_t>(directory_bytes));
  put32(out, static_cast<std::uint32_t>(directory_offset));
  put16(out, 0);  // comment
}

/// The packed form, or none where storing is no larger.
Result<std::optional<std::string>> pack_member(ZipMember member,
                                               std::string_view content,
                                               const ZipLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(std::string packed, pack(content, Packing::kBest));
  member.num_packed_bytes = packed.size();
  if (!zip::check_size(member, limits)) {
    HYPERMAP_ASSIGN_OR_RETURN(packed, pack(content, Packing::kHuffmanOnly));
  }
  if (packed.size() >= content.size()) return std::optional<std::string>();
  return std::optional<std::string>(std::move(packed));
}

}  // namespace

Result<PackedMember> packed_member(std::string_view name,
                                   std::string_view content,
                                   const ZipLimits& limits) try {
  HYPERMAP_TRY(check_member_name(name));
  ZipMember member{.name = std::string(name),
                   .num_bytes = content.size(),
                   .num_packed_bytes = content.size(),
                   .crc32 = crc32_of(content)};
  HYPERMAP_TRY(zip::check_size(member, limits));
  HYPERMAP_ASSIGN_OR_RETURN(std::optional<std::string> packed,
                            pack_member(member, content, limits));
  member.deflated = packed.has_value();
  std::string bytes = packed ? *std::move(packed) : std::string(content);
  member.num_packed_bytes = bytes.size();
  return PackedMember{.member = std::move(member), .bytes = std::move(bytes)};
} catch (const std::exception& exception) {
  return caught(exception, ErrorCode::kInvalidArgument, "the archive");
}

Result<void> ZipWriter::add(std::string_view name, std::string_view content) {
  HYPERMAP_ASSIGN_OR_RETURN(PackedMember packed, packed_member(name, content, limits_));
  return add(std::move(packed));
}

Result<void> ZipWriter::add(PackedMember packed) try {
  total_bytes_ += packed.member.num_bytes;
  if (total_bytes_ > limits_.max_total_bytes)
    return fail(ErrorCode::kLimit,
                "members of together " + std::to_string(total_bytes_) + " bytes, the limit is " +
                    std::to_string(limits_.max_total_bytes));
  if (members_.size() >= limits_.max_entries)
    return fail(ErrorCode::kLimit,
                "more members than the limit of " + std::to_string(limits_.max_entries));
  zip::put32(archive_, zip::kLocalSignature);
  put_common(archive_, packed.member);
  archive_ += packed.member.name;
  packed.member.data_offset = archive_.size();
  archive_ += packed.bytes;
  members_.push_back(std::move(packed.member));
  return {};
} catch (const std::exception& exception) {
  return caught(exception, ErrorCode::kInvalidArgument, "the archive");
}

Result<std::string> ZipWriter::finish() try {
  MemberNames names;
  for (const ZipMember& member : members_) HYPERMAP_TRY(names.add(member.name));
  const std::size_t directory_offset = archive_.size();
  for (const ZipMember& member : members_) put_central(archive_, member);
  put_end(archive_, members_.size(), directory_offset);
  members_.clear();
  total_bytes_ = 0;
  std::string archive = std::exchange(archive_, {});
  if (archive.size() > limits_.max_archive_bytes || archive.size() >= zip::kZip64Marker32)
    return fail(ErrorCode::kLimit,
                "archive of " + std::to_string(archive.size()) + " bytes, the limit is " +
                    std::to_string(limits_.max_archive_bytes));
  return archive;
} catch (const std::exception& exception) {
  return caught(exception, ErrorCode::kInvalidArgument, "the archive");
}

}  // namespace hypermap
