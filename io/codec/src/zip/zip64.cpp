// SPDX-License-Identifier: BSD-3-Clause
#include "zip64.hpp"

#include "zip_format.hpp"

#include <string>
#include <utility>

namespace hypermap::zip {
namespace {

Unexpected malformed_wide(std::string what) {
  return fail(ErrorCode::kMalformedFile, "zip64: " + std::move(what));
}

/// Whether a number of the narrow record is the same as the wide one, or is left to it.
bool agrees(std::uint64_t narrow, std::uint64_t wide, std::uint64_t marker) {
  return narrow == wide || narrow == marker;
}

/// Where the wide end record begins, by its locator, which ends at `end_offset`.
Result<std::uint64_t> wide_end_offset(const ByteSource& source, std::uint64_t end_offset) {
  if (end_offset < kZip64LocatorBytes + kZip64EndBytes) {
    return malformed_wide("marked, without an end record of its own");
  }
  const std::uint64_t at = end_offset - kZip64LocatorBytes;
  HYPERMAP_ASSIGN_OR_RETURN(const std::string locator, source.read_at(at, kZip64LocatorBytes));
  if (get32(locator, 0) != kZip64LocatorSignature) {
    return malformed_wide("marked, without an end record of its own");
  }
  if (get32(locator, 4) != 0 || get32(locator, 16) != 1) {
    return malformed_wide("archive in several parts");
  }
  if (get64(locator, 8) != at - kZip64EndBytes) {
    return malformed_wide("its end record is not where the locator says, right before it");
  }
  return get64(locator, 8);
}

}  // namespace

Result<EndRecord> read_wide_end(const ByteSource& source,
                                std::uint64_t end_offset,
                                const EndRecord& narrow) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::uint64_t at, wide_end_offset(source, end_offset));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string record, source.read_at(at, kZip64EndBytes));
  if (get32(record, 0) != kZip64EndSignature || get64(record, 4) != kZip64EndBytes - 12) {
    return malformed_wide("no end record where the locator says one");
  }
  if (get32(record, 16) != 0 || get32(record, 20) != 0 || get64(record, 24) != get64(record, 32)) {
    return malformed_wide("archive in several parts");
  }
  const EndRecord wide{.num_entries = static_cast<std::size_t>(get64(record, 32)),
                       .directory_offset = get64(record, 48),
                       .directory_bytes = get64(record, 40),
                       .end_offset = at};
  const bool is_one = agrees(narrow.num_entries, wide.num_entries, kZip64Marker16) &&
                      agrees(narrow.directory_offset, wide.directory_offset, kZip64Marker32) &&
                      agrees(narrow.directory_bytes, wide.directory_bytes, kZip64Marker32);
  if (!is_one) return malformed_wide("its end record and the other one differ");
  return wide;
}

}  // namespace hypermap::zip
