// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/archive_info.hpp"

#include "hypermap/io/archive/archive_layers.hpp"
#include "hypermap/io/archive/grid_stack_layer.hpp"
#include "hypermap/io/archive/object_relations.hpp"
#include "hypermap/io/archive/supercell_layer.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// What a layer is made of, where it is of stacks.
std::vector<std::string> parts_of(const Layer& layer) {
  std::vector<std::string> parts;
  if (const auto* stack = layer.content.as<GridStackLayer>(); stack != nullptr && stack->stack()) {
    for (const auto& [name, grid] : stack->stack()->layers()) parts.push_back(name);
  }
  if (const auto* cells = layer.content.as<SupercellLayer>()) parts = cells->graph().layers;
  return parts;
}

LayerSummary summary_of(const Layer& layer) {
  LayerSummary summary;
  static_cast<LayerStatistics&>(summary) = layer.content->statistics();
  summary.name = layer.info.name;
  summary.class_name = std::string(class_of(layer));
  summary.frame_id = layer.info.frame_id;
  summary.flat = layer.content->is_flat();
  summary.parts = parts_of(layer);
  return summary;
}

LayerFlags flags_of(const LayerInfo& info) {
  return {.load_file = info.load_file,
          .subscribe_mode = info.subscribe_mode.value_or(false),
          .enable_update = info.enable_update.value_or(true)};
}

std::size_t count_members(const std::vector<VocabularyGroup>& groups) {
  std::size_t count = 0;
  for (const VocabularyGroup& group : groups) count += group.members.size();
  return count;
}

std::vector<ModelSummary> models_of(const ObjectMap& objects) {
  std::map<std::string, ModelSummary> models;
  for (const Object& object : objects.objects()) {
    for (const MeanEmbedding& embedding : object.embeddings.entries()) {
      ModelSummary& model = models[embedding.model];
      model.dimension = embedding.mean.size();
      ++model.num_objects;
    }
  }
  std::vector<ModelSummary> out;
  out.reserve(models.size());
  for (auto& [name, model] : models) {
    model.model = name;
    out.push_back(std::move(model));
  }
  return out;
}

}  // namespace

ArchiveInfo describe(const MapArchive& archive) {
  ArchiveInfo info;
  bool extended = false;
  for (const Layer& layer : archive_layers(archive)) {
    info.layers.push_back(summary_of(layer));
    extended = extended || !is_strict_form(layer);
  }
  const auto own = archive.hypermap.layers();  // they come first in the list
  for (std::size_t i = 0; i < own.size(); ++i) info.layers[i].flags = flags_of(own[i].info);
  extended = extended || archive.classes.size() > 0 || archive.detectors.size() > 0 ||
             !archive.vocabulary.empty() || !archive.provenance.empty() ||
             archive.checkpoint.kind != ValueKind::kNull || archive.true_surfaces.has_value() ||
             archive.topological_map.has_value() || !archive.foreign_extensions.empty();
  info.format_version = extended ? kArchiveFormatVersion : 0;
  info.classes.assign(archive.classes.names().begin(), archive.classes.names().end());
  const auto detectors = archive.detectors.detectors();
  info.detectors.assign(detectors.begin(), detectors.end());
  info.num_aliases = count_members(archive.vocabulary.groups().aliases);
  info.num_super_classes = archive.vocabulary.groups().super_classes.size();
  const auto transforms = archive.hypermap.frames().transforms();
  info.transforms.assign(transforms.begin(), transforms.end());
  info.provenance = archive.provenance;
  info.models = models_of(archive.objects);
  info.num_views = archive.views.size();
  info.floor = archive.floor;
  if (archive.topological_map) {
    info.num_vertices = archive.topological_map->vertices().size();
    info.num_edges = archive.topological_map->edges().size();
  }
  for (const Relation& relation : archive_relations(archive).relations) {
    ++info.num_relations[static_cast<std::size_t>(relation.kind)];
  }
  return info;
}

}  // namespace hypermap
