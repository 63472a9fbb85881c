// SPDX-License-Identifier: BSD-3-Clause
// Files of one embedding, by NumPy or in JSON.
#include "fuzz_target.hpp"
#include "hypermap/core/segmentation/embedding.hpp"
#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/embedding_file.hpp"
#include "hypermap/io/codec/embedding_json.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_vector(std::string_view bytes) {
  const auto file = parse_embedding_file(bytes, kFuzzSource);
  if (!file) return;
  const Embedding embedding{file->model.value_or("model"), file->vector};
  require(validate(embedding).has_value(), "what was read is valid");
  const auto again = parse_embedding_file(embedding_json(embedding), kFuzzSource);
  require(require(again, "what was written is read").vector == file->vector, "as the same vector");
}

}  // namespace hypermap::fuzz
