// SPDX-License-Identifier: BSD-3-Clause
// Shapes as their file wrote them, and as they are written once somebody edited them.
#include "fuzz_target.hpp"
#include "hypermap/io/archive/semantic_yaml.hpp"
#include "targets.hpp"

#include <utility>
#include <vector>

namespace hypermap::fuzz {
namespace {

Result<SemanticLayer> layer_of(std::string_view text) {
  constexpr SemanticReadOptions kOptions{
      .wkt = {.max_vertices = 1'000, .max_holes = 50, .max_parts = 20}};
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, parse_semantic_layer(text, kFuzzSource, kOptions));
  return std::move(loaded.value);
}

/// The layer without what its file wrote of its shapes.
Result<SemanticLayer> edited_layer_of(std::string_view text) {
  HYPERMAP_ASSIGN_OR_RETURN(const SemanticLayer layer, layer_of(text));
  std::vector<SemanticObject> objects(layer.objects().begin(), layer.objects().end());
  for (SemanticObject& object : objects) object.shape_text.clear();
  return SemanticLayer::create(std::move(objects));
}

}  // namespace

void fuzz_semantic(std::string_view bytes) {
  require_round_trip(bytes, layer_of, write_semantic_layer);
  require_round_trip(bytes, edited_layer_of, write_semantic_layer);
}

}  // namespace hypermap::fuzz
