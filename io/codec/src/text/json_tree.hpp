// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A parsed JSON document in two arrays: its text and its values.
#pragma once

#include "hypermap/io/codec/bounded_json.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// Piece of the text arena.
struct JsonSlice {
  std::uint32_t offset = 0;
  std::uint32_t size = 0;
};

struct JsonValue {
  JsonKind kind = JsonKind::kNull;
  bool truth = false;
  std::uint32_t line = 0;
  std::uint32_t parent = 0;
  JsonSlice key;
  JsonSlice text;      ///< Of strings, decoded, and of numbers, as written.
  JsonSlice children;  ///< Positions in `values`.
};

struct JsonNode::Tree {
  std::string name;
  std::string arena;
  std::vector<JsonValue> values;  ///< Children of one value lie together; the root is the last.

  [[nodiscard]] std::string_view view(JsonSlice slice) const {
    return std::string_view(arena).substr(slice.offset, slice.size);
  }
};

}  // namespace hypermap
