// SPDX-License-Identifier: BSD-3-Clause
// Members that are salvaged are written and salvaged again.
#include "fuzz_target.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/zip_salvage.hpp"
#include "hypermap/io/codec/zip_writer.hpp"
#include "targets.hpp"

#include <map>
#include <utility>

namespace hypermap::fuzz {
namespace {

using SalvagedByName = std::map<std::string, std::string>;

constexpr ZipLimits kSalvageLimits{.max_archive_bytes = 1U << 20U,
                                   .max_entries = 64,
                                   .max_entry_bytes = 1U << 22U,
                                   .max_total_bytes = 1U << 24U};

Result<SalvagedByName> salvaged_from(std::string_view bytes) {
  HYPERMAP_ASSIGN_OR_RETURN(ZipSalvage salvage, salvage_zip(*view_bytes(bytes), kSalvageLimits));
  SalvagedByName members;
  for (SalvagedMember& member : salvage.members) {
    require(members.emplace(member.name, std::move(member.bytes)).second, "no name is there twice");
  }
  if (members.empty()) return fail(ErrorCode::kMalformedFile, "nothing is left");
  return members;
}

Result<std::string> zip_of_salvaged(const SalvagedByName& members) {
  ZipWriter writer(kSalvageLimits);
  for (const auto& [name, content] : members) HYPERMAP_TRY(writer.add(name, content));
  return writer.finish();
}

}  // namespace

void fuzz_salvage(std::string_view bytes) {
  require_round_trip(bytes, salvaged_from, zip_of_salvaged);
}

}  // namespace hypermap::fuzz
