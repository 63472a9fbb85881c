// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which objects look most like a vector that a network made of a text or an image.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_query.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace hypermap {

/// What objects are compared with.
struct SimilarTo {
  std::vector<float> vector;
  std::string model = {};  ///< Empty: the only one that objects have.
  std::size_t top = 10;    ///< So many answers at most.
};

/// Of the objects that fulfil the query and that have an embedding of the model, those whose means
/// have the largest cosine similarity with the vector, largest first, of equals the lower id first.
/// All are compared. The layer is that of the objects, whatever `query.layer` says.
///
/// Boundary: an empty list is a normal answer. A mean of length 0 has similarity 0.
/// Errors: those of query_map; kNotFound, field `embedding`, when no object of the map has an
/// embedding; kNotFound, field `model`, for one that none has, with those there are;
/// kInvalidArgument, field `model`, when there are several and none is chosen; kInvalidArgument,
/// field `embedding`, for a vector that `validate_embedding_vector` refuses or of another dimension
/// than the model's. Cost: linear in the numbers.
[[nodiscard]] Result<MapAnswers> query_similar(const MapArchive& archive,
                                               const SimilarTo& similar_to,
                                               const MapQuery& query);

}  // namespace hypermap
