// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a damaged zip file still holds.
///
/// Each member stands behind a header of its own, so that members are found although the directory
/// at the file's end is cut or wrong. ZipReader refuses such a file as a whole.
///
/// Source: PKWARE APPNOTE.TXT 6.3, sections 4.3.7 and 4.3.9.
/// Scope: as ZipReader.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/zip_reader.hpp"

#include <string>
#include <vector>

namespace hypermap {

/// A member whose content fits its size and its CRC-32.
struct SalvagedMember {
  std::string name;
  std::string bytes;
  friend bool operator==(const SalvagedMember&, const SalvagedMember&) = default;
};

struct ZipSalvage {
  std::vector<SalvagedMember> members;  ///< In the order of the file, no name twice.
  /// Why members are not among these, in the order of the file; `entry` names each.
  std::vector<Error> lost;
};

/// Looks for members from the file's start to its end, by their local headers alone. One that a
/// later version of the same name follows is kept; the later one is lost. What lies within a member
/// is none.
///
/// Errors: kMalformedFile when there is no local header; kLimit for `max_archive_bytes`, for more
/// local headers than `max_entries`, and for members, sound or not, of together more than
/// `max_total_bytes`; kIo; kOutOfMemory; kInterrupted. Limits on one member lose that one.
/// Cost: two passes over the file at most, and what its members inflate to.
[[nodiscard]] Result<ZipSalvage> salvage_zip(const ByteSource& source,
                                             const ZipLimits& limits = {},
                                             const LoadBudget& budget = {});

}  // namespace hypermap
