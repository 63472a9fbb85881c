// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/embedding_json.hpp"
#include "hypermap/io/codec/json_text.hpp"
#include "hypermap/io/dataset/detections_parsing.hpp"

#include <algorithm>
#include <utility>

namespace hypermap {

Result<std::vector<Embedding>> parse_embeddings(const JsonNode& node,
                                                DetectionSetBuilder& builder) {
  const bool is_list = node.is(JsonKind::kArray);
  const std::size_t num = is_list ? node.size() : 1;
  if (num > kMaxEmbeddingModels) {
    return node.error(ErrorCode::kLimit,
                      "at most " + std::to_string(kMaxEmbeddingModels) +
                          " embeddings of a detection are read, has " + std::to_string(num));
  }
  std::vector<Embedding> out;
  out.reserve(num);
  for (std::size_t i = 0; i < num; ++i) {
    const JsonNode one = is_list ? node.at(i) : node;
    HYPERMAP_ASSIGN_OR_RETURN(Embedding embedding, parse_embedding(one));
    if (std::ranges::find(out, embedding.model, &Embedding::model) != out.end()) {
      return one.error(ErrorCode::kMalformedFile, "must name each model once, is there twice");
    }
    HYPERMAP_TRY(builder.add_embedding(embedding, one));
    out.push_back(std::move(embedding));
  }
  return out;
}

std::string embeddings_json(std::span<const Embedding> embeddings) {
  return embeddings.size() == 1 ? embedding_json(embeddings.front())
                                : json_array(embeddings, embedding_json);
}

}  // namespace hypermap
