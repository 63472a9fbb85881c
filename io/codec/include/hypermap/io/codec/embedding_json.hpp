// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Embeddings in JSON.
#pragma once

#include "hypermap/core/segmentation/embedding.hpp"
#include "hypermap/io/codec/bounded_json.hpp"

#include <string>
#include <vector>

namespace hypermap {

/// A list of numbers, or a text: base64 of floats of 32 bits, little endian.
/// Errors: kMalformedFile at what is no such vector, or breaks a rule of
/// `validate_embedding_vector`.
[[nodiscard]] Result<std::vector<float>> parse_embedding_vector(const JsonNode& node);

/// `{"model": "...", "vector": ...}`; other keys are not looked at. Errors: kMalformedFile.
[[nodiscard]] Result<Embedding> parse_embedding(const JsonNode& node);

/// What `parse_embedding` reads back bit by bit: the vector in base64.
[[nodiscard]] std::string embedding_json(const Embedding& embedding);

}  // namespace hypermap
