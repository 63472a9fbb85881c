// SPDX-License-Identifier: BSD-3-Clause
// Members, configuration, layers and extensions at once. A zip that was changed at random fails its
// checksums, so most of what is read here is put together from records of members.
#include "fuzz_target.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/codec/zip_writer.hpp"
#include "image_oracle.hpp"
#include "targets.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace hypermap::fuzz {
namespace {

ArchiveLimits archive_limits() {
  ArchiveLimits limits;
  limits.zip = {.max_archive_bytes = 1U << 22U,
                .max_entries = 64,
                .max_entry_bytes = 1U << 22U,
                .max_total_bytes = 1U << 24U};
  limits.max_octree_voxels = 1U << 16U;
  return limits;
}

Result<MapArchive> map_of(std::string_view bytes) {
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, parse_archive(bytes, kFuzzSource, archive_limits()));
  return std::move(loaded.value);
}

/// The archive of the records of which `bytes` consist; the bytes themselves if they are a zip.
Result<std::string> archive_of(std::string_view bytes) {
  if (bytes.starts_with("PK")) return std::string(bytes);
  ZipWriter writer(archive_limits().zip);
  while (!bytes.empty()) {
    const std::string_view record = bytes.substr(0, bytes.find(kEndOfMember));
    bytes.remove_prefix(std::min(bytes.size(), record.size() + kEndOfMember.size()));
    const std::size_t name_end = std::min(record.find('\n'), record.size());
    const std::string_view content = record.substr(std::min(name_end + 1, record.size()));
    if (is_large_image(content)) return fail(ErrorCode::kLimit, "takes too long");
    HYPERMAP_TRY(writer.add(std::string(record.substr(0, name_end)), content));
  }
  return writer.finish();
}

}  // namespace

void fuzz_archive(std::string_view bytes) {
  const auto archive = archive_of(bytes);
  if (!archive) return;
  require_round_trip(
      *archive, map_of, [](const MapArchive& map) { return write_archive(map, archive_limits()); });
}

}  // namespace hypermap::fuzz
