// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// JSON put together from parts that are JSON already.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace hypermap {

/// `{"key":value,...}` in the given order. Requires: keys need no escapes.
[[nodiscard]] inline std::string json_object(
    std::initializer_list<std::pair<std::string_view, std::string>> members) {
  std::string text = "{";
  for (const auto& [key, value] : members) {
    if (text.size() > 1) text += ',';
    text += '"';
    text += key;
    text += "\":";
    text += value;
  }
  return text + "}";
}

/// `[...]` with `json_of(item)` for each item.
template <class Items, class JsonOf>
[[nodiscard]] std::string json_array(const Items& items, const JsonOf& json_of) {
  std::string text = "[";
  for (const auto& item : items) {
    if (text.size() > 1) text += ',';
    text += json_of(item);
  }
  return text + "]";
}

}  // namespace hypermap
