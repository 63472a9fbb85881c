// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/embedding.hpp"

#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/base/utf8.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace hypermap {
namespace {

constexpr unsigned char kFirstPrintable = 0x20;
constexpr unsigned char kDelete = 0x7f;

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < kFirstPrintable || byte == kDelete;
}

double dot(std::span<const float> a, std::span<const float> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += static_cast<double>(a[i]) * static_cast<double>(b[i]);
  }
  return sum;
}

}  // namespace

Result<void> validate_model_name(std::string_view name) {
  if (name.empty()) return fail(ErrorCode::kInvalidArgument, "must not be empty", "model");
  if (name.size() > kMaxModelNameBytes) {
    return fail(ErrorCode::kInvalidArgument,
                "must have at most " + std::to_string(kMaxModelNameBytes) + " bytes, has " +
                    std::to_string(name.size()),
                "model");
  }
  if (first_bad_utf8(name) < name.size() || std::ranges::any_of(name, is_control)) {
    return fail(ErrorCode::kInvalidArgument,
                "must be UTF-8 without control characters, is \"" + printable(name) + "\"",
                "model");
  }
  return {};
}

Result<void> validate_embedding_vector(std::span<const float> vector) {
  if (vector.empty() || vector.size() > kMaxEmbeddingDimension) {
    return fail(ErrorCode::kInvalidArgument,
                "must have 1 .. " + std::to_string(kMaxEmbeddingDimension) + " numbers, has " +
                    std::to_string(vector.size()),
                "vector");
  }
  const auto odd = std::ranges::find_if_not(vector, [](float v) { return std::isfinite(v); });
  if (odd != vector.end()) {
    return fail(ErrorCode::kInvalidArgument,
                "must be finite, number " + std::to_string(odd - vector.begin()) + " is " +
                    number_text(static_cast<double>(*odd)),
                "vector");
  }
  if (std::ranges::all_of(vector, [](float v) { return v == 0.0F; })) {
    return fail(ErrorCode::kInvalidArgument, "must have a direction, is all 0", "vector");
  }
  return {};
}

Result<void> validate(const Embedding& embedding) {
  HYPERMAP_TRY(validate_model_name(embedding.model));
  return validate_embedding_vector(embedding.vector);
}

Result<void> validate(std::span<const Embedding> embeddings) {
  if (embeddings.size() > kMaxEmbeddingModels) {
    return fail(ErrorCode::kLimit,
                "must be at most " + std::to_string(kMaxEmbeddingModels) + ", are " +
                    std::to_string(embeddings.size()),
                "embeddings");
  }
  for (std::size_t i = 0; i < embeddings.size(); ++i) {
    auto valid = validate(embeddings[i]);
    if (!valid) {
      valid.error().field = "embeddings[" + std::to_string(i) + "]." + valid.error().field;
      return valid;
    }
    const auto before = embeddings.first(i);
    const auto is_same = [&](const Embedding& one) { return one.model == embeddings[i].model; };
    if (std::ranges::any_of(before, is_same)) {
      return fail(
          ErrorCode::kInvalidArgument,
          "must name each model once, " + printable(embeddings[i].model) + " is there twice",
          "embeddings");
    }
  }
  return {};
}

Result<void> EmbeddingDimensions::add(std::string_view model, std::size_t dimension) {
  const auto known = of_model_.find(model);
  if (known != of_model_.end() && known->second == dimension) return {};
  if (known != of_model_.end()) {
    return fail(ErrorCode::kInvalidArgument,
                "of model \"" + printable(model) + "\" must have " + std::to_string(known->second) +
                    " numbers as before, has " + std::to_string(dimension),
                "vector");
  }
  if (of_model_.size() >= kMaxMapModels) {
    return fail(ErrorCode::kLimit,
                "at most " + std::to_string(kMaxMapModels) + " models are kept, \"" +
                    printable(model) + "\" is one more",
                "model");
  }
  of_model_.emplace(model, dimension);
  return {};
}

std::optional<std::size_t> EmbeddingDimensions::find(std::string_view model) const {
  const auto known = of_model_.find(model);
  return known == of_model_.end() ? std::nullopt : std::optional(known->second);
}

std::vector<float> unit_vector(std::span<const float> vector) {
  const double length = std::sqrt(dot(vector, vector));
  assert(length > 0.0);
  std::vector<float> unit;
  unit.reserve(vector.size());
  for (const float v : vector) {
    unit.push_back(static_cast<float>(static_cast<double>(v) / length));
  }
  return unit;
}

double cosine_similarity(std::span<const float> a, std::span<const float> b) {
  assert(a.size() == b.size());
  const double lengths = std::sqrt(dot(a, a)) * std::sqrt(dot(b, b));
  return lengths > 0.0 ? std::clamp(dot(a, b) / lengths, -1.0, 1.0) : 0.0;
}

}  // namespace hypermap
