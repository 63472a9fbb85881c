// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What an image network says of a detection beyond its classes: a point in the network's own
/// feature space, to be compared with others of the same network.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// Bounds of an embedding. Source: ours.
inline constexpr std::size_t kMaxEmbeddingDimension = 4096;
inline constexpr std::size_t kMaxModelNameBytes = 256;
/// So many networks may describe one detection, and one object.
inline constexpr std::size_t kMaxEmbeddingModels = 4;
/// So many networks may describe what a map holds.
inline constexpr std::size_t kMaxMapModels = 64;

/// A vector that a network gave, and which network that was. Its length says nothing: embeddings
/// are compared by their directions.
struct Embedding {
  std::string model;  ///< Free text, as "clip-vit-b32"; vectors of one name are comparable.
  std::vector<float> vector;
  friend bool operator==(const Embedding&, const Embedding&) = default;
};

/// Errors: kInvalidArgument, field `model`: empty, longer than kMaxModelNameBytes, no UTF-8 or with
/// a control character.
[[nodiscard]] Result<void> validate_model_name(std::string_view name);

/// Whether the numbers have a direction. Errors: kInvalidArgument, field `vector`: none or more
/// than kMaxEmbeddingDimension, one that is not finite, all 0.
[[nodiscard]] Result<void> validate_embedding_vector(std::span<const float> vector);

/// Errors: those of both above.
[[nodiscard]] Result<void> validate(const Embedding& embedding);

/// Of one detection or frame: each of them, at most kMaxEmbeddingModels, each model once.
/// Errors: kInvalidArgument, kLimit; field `embeddings`.
[[nodiscard]] Result<void> validate(std::span<const Embedding> embeddings);

/// How many numbers the vectors of each model have: what the first one has, all others must have.
/// A value; without any it has no memory of its own.
class EmbeddingDimensions {
 public:
  /// Errors: kInvalidArgument naming the model and both dimensions when it has another one; kLimit
  /// for a model beyond kMaxMapModels. Nothing has changed then.
  Result<void> add(std::string_view model, std::size_t dimension);
  /// None of a model that was never added.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view model) const;
  /// In ascending order of the names.
  [[nodiscard]] const std::map<std::string, std::size_t, std::less<>>& models() const noexcept {
    return of_model_;
  }

 private:
  std::map<std::string, std::size_t, std::less<>> of_model_;
};

/// The direction of a vector: of length 1 within the precision of a float.
/// Requires: a valid vector. Cost: one allocation.
[[nodiscard]] std::vector<float> unit_vector(std::span<const float> vector);

/// The cosine of the angle between two vectors, in -1 .. 1, summed in double in the order of the
/// numbers: the same on every machine. Boundary: 0 when one of them is all 0.
/// Requires: equal sizes, finite numbers.
[[nodiscard]] double cosine_similarity(std::span<const float> a, std::span<const float> b);

}  // namespace hypermap
