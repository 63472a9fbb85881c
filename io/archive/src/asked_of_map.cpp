// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/asked_of_map.hpp"

#include "hypermap/core/vocabulary/asked_names.hpp"
#include "hypermap/io/archive/grid_stack_layer.hpp"

#include <algorithm>
#include <set>

namespace hypermap {
namespace {

void add_names_of(const Layer& layer, std::set<std::string>& names) {
  if (const auto* shapes = layer.content.as<SemanticLayer>()) {
    for (const SemanticObject& object : shapes->objects()) names.insert(object.name);
  }
  const auto* stack = layer.content.as<GridStackLayer>();
  if (stack == nullptr || !stack->stack()) return;
  for (const auto& [name, grid] : stack->stack()->layers()) {
    names.insert(name.substr(name.rfind('/') + 1));
  }
}

}  // namespace

std::vector<std::string> names_in(const MapArchive& archive) {
  std::set<std::string> names(archive.classes.names().begin(), archive.classes.names().end());
  for (const ClassGrid& grid : archive.class_grids) names.insert(grid.class_name);
  for (const Layer& layer : archive.hypermap.layers()) add_names_of(layer, names);
  // What cells, voxels and vertices are called that are of no class.
  for (const char* state : {"Free", "Occupied", "Unknown"}) names.emplace(state);
  for (const VertexKind kind : {VertexKind::kPath, VertexKind::kSupport}) {
    names.emplace(name_of(kind));
  }
  return {names.begin(), names.end()};
}

Result<NameSelection> asked_of_map(const MapArchive& archive, std::string_view text) {
  // Names decide only whether a text with a star or slashes is one of them, and what it matches.
  const bool is_plain = !text.ends_with('*') && !text.ends_with('/');
  const std::vector<std::string> known = is_plain ? std::vector<std::string>() : names_in(archive);
  return asked_names(text, known, archive.vocabulary);
}

bool is_class_of_map(const MapArchive& archive, std::string_view text) {
  const auto names = asked_of_map(archive, text);
  return names && std::ranges::any_of(names->canonical_names(), [&](const std::string& name) {
           return archive.classes.find(name).has_value();
         });
}

Result<NameSelection> asked_of_map(const MapArchive& archive, std::span<const std::string> texts) {
  std::set<std::string> all;
  for (const std::string& text : texts) {
    HYPERMAP_ASSIGN_OR_RETURN(const NameSelection names, asked_of_map(archive, text));
    const auto one = names.canonical_names();
    all.insert(one.begin(), one.end());
  }
  return NameSelection::of_canonical({all.begin(), all.end()});
}

Result<std::vector<ClassId>> asked_classes(const MapArchive& archive,
                                           std::span<const std::string> texts) {
  return asked_classes(archive.classes, archive.vocabulary, texts);
}

}  // namespace hypermap
