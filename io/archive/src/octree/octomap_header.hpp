// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The text that stands before an OctoMap file's nodes.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// The id of our own type of tree.
inline constexpr std::string_view kSemanticOctreeId = "SemanticOcTree";

struct OctomapHeader {
  bool binary = false;  ///< `.bt`
  std::string id;
  std::uint64_t num_nodes = 0;
  double resolution_m = 0.0;
  std::size_t num_bytes = 0;  ///< Where the nodes begin.
  /// The line with the word `crc32`, its end included, within the bytes that were parsed. It is
  /// `# crc32 <8 digits>`, the checksum of all of the file but this line. Empty: there is none.
  std::string_view checksum_line = {};
  std::vector<Finding> findings;
};

/// Errors: kMalformedFile naming the field; kLimit for a header without end.
[[nodiscard]] Result<OctomapHeader> parse_octomap_header(std::string_view bytes);

/// Whether a file is what its checksum says, if it has one. Requires: the header of these bytes.
/// Errors: kMalformedFile, field "crc32".
[[nodiscard]] Result<void> check_octomap_checksum(std::string_view bytes,
                                                  const OctomapHeader& header);

/// Header, with a checksum, and nodes, in the memory of the nodes.
[[nodiscard]] std::string write_octomap_file(const OctomapHeader& header, std::string nodes);

}  // namespace hypermap
