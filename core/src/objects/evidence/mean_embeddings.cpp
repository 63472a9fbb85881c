// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/mean_embeddings.hpp"

#include "hypermap/core/base/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hypermap {
namespace {

constexpr double kMaxExcess = 1e-3;

bool by_model(const MeanEmbedding& a, const MeanEmbedding& b) {
  return a.model < b.model;
}

std::uint32_t sum_of_counts(std::uint32_t a, std::uint32_t b) {
  const std::uint64_t sum = std::uint64_t{a} + std::uint64_t{b};
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>(sum, std::numeric_limits<std::uint32_t>::max()));
}

/// Moves `mean` towards `other`, which stands for `other_count` of all unit vectors.
void weigh_in(MeanEmbedding& mean, std::span<const float> other, std::uint32_t other_count) {
  const double total = static_cast<double>(mean.count) + static_cast<double>(other_count);
  const double share = static_cast<double>(other_count) / total;
  for (std::size_t i = 0; i < other.size(); ++i) {
    const auto old = static_cast<double>(mean.mean[i]);
    mean.mean[i] = static_cast<float>(old + share * (static_cast<double>(other[i]) - old));
  }
  mean.count = sum_of_counts(mean.count, other_count);
}

}  // namespace

Result<void> validate(const MeanEmbedding& embedding) {
  HYPERMAP_TRY(validate_model_name(embedding.model));
  if (embedding.count == 0) return fail(ErrorCode::kInvalidArgument, "must be > 0, is 0", "count");
  if (embedding.mean.empty() || embedding.mean.size() > kMaxEmbeddingDimension) {
    return fail(ErrorCode::kInvalidArgument,
                "must have 1 .. " + std::to_string(kMaxEmbeddingDimension) + " numbers, has " +
                    std::to_string(embedding.mean.size()),
                "mean");
  }
  double square = 0.0;
  for (const float v : embedding.mean) square += static_cast<double>(v) * static_cast<double>(v);
  if (std::sqrt(square) <= 1.0 + kMaxExcess) return {};  // false for NaN
  return fail(ErrorCode::kInvalidArgument,
              "must have a length of at most 1, has " + number_text(std::sqrt(square)),
              "mean");
}

Result<MeanEmbeddings> MeanEmbeddings::restore(std::vector<MeanEmbedding> entries) {
  if (entries.size() > kMaxEmbeddingModels) {
    return fail(ErrorCode::kLimit,
                "must be of at most " + std::to_string(kMaxEmbeddingModels) + " models, are of " +
                    std::to_string(entries.size()),
                "embeddings");
  }
  for (const MeanEmbedding& entry : entries) HYPERMAP_TRY(validate(entry));
  std::sort(entries.begin(), entries.end(), by_model);
  const auto same = std::adjacent_find(
      entries.begin(), entries.end(), [](const auto& a, const auto& b) { return !by_model(a, b); });
  if (same != entries.end()) {
    return fail(ErrorCode::kInvalidArgument,
                "must name each model once, " + printable(same->model) + " is there twice",
                "model");
  }
  MeanEmbeddings out;
  out.entries_ = std::move(entries);
  return out;
}

void MeanEmbeddings::add(const MeanEmbedding& other) {
  const auto at = std::lower_bound(entries_.begin(), entries_.end(), other, by_model);
  if (at != entries_.end() && at->model == other.model) {
    if (at->mean.size() == other.mean.size()) weigh_in(*at, other.mean, other.count);
  } else if (entries_.size() < kMaxEmbeddingModels) {
    entries_.insert(at, other);
  }
}

void MeanEmbeddings::observe(std::span<const Embedding> embeddings) {
  for (const Embedding& seen : embeddings) {
    add({.model = seen.model, .count = 1, .mean = unit_vector(seen.vector)});
  }
}

void MeanEmbeddings::merge(const MeanEmbeddings& other) {
  for (const MeanEmbedding& entry : other.entries_) add(entry);
}

const MeanEmbedding* MeanEmbeddings::find(std::string_view model) const {
  const auto found = std::ranges::find(entries_, model, &MeanEmbedding::model);
  return found == entries_.end() ? nullptr : &*found;
}

}  // namespace hypermap
