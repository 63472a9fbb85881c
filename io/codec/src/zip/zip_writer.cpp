// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/zip_writer.hpp"

#include "deflate.hpp"
#include "hypermap/core/base/caught.hpp"
#include "hypermap/io/codec/archive_size.hpp"
#include "hypermap/io/codec/checksum.hpp"
#include "zip_directory.hpp"
#include "zip_format.hpp"
#include "zip_names.hpp"
#include "zip_records.hpp"

#include <exception>
#include <optional>
#include <utility>

namespace hypermap {
namespace {

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
  if (content.size() >= zip::kZip64Marker32) {
    return fail(ErrorCode::kUnsupported, "members of 4 GiB and more are not written");
  }
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
  archive_ += zip::local_header(packed.member);
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
  archive_ += zip::directory_of(members_, archive_.size());
  members_.clear();
  total_bytes_ = 0;
  std::string archive = std::exchange(archive_, {});
  HYPERMAP_TRY(check_archive_size(archive.size(), limits_));
  return archive;
} catch (const std::exception& exception) {
  return caught(exception, ErrorCode::kInvalidArgument, "the archive");
}

}  // namespace hypermap
