// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Typed values out of JSON nodes whose form is fixed: arrays of known length, objects whose keys
/// are all known.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/bounded_json.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {

/// Errors: kMalformedFile for a key that is neither in `keys` nor in `optional`, or one of `keys`
/// that is missing.
[[nodiscard]] Result<void> expect_keys(const JsonNode& object,
                                       std::initializer_list<std::string_view> keys,
                                       std::initializer_list<std::string_view> optional = {});
/// Errors: kMalformedFile unless it is an array of `size`.
[[nodiscard]] Result<void> expect_array(const JsonNode& array, std::size_t size);

[[nodiscard]] Result<double> number_at(const JsonNode& object, std::string_view key);

/// An integer that fits T.
template <class T>
[[nodiscard]] Result<T> integer_of(const JsonNode& node) {
  constexpr auto kMax = std::numeric_limits<T>::max();
  const std::int64_t high = std::cmp_greater(kMax, std::numeric_limits<std::int64_t>::max())
                                ? std::numeric_limits<std::int64_t>::max()
                                : static_cast<std::int64_t>(kMax);
  HYPERMAP_ASSIGN_OR_RETURN(
      const std::int64_t value,
      node.integer(static_cast<std::int64_t>(std::numeric_limits<T>::min()), high));
  return static_cast<T>(value);
}
template <class T>
[[nodiscard]] Result<T> integer_at(const JsonNode& object, std::string_view key) {
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode node, object.require(key));
  return integer_of<T>(node);
}

/// The number of single precision that is nearest to the text. Errors: also kMalformedFile beyond
/// the largest one.
[[nodiscard]] Result<float> float_of(const JsonNode& node);

template <int Size>
[[nodiscard]] Result<Eigen::Matrix<double, Size, 1>> vector_of(const JsonNode& node) {
  HYPERMAP_TRY(expect_array(node, Size));
  Eigen::Matrix<double, Size, 1> vector;
  for (int i = 0; i < Size; ++i) {
    HYPERMAP_ASSIGN_OR_RETURN(vector(i), node.at(static_cast<std::size_t>(i)).number());
  }
  return vector;
}

/// `parse(element)` for each element of an array.
template <class Parse>
[[nodiscard]] auto list_of(const JsonNode& node, const Parse& parse)
    -> Result<std::vector<typename decltype(parse(node))::value_type>> {
  HYPERMAP_TRY(node.expect(JsonKind::kArray));
  std::vector<typename decltype(parse(node))::value_type> list;
  list.reserve(node.size());
  for (std::size_t i = 0; i < node.size(); ++i) {
    HYPERMAP_ASSIGN_OR_RETURN(auto item, parse(node.at(i)));
    list.push_back(std::move(item));
  }
  return list;
}
template <class Parse>
[[nodiscard]] auto list_at(const JsonNode& object, std::string_view key, const Parse& parse)
    -> Result<std::vector<typename decltype(parse(object))::value_type>> {
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode node, object.require(key));
  return list_of(node, parse);
}

/// A value that the library validated; its error refers to this node.
template <class T>
[[nodiscard]] Result<T> validated(const JsonNode& node, Result<T> value) {
  if (value) return value;
  const Error& error = value.error();
  return node.error(ErrorCode::kMalformedFile,
                    error.field.empty() ? error.what : error.field + " " + error.what);
}

}  // namespace hypermap
