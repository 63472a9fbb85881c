// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/stack/asked_layers.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/vocabulary/asked_names.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace hypermap {
namespace {

std::vector<std::string> layers_called(std::string_view name, std::span<const std::string> layers) {
  std::vector<std::string> called;
  for (const std::string& layer : layers) {
    if (is_at_or_below(layer, name)) called.push_back(layer);
  }
  return called;
}

/// Layers that are not below the parent keep their whole name.
std::vector<std::string> names_below(std::string_view parent, std::span<const std::string> layers) {
  std::vector<std::string> names;
  names.reserve(layers.size());
  for (const std::string& layer : layers) {
    const bool is_below = layer != parent && is_at_or_below(layer, parent);
    names.push_back(is_below ? layer.substr(parent.size() + 1) : layer);
  }
  return names;
}

Error about_layers(Error error) {
  error.field = "layers";
  return error;
}

}  // namespace

Result<std::vector<std::string>> asked_layers(std::string_view text,
                                              const GridStack& stack,
                                              const ClassVocabulary& vocabulary) {
  const std::string& parent = stack.options().parent;
  std::vector<std::string> layers;
  layers.reserve(stack.layers().size());
  for (const auto& [name, grid] : stack.layers()) layers.push_back(name);
  const std::string full_name =
      text.starts_with('/') ? std::string(text) : parent + "/" + std::string(text);
  std::vector<std::string> found = layers_called(full_name, layers);
  if (!found.empty()) return found;

  const std::vector<std::string> names = names_below(parent, layers);
  const auto asked = asked_names(text, names, vocabulary);
  if (!asked) return Unexpected(about_layers(asked.error()));
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (asked->contains(names[i])) found.push_back(layers[i]);
  }
  if (!found.empty()) return found;
  const bool is_one_name = asked->canonical_names().size() == 1;
  return fail(ErrorCode::kNotFound,
              is_one_name ? nothing_named("layer", full_name, layers)
                          : nothing_asked(text, names, vocabulary, "no layer"),
              "layers");
}

}  // namespace hypermap
