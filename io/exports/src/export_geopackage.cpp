// SPDX-License-Identifier: BSD-3-Clause
#include "export_folder.hpp"
#include "export_parts.hpp"
#include "exported_objects.hpp"
#include "hypermap/core/base/utf8.hpp"
#include "hypermap/core/completion/completion.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/geopackage/geopackage.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// Names of tables: small letters, since SQL knows no case, and none of the standard's own.
std::string table_name(std::string_view layer, FileNames& names) {
  std::string lower(layer);
  std::ranges::transform(lower, lower.begin(), lower_ascii);
  const bool is_plain = !lower.starts_with("gpkg_") && !lower.starts_with("sqlite_") &&
                        !lower.starts_with("rtree_") && !lower.empty();
  return names.add(is_plain ? lower : "layer_" + lower);
}

std::string in_frame(const std::string& what, const std::string& frame_id) {
  return what + "; metres of frame " + printable(frame_id);
}

GeoPackageValue number_or_unknown(std::optional<double> number) {
  return number ? GeoPackageValue(*number) : GeoPackageValue();
}

/// The semantic layers that were asked for. Errors: kNotFound when the map has neither such a layer
/// nor objects; those of wanted_layer.
Result<std::vector<const Layer*>> layers_to_export(const MapArchive& archive,
                                                   const ExportRequest& request) {
  std::vector<const Layer*> layers;
  for (const Layer& layer : archive.hypermap.layers()) {
    if (layer.content.as<SemanticLayer>() != nullptr) layers.push_back(&layer);
  }
  if (!request.layer && (!layers.empty() || !archive.objects.empty())) return layers;
  HYPERMAP_ASSIGN_OR_RETURN(const Layer* only,
                            wanted_layer<SemanticLayer>(archive, request, kSemanticLayerClass));
  return std::vector<const Layer*>{only};
}

/// The names that were asked for; none when all are. Known are the map's classes and the names in
/// these layers. Errors: those of wanted_names.
Result<std::optional<NameSelection>> selected_names(const MapArchive& archive,
                                                    const ExportRequest& request,
                                                    const std::vector<const Layer*>& layers) {
  if (request.classes.empty()) return std::optional<NameSelection>();
  std::vector<std::string> known(archive.classes.names().begin(), archive.classes.names().end());
  for (const Layer* layer : layers) {
    for (const SemanticObject& shape : layer->content.as<SemanticLayer>()->objects()) {
      known.push_back(shape.name);
    }
  }
  HYPERMAP_ASSIGN_OR_RETURN(NameSelection names, wanted_names(archive, known, request.classes));
  return std::optional(std::move(names));
}

Result<GeoPackageFeature> feature_of(const SemanticObject& shape,
                                     const Layer& layer,
                                     const MapArchive& archive) {
  if (shape.id > std::numeric_limits<std::int64_t>::max()) {
    return fail(ErrorCode::kUnsupported,
                "an id must be below 2^63 in a GeoPackage, is " + std::to_string(shape.id),
                layer.info.name);
  }
  const Object* object = object_of(shape, layer, archive);
  const auto height_m = object == nullptr ? std::nullopt : std::optional(object->box.extent().z());
  const GeoPackageValue tags =
      shape.tags.empty() ? GeoPackageValue() : GeoPackageValue(nlohmann::json(shape.tags).dump());
  return GeoPackageFeature{.parts = shape.parts,
                           .values = {static_cast<std::int64_t>(shape.id),
                                      shape.name,
                                      number_or_unknown(confidence_of(shape)),
                                      tags,
                                      number_or_unknown(height_m)}};
}

Result<GeoPackageTable> layer_table(const Layer& layer,
                                    const std::optional<NameSelection>& names,
                                    const MapArchive& archive) {
  GeoPackageTable table{
      .description = in_frame("layer " + printable(layer.info.name), layer.info.frame_id),
      .columns = {{"id", GeoPackageType::kInteger},
                  {"name", GeoPackageType::kText},
                  {"confidence", GeoPackageType::kReal},
                  {"tags", GeoPackageType::kText},
                  {"height_m", GeoPackageType::kReal}}};
  for (const SemanticObject& shape : layer.content.as<SemanticLayer>()->objects()) {
    if (names && !names->contains(shape.name)) continue;
    HYPERMAP_ASSIGN_OR_RETURN(GeoPackageFeature feature, feature_of(shape, layer, archive));
    table.features.push_back(std::move(feature));
  }
  return table;
}

Polygon rectangle_of(const Box& box) {
  const Eigen::Vector3d& low = box.min_in_map;
  const Eigen::Vector3d& high = box.max_in_map;
  return {
      .outer = {{low.x(), low.y()}, {high.x(), low.y()}, {high.x(), high.y()}, {low.x(), high.y()}},
      .holes = {}};
}

/// What an object covers of the floor: its shape in `semantic`, else its box from above.
std::vector<Polygon> footprint_of(const Object& object, const SemanticLayer* semantic) {
  const SemanticObject* shape = semantic == nullptr ? nullptr : semantic->find(object.id.value);
  return shape == nullptr ? std::vector<Polygon>{rectangle_of(object.box)} : shape->parts;
}

GeoPackageFeature object_feature(const ExportedObject& exported, const SemanticLayer* semantic) {
  const Object& object = *exported.object;
  const Box& box = object.box;
  return {.parts = footprint_of(object, semantic),
          .values = {std::int64_t{object.id.value},
                     exported.class_name,
                     exported.confidence,
                     box.min_in_map.z(),
                     box.max_in_map.z(),
                     box.extent().z(),
                     seen_share(object),
                     std::int64_t{object.num_observations},
                     object.first_seen.ns,
                     object.last_seen.ns}};
}

Result<GeoPackageTable> objects_table(const MapArchive& archive,
                                      const std::optional<NameSelection>& names) {
  const std::string frame_id = shown_frame_id(archive);
  GeoPackageTable table{.description = in_frame("confirmed objects of the 3D map", frame_id),
                        .columns = {{"id", GeoPackageType::kInteger},
                                    {"class", GeoPackageType::kText},
                                    {"confidence", GeoPackageType::kReal},
                                    {"bottom_m", GeoPackageType::kReal},
                                    {"top_m", GeoPackageType::kReal},
                                    {"height_m", GeoPackageType::kReal},
                                    {"seen_share", GeoPackageType::kReal},
                                    {"observations", GeoPackageType::kInteger},
                                    {"first_seen_ns", GeoPackageType::kInteger},
                                    {"last_seen_ns", GeoPackageType::kInteger}}};
  const Layer* layer = archive.hypermap.find(kSemanticLayer);
  const bool is_shown = layer != nullptr && layer->info.frame_id == frame_id;
  const SemanticLayer* semantic = is_shown ? layer->content.as<SemanticLayer>() : nullptr;
  HYPERMAP_ASSIGN_OR_RETURN(const auto objects, exported_objects(archive, {}));
  for (const ExportedObject& object : objects) {
    if (names && !names->contains(object.class_name)) continue;
    table.features.push_back(object_feature(object, semantic));
  }
  return table;
}

}  // namespace

Result<WrittenFiles> export_geopackage(const MapArchive& archive, const ExportRequest& request) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto layers, layers_to_export(archive, request));
  HYPERMAP_ASSIGN_OR_RETURN(const auto names, selected_names(archive, request, layers));
  FileNames table_names;
  std::vector<GeoPackageTable> tables;
  if (!request.layer) {
    HYPERMAP_ASSIGN_OR_RETURN(tables.emplace_back(), objects_table(archive, names));
    tables.back().name = table_names.add("objects");
  }
  for (const Layer* layer : layers) {
    HYPERMAP_ASSIGN_OR_RETURN(GeoPackageTable table, layer_table(*layer, names, archive));
    table.name = table_name(layer->info.name, table_names);
    tables.push_back(std::move(table));
  }
  std::erase_if(tables, [](const GeoPackageTable& table) { return table.features.empty(); });
  if (tables.empty()) return WrittenFiles{};
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, write_geopackage(tables));
  HYPERMAP_TRY(write_file_atomically(request.output, bytes));
  return WrittenFiles{request.output};
}

}  // namespace hypermap
