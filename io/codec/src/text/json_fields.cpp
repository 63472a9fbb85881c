// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/json_fields.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace hypermap {

Result<void> expect_keys(const JsonNode& object, std::initializer_list<std::string_view> keys) {
  HYPERMAP_TRY(object.expect(JsonKind::kObject));
  for (const std::string_view key : keys) HYPERMAP_TRY(object.require(key));
  for (std::size_t i = 0; i < object.size(); ++i) {
    const JsonNode member = object.at(i);
    if (std::find(keys.begin(), keys.end(), member.key()) == keys.end())
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
  HYPERMAP_ASSIGN_OR_RETURN(const double value, node.number());
  const auto narrow = static_cast<float>(value);
  if (static_cast<double>(narrow) != value || !std::isfinite(narrow))
    return node.error(ErrorCode::kMalformedFile, "expected a number of single precision");
  return narrow;
}

}  // namespace hypermap
