// SPDX-License-Identifier: BSD-3-Clause
#include "archive_members.hpp"

#include "hypermap/io/codec/byte_source.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace hypermap {

Unexpected ArchiveMembers::refusal(const std::string& owner, std::string what) const {
  Error error{.code = ErrorCode::kMalformedFile, .what = std::move(what)};
  error.file = file_;
  error.field = owner;
  return tl::make_unexpected(std::move(error));
}

Result<void> ArchiveMembers::check(std::string_view name, const std::string& owner) const {
  const auto checked = check_name(name);
  if (checked) return {};
  if (checked.error().code == ErrorCode::kIo)
    return tl::make_unexpected(with_source(checked.error(), source_of(name)));
  return refusal(owner, "leads out of the archive or is no file name: " + checked.error().what);
}

Result<std::string> ArchiveMembers::take(std::string_view name,
                                         const std::string& owner,
                                         std::uint64_t max_bytes) {
  HYPERMAP_TRY(check(name, owner));
  if (const auto other = owner_of_.find(name); other != owner_of_.end())
    return refusal(owner, "names '" + printable(name) + "', which belongs to " + other->second);
  if (!contains(name)) return refusal(owner, "names '" + printable(name) + "', which is not there");
  HYPERMAP_TRY(budget_.check_stop());
  owner_of_.emplace(name, owner);
  auto content = read(name, max_bytes);
  if (!content)
    return tl::make_unexpected(with_source(std::move(content).error(), source_of(name)));
  return content;
}

Result<std::string> ArchiveMembers::take_opaque(std::string_view name,
                                                const std::string& owner,
                                                std::uint64_t max_bytes) {
  if (contains(name)) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::uint64_t num_bytes, size_of(name));
    HYPERMAP_TRY(draw(name, num_bytes));
  }
  return take(name, owner, max_bytes);
}

Result<void> ArchiveMembers::draw(std::string_view name, std::uint64_t num_bytes) const {
  auto drawn = budget_.draw_opaque_bytes(num_bytes);
  if (!drawn) return tl::make_unexpected(with_source(std::move(drawn).error(), source_of(name)));
  return {};
}

Result<std::vector<OpaqueFile>> ZipMembers::rest(std::uint64_t max_bytes) const {
  std::vector<const ZipMember*> members;
  for (const ZipMember& member : zip_.members())
    if (!taken(member.name)) members.push_back(&member);
  std::sort(members.begin(), members.end(), [](const ZipMember* a, const ZipMember* b) {
    return a->name < b->name;
  });
  for (const ZipMember* member : members) HYPERMAP_TRY(draw(member->name, member->num_bytes));
  std::vector<OpaqueFile> files;
  files.reserve(members.size());
  for (const ZipMember* member : members) {
    auto bytes = read(member->name, max_bytes);
    if (!bytes)
      return tl::make_unexpected(with_source(std::move(bytes).error(), source_of(member->name)));
    files.push_back({.name = member->name, .bytes = std::move(*bytes)});
  }
  return files;
}

bool FolderMembers::contains(std::string_view name) const {
  std::error_code ignored;
  // What cannot be looked at is not absent: reading it says why.
  return std::filesystem::status(folder_ / name, ignored).type() !=
         std::filesystem::file_type::not_found;
}

Result<std::string> FolderMembers::start_of(std::string_view name, std::size_t max_bytes) const {
  HYPERMAP_TRY(check_name(name));
  HYPERMAP_ASSIGN_OR_RETURN(const auto source,
                            open_file(folder_ / name, std::numeric_limits<std::uint64_t>::max()));
  const auto num_bytes = std::min<std::uint64_t>(source->size(), max_bytes);
  return source->read_at(0, static_cast<std::size_t>(num_bytes));
}

Result<void> FolderMembers::check_name(std::string_view name) const {
  if (!name.empty() && name.find('\0') == std::string_view::npos)
    return check_reach(reach_, folder_, name);
  return fail(ErrorCode::kMalformedFile, "'" + printable(name) + "'");
}

Result<std::uint64_t> FolderMembers::size_of(std::string_view name) const {
  std::error_code error;
  const std::uint64_t num_bytes = std::filesystem::file_size(folder_ / name, error);
  if (!error) return num_bytes;
  return Unexpected(
      with_source({.code = ErrorCode::kIo, .what = error.message()}, source_of(name)));
}

Result<std::string> FolderMembers::read(std::string_view name, std::uint64_t max_bytes) const {
  return read_file(folder_ / name, max_bytes);
}

}  // namespace hypermap
