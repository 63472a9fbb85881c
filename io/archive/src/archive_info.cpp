// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/archive_info.hpp"

#include "hypermap/io/archive/archive_layers.hpp"
#include "hypermap/io/archive/object_relations.hpp"

#include <string>
#include <vector>

namespace hypermap {
namespace {

LayerSummary summary_of(const Layer& layer) {
  LayerSummary summary;
  static_cast<LayerStatistics&>(summary) = layer.content->statistics();
  summary.name = layer.info.name;
  summary.class_name = std::string(class_of(layer));
  summary.frame_id = layer.info.frame_id;
  summary.flat = layer.content->is_flat();
  return summary;
}

}  // namespace

ArchiveInfo describe(const MapArchive& archive) {
  ArchiveInfo info;
  bool extended = false;
  for (const Layer& layer : archive_layers(archive)) {
    info.layers.push_back(summary_of(layer));
    extended = extended || !is_strict_form(layer);
  }
  extended = extended || archive.classes.size() > 0 || !archive.provenance.empty() ||
             archive.checkpoint.kind != ValueKind::kNull || archive.true_surfaces.has_value() ||
             !archive.foreign_extensions.empty();
  info.format_version = extended ? kArchiveFormatVersion : 0;
  info.classes.assign(archive.classes.names().begin(), archive.classes.names().end());
  const auto transforms = archive.hypermap.frames().transforms();
  info.transforms.assign(transforms.begin(), transforms.end());
  info.provenance = archive.provenance;
  for (const Relation& relation : archive_relations(archive).relations) {
    ++info.num_relations[static_cast<std::size_t>(relation.kind)];
  }
  return info;
}

}  // namespace hypermap
