// SPDX-License-Identifier: BSD-3-Clause
#include "archive_members.hpp"

#include "hypermap/io/codec/byte_source.hpp"

#include <algorithm>
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
  return refusal(owner, "leads out of the archive or is no file name: " + checked.error().what);
}

Result<std::string> ArchiveMembers::take(std::string_view name,
                                         const std::string& owner,
                                         std::uint64_t max_bytes) {
  HYPERMAP_TRY(check(name, owner));
  if (const auto other = owner_of_.find(name); other != owner_of_.end())
    return refusal(owner, "names '" + printable(name) + "', which belongs to " + other->second);
  if (!contains(name)) return refusal(owner, "names '" + printable(name) + "', which is not there");
  owner_of_.emplace(name, owner);
  auto content = read(name, max_bytes);
  if (!content)
    return tl::make_unexpected(with_source(std::move(content).error(), source_of(name)));
  return content;
}

Result<std::vector<OpaqueFile>> ZipMembers::rest(std::uint64_t max_bytes) const {
  std::vector<OpaqueFile> files;
  for (const ZipMember& member : zip_.members()) {
    if (taken(member.name)) continue;
    auto bytes = zip_.read(member.name, max_bytes);
    if (!bytes)
      return tl::make_unexpected(with_source(std::move(bytes).error(), source_of(member.name)));
    files.push_back({.name = member.name, .bytes = std::move(*bytes)});
  }
  std::sort(files.begin(), files.end(), [](const OpaqueFile& a, const OpaqueFile& b) {
    return a.name < b.name;
  });
  return files;
}

bool FolderMembers::contains(std::string_view name) const {
  std::error_code ignored;
  // What cannot be looked at is not absent: reading it says why.
  return std::filesystem::status(folder_ / name, ignored).type() !=
         std::filesystem::file_type::not_found;
}

Result<void> FolderMembers::check_name(std::string_view name) const {
  if (!name.empty() && name.find('\0') == std::string_view::npos) return {};
  return fail(ErrorCode::kMalformedFile, "'" + printable(name) + "'");
}

Result<std::string> FolderMembers::read(std::string_view name, std::uint64_t max_bytes) const {
  return read_file(folder_ / name, max_bytes);
}

}  // namespace hypermap
