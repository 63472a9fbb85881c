// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/detection.hpp"

#include "hypermap/core/base/number_text.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace hypermap {
namespace {

bool by_id(const ClassEvidence& a, const ClassEvidence& b) {
  return a.id < b.id;
}

bool by_probability_then_low_id(const ClassEvidence& a, const ClassEvidence& b) {
  return a.probability != b.probability ? a.probability < b.probability : b.id < a.id;
}

constexpr std::uint32_t kMaxClassId = 65534;
constexpr double kMaxSumError = 1e-3;

bool is_probability(Probability p) {
  return p.value() >= 0.0 && p.value() <= 1.0;  // false for NaN
}

}  // namespace

Result<void> validate_class_scores(std::span<const ClassEvidence> scores) {
  double sum = 0.0;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const auto& [id, probability] = scores[i];
    if (!is_probability(probability)) {
      return fail(ErrorCode::kInvalidArgument,
                  "must be in 0..1, one is " + number_text(probability.value()),
                  "class_scores");
    }
    if (id.value > kMaxClassId || (i > 0 && !(scores[i - 1].id < id))) {
      return fail(ErrorCode::kInvalidArgument,
                  "ids must ascend and be below 65535, one is " + std::to_string(id.value),
                  "class_scores");
    }
    sum += probability.value();
  }
  if (std::abs(sum - 1.0) <= kMaxSumError) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must sum to 1 within 0.001, is " + number_text(sum),
              "class_scores");
}

Result<void> validate(const Detection& detection) {
  const PixelBox& box = detection.box_px;
  const bool is_finite = std::isfinite(box.u_min_px) && std::isfinite(box.v_min_px) &&
                         std::isfinite(box.u_max_px) && std::isfinite(box.v_max_px);
  if (!is_finite) return fail(ErrorCode::kInvalidArgument, "must be finite", "box_px");
  if (box.width_px() < 0.0 || box.height_px() < 0.0) {
    return fail(ErrorCode::kInvalidArgument,
                "must have sides >= 0, are " + number_text(box.width_px()) + " and " +
                    number_text(box.height_px()),
                "box_px");
  }
  if (!is_probability(detection.score)) {
    return fail(ErrorCode::kInvalidArgument,
                "must be in 0..1, is " + number_text(detection.score.value()),
                "score");
  }
  HYPERMAP_TRY(validate_class_scores(detection.class_scores));
  return validate(std::span<const Embedding>(detection.embeddings));
}

double intersection_over_union(const PixelBox& a, const PixelBox& b) noexcept {
  const double width = std::min(a.u_max_px, b.u_max_px) - std::max(a.u_min_px, b.u_min_px);
  const double height = std::min(a.v_max_px, b.v_max_px) - std::max(a.v_min_px, b.v_min_px);
  const double common = std::max(0.0, width) * std::max(0.0, height);
  const double united = a.width_px() * a.height_px() + b.width_px() * b.height_px() - common;
  return united > 0.0 ? common / united : 0.0;
}

std::optional<ClassEvidence> best_class(std::span<const ClassEvidence> scores) {
  if (scores.empty()) return std::nullopt;
  return *std::max_element(scores.begin(), scores.end(), by_probability_then_low_id);
}

std::vector<ClassEvidence> spread_score(ClassId id,
                                        Probability score,
                                        std::span<const ClassId> known) {
  assert(std::find(known.begin(), known.end(), id) != known.end());
  if (known.size() == 1) return {{id, Probability(1.0)}};
  const Probability share((1.0 - score.value()) / static_cast<double>(known.size() - 1));
  std::vector<ClassEvidence> out;
  out.reserve(known.size());
  for (const ClassId other : known) out.push_back({other, other == id ? score : share});
  std::sort(out.begin(), out.end(), by_id);
  return out;
}

Result<std::vector<ClassEvidence>> normalized(std::vector<ClassEvidence> scores) {
  std::sort(scores.begin(), scores.end(), by_id);
  const auto duplicate = std::adjacent_find(
      scores.begin(), scores.end(), [](const auto& a, const auto& b) { return a.id == b.id; });
  if (duplicate != scores.end()) {
    return fail(
        ErrorCode::kInvalidArgument,
        "must name each class once, names class " + std::to_string(duplicate->id.value) + " twice",
        "class_scores");
  }
  double sum = 0.0;
  for (const ClassEvidence& score : scores) sum += score.probability.value();
  if (!(sum > 0.0)) {
    return fail(
        ErrorCode::kInvalidArgument, "must have a sum > 0, is " + number_text(sum), "class_scores");
  }
  for (ClassEvidence& score : scores) {
    score.probability = Probability(std::min(1.0, score.probability.value() / sum));
  }
  return scores;
}

Result<EmbeddingDimensions> with_embeddings_of(std::span<const Detection> detections,
                                               EmbeddingDimensions known) {
  for (std::size_t i = 0; i < detections.size(); ++i) {
    for (const Embedding& embedding : detections[i].embeddings) {
      auto added = known.add(embedding.model, embedding.vector.size());
      if (added) continue;
      added.error().field = "detections[" + std::to_string(i) + "].embeddings";
      return tl::make_unexpected(std::move(added).error());
    }
  }
  return known;
}

}  // namespace hypermap
