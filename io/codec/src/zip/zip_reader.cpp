// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/zip_reader.hpp"

#include "deflate.hpp"
#include "zip_content.hpp"
#include "zip_directory.hpp"

#include <algorithm>
#include <utility>

namespace hypermap {
namespace {

Error in_member(Error error, const ZipMember& member) {
  error.entry = member.name;
  return error;
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

const ZipMember* ZipReader::find(std::string_view name) const {
  const auto found = index_of_.find(name);
  return found == index_of_.end() ? nullptr : &members_[found->second];
}

Result<std::string> ZipReader::read_start(std::string_view name, std::size_t max_bytes) const {
  // Packed bytes are hardly more than the content where it does not shrink.
  constexpr std::size_t kPackingBytes = 1024;
  const ZipMember* const member = find(name);
  if (member == nullptr)
    return fail(ErrorCode::kNotFound, "no member '" + printable(name) + "' in the archive");
  const std::size_t wanted = member->deflated ? max_bytes + kPackingBytes : max_bytes;
  const auto num_bytes = std::min<std::uint64_t>(member->num_packed_bytes, wanted);
  HYPERMAP_ASSIGN_OR_RETURN(
      std::string packed,
      source_->read_at(member->data_offset, static_cast<std::size_t>(num_bytes)));
  if (member->deflated) return unpack_start(packed, max_bytes);
  return packed;
}

Result<std::string> ZipReader::read(std::string_view name,
                                    std::uint64_t max_bytes,
                                    const LoadBudget& budget) const {
  const ZipMember* const found = find(name);
  if (found == nullptr)
    return fail(ErrorCode::kNotFound, "no member '" + printable(name) + "' in the archive");
  const ZipMember& member = *found;
  if (member.num_bytes > max_bytes)
    return tl::make_unexpected(in_member(
        {.code = ErrorCode::kLimit,
         .what = std::to_string(member.num_bytes) +
                 " bytes, the limit for an entry of its kind is " + std::to_string(max_bytes)},
        member));
  auto content = zip::content_of(*source_, member, budget);
  if (!content) return tl::make_unexpected(in_member(std::move(content).error(), member));
  return content;
}

}  // namespace hypermap
