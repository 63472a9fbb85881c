// SPDX-License-Identifier: BSD-3-Clause
// Nodes of a topometric graph as lines of JSON.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/supercells/topometric_graph.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

[[nodiscard]] std::string lines_of_nodes(const std::vector<SupercellNode>& nodes);

/// Errors: kMalformedFile with the line for a missing or unknown key, a wrong type, or when there
/// are not `count` lines; kLimit.
[[nodiscard]] Result<std::vector<SupercellNode>> nodes_of_lines(std::string_view text,
                                                                std::size_t count);

}  // namespace hypermap
