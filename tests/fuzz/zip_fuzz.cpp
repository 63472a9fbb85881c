// SPDX-License-Identifier: BSD-3-Clause
// Members that are read are written and read again.
#include "fuzz_target.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/zip_reader.hpp"
#include "hypermap/io/codec/zip_writer.hpp"
#include "targets.hpp"

#include <map>
#include <utility>

namespace hypermap::fuzz {
namespace {

using Members = std::map<std::string, std::string>;

constexpr ZipLimits kZipLimits{.max_archive_bytes = 1U << 20U,
                               .max_entries = 64,
                               .max_entry_bytes = 1U << 22U,
                               .max_total_bytes = 1U << 24U};

Result<Members> members_of(std::string_view bytes) {
  HYPERMAP_ASSIGN_OR_RETURN(const ZipReader zip, ZipReader::create(view_bytes(bytes), kZipLimits));
  Members members;
  for (const ZipMember& member : zip.members()) {
    HYPERMAP_ASSIGN_OR_RETURN(std::string content,
                              zip.read(member.name, kZipLimits.max_entry_bytes));
    require(content.size() == member.num_bytes, "a member has the size that is said");
    require(members.emplace(member.name, std::move(content)).second, "no name is there twice");
  }
  return members;
}

Result<std::string> zip_of(const Members& members) {
  ZipWriter writer(kZipLimits);
  for (const auto& [name, content] : members) HYPERMAP_TRY(writer.add(name, content));
  return writer.finish();
}

}  // namespace

void fuzz_zip(std::string_view bytes) {
  require_round_trip(bytes, members_of, zip_of);
}

}  // namespace hypermap::fuzz
