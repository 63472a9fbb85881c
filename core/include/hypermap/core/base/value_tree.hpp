// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a configuration document says, as plain values: also unknown keys, so that it
/// survives load and save.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {

enum class ValueKind { kNull, kScalar, kList, kMap };

/// A scalar, list or map, nested. Map keys keep the order of the document.
///
/// A value: copy it, compare it. Two trees are equal when they say the same, whatever the lines.
/// Depth is bounded by whoever reads the document (64), so recursion over it is safe.
struct ValueTree {
  using Entry = std::pair<std::string, ValueTree>;

  ValueKind kind = ValueKind::kNull;
  std::string text = {};  ///< Of a scalar, escapes resolved, UTF-8.
  /// A scalar that is text although, bare, it would read as a number, a truth value or nothing;
  /// false for all other text, in quotes or not.
  bool quoted = false;
  std::vector<ValueTree> items = {};  ///< Of a list.
  std::vector<Entry> entries = {};    ///< Of a map; no key twice.
  int line = 0;                       ///< 1-based; 0 when it came from no document.

  /// The value of `key` in a map; none when it is absent or this is no map.
  [[nodiscard]] const ValueTree* find(std::string_view key) const;

  friend bool operator==(const ValueTree& a, const ValueTree& b);
};

[[nodiscard]] ValueTree make_list(std::vector<ValueTree> items);
[[nodiscard]] ValueTree make_map(std::vector<ValueTree::Entry> entries);
/// Whether `text` without quotes would read as a number, a truth value or nothing; also what
/// other readers take for one: `010`, `1_000`, `1:30`, `2020-01-01 12:00`. Boundary: all such text
/// can stand without quotes; what only starts like a number is text (`50%`, `1, 2`, `3 m: wide`).
[[nodiscard]] bool reads_as_no_text(std::string_view text);

/// Text, whatever it looks like.
[[nodiscard]] ValueTree make_text(std::string text);
/// A number, shortest form that reads back to the same value; NaN and infinities as YAML has them.
[[nodiscard]] ValueTree make_number(double number);
[[nodiscard]] ValueTree make_bool(bool value);

}  // namespace hypermap
