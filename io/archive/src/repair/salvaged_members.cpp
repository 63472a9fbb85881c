// SPDX-License-Identifier: BSD-3-Clause
#include "salvaged_members.hpp"

#include "hypermap/io/codec/zip_reader.hpp"

#include <utility>

namespace hypermap {

Result<std::string> SalvagedMembers::start_of(std::string_view name, std::size_t max_bytes) const {
  const auto found = contents_.find(name);
  if (found != contents_.end()) return found->second.substr(0, max_bytes);
  return fail(ErrorCode::kNotFound, "no member '" + printable(name) + "' in the archive");
}

Result<std::vector<OpaqueFile>> SalvagedMembers::rest(std::uint64_t /*max_bytes*/) const {
  std::vector<OpaqueFile> files;
  for (const auto& [name, bytes] : contents_) {
    if (taken(name)) continue;
    HYPERMAP_TRY(draw(name, bytes.size()));
    files.push_back({.name = name, .bytes = bytes});
  }
  return files;
}

std::vector<std::string> SalvagedMembers::taken_names() const {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : contents_) {
    if (taken(name)) names.push_back(name);
  }
  return names;
}

Result<void> SalvagedMembers::check_name(std::string_view name) const {
  return check_member_name(name);
}

Result<std::uint64_t> SalvagedMembers::size_of(std::string_view name) const {
  return contents_.find(name)->second.size();
}

Result<std::string> SalvagedMembers::read(std::string_view name, std::uint64_t max_bytes) const {
  const std::string& bytes = contents_.find(name)->second;
  if (bytes.size() <= max_bytes) return bytes;
  return fail(ErrorCode::kLimit,
              std::to_string(bytes.size()) + " bytes, the limit for an entry of its kind is " +
                  std::to_string(max_bytes));
}

}  // namespace hypermap
