// SPDX-License-Identifier: BSD-3-Clause
// Updates of a layer of three squares: done as a whole, or not at all.
#include "fuzz_target.hpp"
#include "hypermap/io/archive/semantic_update_file.hpp"
#include "targets.hpp"

#include <utility>
#include <vector>

namespace hypermap::fuzz {
namespace {

SemanticLayer three_squares() {
  SemanticLayer layer;
  for (std::uint64_t id = 0; id < 3; ++id) {
    const double x = static_cast<double>(id);
    const auto square = make_polygon({{x, 0}, {x + 1, 0}, {x + 1, 1}, {x, 1}});
    require(layer.add({.id = id, .name = "square", .parts = {square.value()}}).has_value(),
            "squares are shapes");
  }
  return layer;
}

}  // namespace

void fuzz_update(std::string_view bytes) {
  constexpr SemanticReadOptions kOptions{
      .wkt = {.max_vertices = 1'000, .max_holes = 50, .max_parts = 20}};
  const auto update = parse_semantic_update(bytes, kFuzzSource, kOptions);
  if (!update) return;
  const SemanticLayer before = three_squares();
  SemanticLayer layer = before;
  if (!layer.apply(update->value)) {
    require(layer == before, "a refused update changes nothing");
    return;
  }
  std::vector<SemanticObject> objects(layer.objects().begin(), layer.objects().end());
  const auto made_anew = SemanticLayer::create(std::move(objects));
  require(require(made_anew, "what an update leaves is a layer") == layer,
          "what an update leaves is the layer of its objects");
  const Polygon everywhere =
      make_polygon({{-1e6, -1e6}, {1e6, -1e6}, {1e6, 1e6}, {-1e6, 1e6}}).value();
  require(layer.in(everywhere).size() == layer.objects().size(), "every object is found");
}

}  // namespace hypermap::fuzz
