// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/updated_shapes.hpp"

#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

namespace hypermap {
namespace {

/// Errors: kInvalidArgument for a shape of an object that the map does not show.
Result<void> refuse_objects_ids(const std::vector<SemanticObject>& added,
                                const SemanticLayer& layer,
                                const ObjectMap& objects) {
  for (std::size_t i = 0; i < added.size(); ++i) {
    const ObjectId id{static_cast<std::uint32_t>(added[i].id)};
    const bool is_hidden = id.value == added[i].id && objects.contains(id);
    if (!is_hidden || layer.find(added[i].id) != nullptr) continue;  // there twice: update says so
    return fail(ErrorCode::kInvalidArgument,
                "is that of an object of the map, " + std::to_string(id.value) +
                    ", which a shape of that id would show",
                "add[" + std::to_string(i) + "].id");
  }
  return {};
}

}  // namespace

Result<SemanticUpdateReport> update_shapes(MapArchive& archive,
                                           std::string_view layer,
                                           SemanticUpdate update) {
  const auto* shapes = archive.hypermap.find_as<SemanticLayer>(layer);
  const bool has_or_had_objects = archive.objects.next_id() != ObjectMap().next_id();
  if (shapes != nullptr && layer == kSemanticLayer && has_or_had_objects) {
    HYPERMAP_TRY(refuse_objects_ids(update.to_add, *shapes, archive.objects));
    update.least_new_id =
        std::max<std::uint64_t>(update.least_new_id, archive.objects.next_id().value);
  }
  return archive.hypermap.update(layer, update);
}

}  // namespace hypermap
