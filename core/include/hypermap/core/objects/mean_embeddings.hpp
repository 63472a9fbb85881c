// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How an object looks to image networks: the mean over its detections, a network each.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/embedding.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// The mean of unit vectors of one model. Its length, at most 1, says how well they agree.
struct MeanEmbedding {
  std::string model;
  std::uint32_t count = 0;  ///< Unit vectors in it, at least 1; stays at the largest number.
  std::vector<float> mean;
  friend bool operator==(const MeanEmbedding&, const MeanEmbedding&) = default;
};

/// Errors: kInvalidArgument naming the field: a model's name, a count of 0, none or more than
/// kMaxEmbeddingDimension numbers, one that is not finite, a length above 1 by more than 1e-3.
/// Boundary: a mean of length 0 is one (two opposite vectors).
[[nodiscard]] Result<void> validate(const MeanEmbedding& embedding);

/// The means of an object. A value; without any it has no memory of its own.
class MeanEmbeddings {
 public:
  /// Stored ones, in any order. Errors: those of validate; kInvalidArgument for a model that is
  /// there twice; kLimit for more than kMaxEmbeddingModels.
  [[nodiscard]] static Result<MeanEmbeddings> restore(std::vector<MeanEmbedding> entries);

  /// Takes in one detection's embeddings: mean += (unit vector - mean) / count.
  ///
  /// Source: ours; the mean of unit vectors is the direction of the largest mean cosine.
  /// Requires: validate(embeddings). Boundary: of a model beyond the first kMaxEmbeddingModels, or
  /// of another dimension than its mean has, nothing is taken in: SemanticMapper refuses frames of
  /// such dimensions.
  /// Cost: linear in the numbers; nothing, and no allocation, when there are none.
  void observe(std::span<const Embedding> embeddings);

  /// As if all that `other` observed had been observed here, within the precision of a float: means
  /// weighted by their counts. Boundary: as of observe.
  void merge(const MeanEmbeddings& other);

  /// In ascending order of the models' names.
  [[nodiscard]] std::span<const MeanEmbedding> entries() const noexcept { return entries_; }
  /// Null when there is none.
  [[nodiscard]] const MeanEmbedding* find(std::string_view model) const;

  friend bool operator==(const MeanEmbeddings&, const MeanEmbeddings&) = default;

 private:
  void add(const MeanEmbedding& other);

  std::vector<MeanEmbedding> entries_;
};

}  // namespace hypermap
