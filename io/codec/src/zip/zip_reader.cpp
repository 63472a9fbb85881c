// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/zip_reader.hpp"

#include "deflate.hpp"
#include "zip_directory.hpp"

#include <utility>

namespace hypermap {
namespace {

Error in_member(Error error, const ZipMember& member) {
  error.entry = member.name;
  return error;
}

Result<std::string> content_of(const ByteSource& source, const ZipMember& member) {
  HYPERMAP_ASSIGN_OR_RETURN(
      std::string packed,
      source.read_at(member.data_offset, static_cast<std::size_t>(member.num_packed_bytes)));
  std::string content;
  if (member.deflated) {
    HYPERMAP_ASSIGN_OR_RETURN(content, unpack(packed, member.num_bytes));
  } else {
    content = std::move(packed);
  }
  if (crc32_of(content) != member.crc32)
    return fail(ErrorCode::kMalformedFile, "CRC-32 of the content is wrong");
  return content;
}

}  // namespace

ZipReader::ZipReader(std::shared_ptr<const ByteSource> source, std::vector<ZipMember> members)
    : source_(std::move(source)), members_(std::move(members)) {
  for (std::size_t i = 0; i < members_.size(); ++i) index_of_.emplace(members_[i].name, i);
}

Result<ZipReader> ZipReader::create(std::shared_ptr<const ByteSource> source,
                                    const ZipLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const zip::EndRecord end, zip::read_end_record(*source, limits));
  HYPERMAP_ASSIGN_OR_RETURN(std::vector<zip::Entry> entries,
                            zip::read_directory(*source, end, limits));
  HYPERMAP_TRY(zip::read_local_headers(*source, end, entries));
  std::vector<ZipMember> members;
  for (zip::Entry& entry : entries)
    if (!entry.is_folder) members.push_back(std::move(entry.member));
  return ZipReader(std::move(source), std::move(members));
}

Result<std::string> ZipReader::read(std::string_view name, std::uint64_t max_bytes) const {
  const auto found = index_of_.find(name);
  if (found == index_of_.end())
    return fail(ErrorCode::kNotFound, "no member '" + printable(name) + "' in the archive");
  const ZipMember& member = members_[found->second];
  if (member.num_bytes > max_bytes)
    return tl::make_unexpected(in_member(
        {.code = ErrorCode::kLimit,
         .what = std::to_string(member.num_bytes) +
                 " bytes, the limit for an entry of its kind is " + std::to_string(max_bytes)},
        member));
  auto content = content_of(*source_, member);
  if (!content) return tl::make_unexpected(in_member(std::move(content).error(), member));
  return content;
}

}  // namespace hypermap
