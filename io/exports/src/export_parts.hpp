// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the single exports share.
#pragma once

#include "hypermap/core/vocabulary/name_selection.hpp"
#include "hypermap/io/exports/map_export.hpp"

#include <set>
#include <span>
#include <string>
#include <string_view>

namespace hypermap {

using WrittenFiles = std::vector<std::filesystem::path>;

/// Ids of the classes that were asked for; none when all are wanted.
/// Errors: kNotFound naming the class and those that are known.
[[nodiscard]] Result<std::optional<std::set<ClassId>>> wanted_classes(const MapArchive& archive,
                                                                      const ExportRequest& request);

/// All that the texts ask for (asked_names, by the map's vocabulary).
/// Errors: of the field "--class": those of asked_names; kNotFound for the first that asks for
/// nothing that is `known`, with those that are.
[[nodiscard]] Result<NameSelection> wanted_names(const MapArchive& archive,
                                                 std::span<const std::string> known,
                                                 std::span<const std::string> texts);

/// The layer that was asked for, in any spelling. Errors: kNotFound; where the name is that of a
/// class it says how the format, or another one, gives what the map has of it.
/// Requires: `request.layer`.
[[nodiscard]] Result<const Layer*> named_layer(const MapArchive& archive,
                                               const ExportRequest& request);

/// The error of `wanted_layer`: the map has no layer of kind `needed`, or the one that was named is
/// of another. For an occupancy grid it says how to get those of a stack, when there is one.
[[nodiscard]] Unexpected no_layer_of_kind(const MapArchive& archive,
                                          const ExportRequest& request,
                                          std::string_view needed,
                                          const Layer* named);

/// The layer that was asked for, or the first with this content, whose kind `info` calls `kind`.
/// Errors: kNotFound, kUnsupported, field "--layer".
template <class Content>
[[nodiscard]] Result<const Layer*> wanted_layer(const MapArchive& archive,
                                                const ExportRequest& request,
                                                std::string_view kind) {
  if (request.layer) {
    HYPERMAP_ASSIGN_OR_RETURN(const Layer* layer, named_layer(archive, request));
    if (layer->content.as<Content>() != nullptr) return layer;
    return no_layer_of_kind(archive, request, kind, layer);
  }
  for (const Layer& layer : archive.hypermap.layers()) {
    if (layer.content.as<Content>() != nullptr) return &layer;
  }
  return no_layer_of_kind(archive, request, kind, nullptr);
}

/// Edge of a voxel of the octree, ours or else the first of another program.
/// Errors: kNotFound when the map has neither.
[[nodiscard]] Result<double> octree_resolution_m(const MapArchive& archive);

[[nodiscard]] Result<WrittenFiles> export_ros_map(const MapArchive& archive,
                                                  const ExportRequest& request);
[[nodiscard]] Result<WrittenFiles> export_class_grids(const MapArchive& archive,
                                                      const ExportRequest& request);
[[nodiscard]] Result<WrittenFiles> export_octomap(const MapArchive& archive,
                                                  const ExportRequest& request);
[[nodiscard]] Result<WrittenFiles> export_color_octomap(const MapArchive& archive,
                                                        const ExportRequest& request);
[[nodiscard]] Result<WrittenFiles> export_ply(const MapArchive& archive,
                                              const ExportRequest& request);
[[nodiscard]] Result<WrittenFiles> export_geojson(const MapArchive& archive,
                                                  const ExportRequest& request);
[[nodiscard]] Result<WrittenFiles> export_tiles(const MapArchive& archive,
                                                const ExportRequest& request);

[[nodiscard]] Result<WrittenFiles> export_relations(const MapArchive& archive,
                                                    const ExportRequest& request);
[[nodiscard]] Result<WrittenFiles> export_topological_map(const MapArchive& archive,
                                                          const ExportRequest& request);
[[nodiscard]] Result<WrittenFiles> export_views(const MapArchive& archive,
                                                const ExportRequest& request);
[[nodiscard]] Result<WrittenFiles> export_glb(const MapArchive& archive,
                                              const ExportRequest& request);
[[nodiscard]] Result<WrittenFiles> export_geopackage(const MapArchive& archive,
                                                     const ExportRequest& request);
[[nodiscard]] Result<WrittenFiles> export_nav2(const MapArchive& archive,
                                               const ExportRequest& request);

}  // namespace hypermap
