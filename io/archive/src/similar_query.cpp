// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/similar_query.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/io/archive/archive_layers.hpp"
#include "hypermap/io/archive/objects_layer.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace hypermap {
namespace {

std::vector<std::string> names_of(const EmbeddingDimensions& models) {
  std::vector<std::string> names;
  names.reserve(models.models().size());
  for (const auto& [name, dimension] : models.models()) names.push_back(name);
  return names;
}

/// The model that is meant. Errors: kNotFound, kInvalidArgument.
Result<std::string> model_of(const SimilarTo& similar_to, const EmbeddingDimensions& models) {
  const std::vector<std::string> names = names_of(models);
  if (names.empty()) {
    return fail(ErrorCode::kNotFound,
                "no object of the map has an embedding: its detections had none",
                "embedding");
  }
  if (similar_to.model.empty() && names.size() == 1) return names.front();
  if (similar_to.model.empty()) {
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : ", ") + printable(name);
    return fail(ErrorCode::kInvalidArgument, "must be one of " + all, "model");
  }
  if (models.find(similar_to.model)) return similar_to.model;
  return fail(ErrorCode::kNotFound, nothing_named("model", similar_to.model, names), "model");
}

Result<void> check_vector(const SimilarTo& similar_to,
                          const std::string& model,
                          std::size_t dimension) {
  if (auto valid = validate_embedding_vector(similar_to.vector); !valid) {
    valid.error().field = "embedding";
    return valid;
  }
  if (similar_to.vector.size() == dimension) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must have " + std::to_string(dimension) + " numbers as those of model " +
                  printable(model) + ", has " + std::to_string(similar_to.vector.size()),
              "embedding");
}

bool ranks_before(const MapAnswer& a, const MapAnswer& b) {
  return a.similarity != b.similarity ? a.similarity > b.similarity : a.id < b.id;
}

}  // namespace

Result<MapAnswers> query_similar(const MapArchive& archive,
                                 const SimilarTo& similar_to,
                                 const MapQuery& query) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto models, embedding_dimensions(archive.objects));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string model, model_of(similar_to, models));
  HYPERMAP_TRY(check_vector(similar_to, model, models.find(model).value_or(0)));
  MapQuery of_objects = query;
  of_objects.layer = kObjectsLayer;
  HYPERMAP_ASSIGN_OR_RETURN(MapAnswers answers, query_map(archive, of_objects));
  for (MapAnswer& one : answers.found) {
    const Object& object = archive.objects.at(ObjectId{static_cast<std::uint32_t>(one.id)});
    const MeanEmbedding* embedding = object.embeddings.find(model);
    if (embedding == nullptr) continue;
    one.similarity = cosine_similarity(embedding->mean, similar_to.vector);
  }
  std::erase_if(answers.found, [](const MapAnswer& one) { return !one.similarity; });
  std::ranges::sort(answers.found, ranks_before);
  if (answers.found.size() > similar_to.top) answers.found.resize(similar_to.top);
  return answers;
}

}  // namespace hypermap
