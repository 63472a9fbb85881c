// SPDX-License-Identifier: BSD-3-Clause
#include "provenance_text.hpp"

#include "hypermap/io/archive/map_sessions.hpp"

namespace hypermap::app {
namespace {

/// " as floor, things"; empty where it became no layer.
std::string became_text(const ValueTree* layers) {
  std::string text;
  if (layers == nullptr) return text;
  for (const ValueTree& layer : layers->items)
    text += (text.empty() ? " as " : ", ") + printable(layer.text);
  return text;
}

/// ", places places.yaml xxh3-128:...": what the map was made with besides options and frames.
std::string companions_text(const Provenance& provenance) {
  std::string text;
  for (const char* name : {"places", "combiner"}) {
    const ValueTree* companion = provenance.options.find(name);
    if (companion == nullptr) continue;
    text.append(", ").append(name).append(" ").append(printable(companion->text));
  }
  return text;
}

}  // namespace

std::string provenance_text(const Provenance& provenance) {
  const bool was_imported = is_import(provenance);
  std::string text = (was_imported ? "imported by " : "made by ") + printable(provenance.tool) +
                     " from " + printable(provenance.input) + " (" +
                     printable(provenance.input_hash) + ")";
  if (was_imported) text += became_text(provenance.options.find("import")->find("layers"));
  return text + companions_text(provenance);
}

}  // namespace hypermap::app
