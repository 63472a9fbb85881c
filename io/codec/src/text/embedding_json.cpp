// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/embedding_json.hpp"

#include "hypermap/io/codec/base64.hpp"
#include "hypermap/io/codec/number_bytes.hpp"

#include <string>

namespace hypermap {
namespace {

Unexpected at_node(const JsonNode& node, const Error& error) {
  const bool is_limit = error.code == ErrorCode::kLimit;
  return node.error(is_limit ? ErrorCode::kLimit : ErrorCode::kMalformedFile, error.what);
}

Result<std::vector<float>> listed_numbers(const JsonNode& node) {
  HYPERMAP_TRY(node.expect(JsonKind::kArray));
  if (node.size() > kMaxEmbeddingDimension) {
    return node.error(ErrorCode::kMalformedFile,
                      "must have 1 .. " + std::to_string(kMaxEmbeddingDimension) +
                          " numbers, has " + std::to_string(node.size()));
  }
  std::vector<float> numbers;
  numbers.reserve(node.size());
  for (std::size_t i = 0; i < node.size(); ++i) {
    HYPERMAP_ASSIGN_OR_RETURN(const double number, node.at(i).number());
    numbers.push_back(rounded_to_float(number));
  }
  return numbers;
}

}  // namespace

Result<std::vector<float>> parse_embedding_vector(const JsonNode& node) {
  std::vector<float> numbers;
  if (node.is(JsonKind::kString)) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string_view text, node.string());
    const auto bytes = decode_base64(text);
    if (!bytes) return at_node(node, bytes.error());
    const auto floats = floats_of_bytes(*bytes);
    if (!floats) return at_node(node, floats.error());
    numbers = *floats;
  } else {
    HYPERMAP_ASSIGN_OR_RETURN(numbers, listed_numbers(node));
  }
  if (const auto valid = validate_embedding_vector(numbers); !valid) {
    return at_node(node, valid.error());
  }
  return numbers;
}

Result<Embedding> parse_embedding(const JsonNode& node) {
  HYPERMAP_TRY(node.expect(JsonKind::kObject));
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode model, node.require("model"));
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode vector, node.require("vector"));
  Embedding out;
  HYPERMAP_ASSIGN_OR_RETURN(out.model, model.string());
  if (const auto valid = validate_model_name(out.model); !valid) {
    return at_node(model, valid.error());
  }
  HYPERMAP_ASSIGN_OR_RETURN(out.vector, parse_embedding_vector(vector));
  return out;
}

std::string embedding_json(const Embedding& embedding) {
  return "{\"model\": " + json_quoted(embedding.model) + ", \"vector\": \"" +
         encode_base64(bytes_of_floats(embedding.vector)) + "\"}";
}

}  // namespace hypermap
