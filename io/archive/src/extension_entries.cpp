// SPDX-License-Identifier: BSD-3-Clause
#include "extension_entries.hpp"

#include <utility>

namespace hypermap {

ExtensionEntry new_entry(std::string_view format) {
  ExtensionEntry entry{.format = std::string(format)};
  if (format == kOctomapFormat) {
    entry.name = "octree";
    entry.file = "octree.ot";
  } else if (format == kOctreeTwinFormat) {
    entry.name = "octree_twin";
    entry.file = "octree.bt";
  } else if (format == kObjectsFormat) {
    entry.name = "objects";
    entry.file = "objects.jsonl";
  } else if (format == kEmbeddingsFormat) {
    entry.name = "embeddings";
    entry.file = "embeddings.bin";
  } else if (format == kViewsFormat) {
    entry.name = "views";
    entry.file = "views.bin";
  } else if (format == kTopologicalMapFormat) {
    entry.name = "topological_map";
    entry.file = "topological_map.jsonl";
  } else if (format == kClassesFormat) {
    entry.name = "classes";
    entry.file = "classes.yaml";
  } else if (format == kDetectorsFormat) {
    entry.name = "detectors";
    entry.file = "detectors.yaml";
  } else if (format == kVocabularyFormat) {
    entry.name = "vocabulary";
    entry.file = "vocabulary.yaml";
  } else if (format == kProvenanceFormat) {
    entry.name = "provenance";
    entry.file = "provenance.yaml";
  } else if (format == kTrueSurfacesFormat) {
    entry.name = "true_surfaces";
    entry.file = "true_surfaces.jsonl";
  } else {
    entry.name = "checkpoint";
    entry.file = "checkpoint.yaml";
  }
  return entry;
}

std::string plain_grid_name(std::size_t i) {
  return "class_grid_" + std::to_string(i);
}

ExtensionEntry entry_of(const MapArchive& archive, std::string_view format) {
  const auto kept = archive.extension_entries.find(format);
  return kept == archive.extension_entries.end() ? new_entry(format) : kept->second;
}

void keep_entry(MapArchive& archive, ExtensionEntry entry) {
  if (entry == new_entry(entry.format)) return;
  std::string format = entry.format;
  archive.extension_entries.insert_or_assign(std::move(format), std::move(entry));
}

}  // namespace hypermap
