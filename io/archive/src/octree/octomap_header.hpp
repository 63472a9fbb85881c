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

struct OctomapHeader {
  bool binary = false;  ///< `.bt`
  std::string id;
  std::uint64_t num_nodes = 0;
  double resolution_m = 0.0;
  std::size_t num_bytes = 0;  ///< Where the nodes begin.
  std::vector<Finding> findings;
};

/// Errors: kMalformedFile naming the field; kLimit for a header without end.
[[nodiscard]] Result<OctomapHeader> parse_octomap_header(std::string_view bytes);

[[nodiscard]] std::string write_octomap_header(const OctomapHeader& header);

}  // namespace hypermap
