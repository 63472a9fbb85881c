// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Text becomes the tree of a JSON document.
#pragma once

#include "json_tree.hpp"

#include <string_view>

namespace hypermap {

/// The one that may fill the tree of nodes.
class JsonParser {
 public:
  using Tree = JsonNode::Tree;
  /// Errors: those of JsonDocument::parse but for the size of the text. Requires: an empty tree.
  [[nodiscard]] static Result<void> parse(std::string_view text,
                                          Tree& tree,
                                          const JsonLimits& limits,
                                          int first_line);
};

}  // namespace hypermap
