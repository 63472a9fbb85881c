// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/json_fields.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <system_error>

namespace hypermap {

Result<void> expect_keys(const JsonNode& object,
                         std::initializer_list<std::string_view> keys,
                         std::initializer_list<std::string_view> optional) {
  const auto is_in = [](std::initializer_list<std::string_view> names, std::string_view key) {
    return std::find(names.begin(), names.end(), key) != names.end();
  };
  HYPERMAP_TRY(object.expect(JsonKind::kObject));
  for (const std::string_view key : keys) HYPERMAP_TRY(object.require(key));
  for (std::size_t i = 0; i < object.size(); ++i) {
    const JsonNode member = object.at(i);
    if (!is_in(keys, member.key()) && !is_in(optional, member.key()))
      return member.error(ErrorCode::kMalformedFile, "unknown key");
  }
  return {};
}

Result<void> expect_array(const JsonNode& array, std::size_t size) {
  HYPERMAP_TRY(array.expect(JsonKind::kArray));
  if (array.size() != size)
    return array.error(
        ErrorCode::kMalformedFile,
        "has " + std::to_string(array.size()) + " elements, expected " + std::to_string(size));
  return {};
}

Result<double> number_at(const JsonNode& object, std::string_view key) {
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode node, object.require(key));
  return node.number();
}

Result<float> float_of(const JsonNode& node) {
  HYPERMAP_TRY(node.number());
  const std::string_view text = node.number_text();
  float value = 0.0F;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc() || !std::isfinite(value))
    return node.error(ErrorCode::kMalformedFile, "expected a number of single precision");
  return value;
}

}  // namespace hypermap
