// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A map in the forms that other programs read.
#pragma once

#include "hypermap/core/base/class_palette.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/places/place_classifier.hpp"
#include "hypermap/core/places/relation_options.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/exports/zone_masks.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

enum class ExportFormat {
  kRosMap,        ///< map_server YAML + PGM with world file of an occupancy layer.
  kClassGrids,    ///< The same for each class, in a folder; of a map without class grids, from
                  ///< the shapes of its semantic layer (footprint_grids.hpp).
  kOctomap,       ///< `.ot` of an OcTree, or `.bt`.
  kColorOctomap,  ///< `.ot` of a ColorOcTree coloured by class.
  kPly,           ///< Occupied voxels as points with scalar_label, _instance, _confidence.
  kGeojson,       ///< Polygons of a semantic layer in local metres, `.local.geojson`, with the
                  ///< height, box, seen share and relations of the objects they stand for.
  kTiles,         ///< A folder of tiles (TileFolder) of the stack that `stack_of_map` makes; an
                  ///< older one is replaced as a whole.
  kRelations,     ///< What stands on, in, under, beside what, or is a part of it: Graphviz' `.dot`,
                  ///< or `.local.geojson` with a point an object and a line a relation.
  kViews,         ///< A folder with the view of each confirmed object, `<id>-<class>.jpg`; an older
                  ///< one is replaced as a whole.
  kTopologicalMap,  ///< Where the sensor came to, with the objects at each vertex: Graphviz'
                    ///< `.dot`.
  kGlb,   ///< A scene for viewers, glTF 2.0 binary: a node an object, `<class> <id>`, with its box
          ///< and extras `id`, `class`, `confidence`, `box`; the occupied surface as another.
  kNav2,  ///< A folder for Nav2: an occupancy layer, masks of where robots keep out and go slowly
          ///< (`zone_masks`) and their parameters; an older one is replaced as a whole.
  kGeopackage,  ///< A GeoPackage: a table of each semantic layer, in its own frame, and one of the
                ///< 3D objects, `objects`.
};

/// "ros-map", "class-grids", "octomap", "color-octomap", "ply", "geojson", "tiles",
/// "relations", "views", "topological-map", "glb", "nav2", "geopackage"; shorter, "gpkg" for the
/// last and "dot" for "topological-map".
[[nodiscard]] std::span<const std::string_view> export_format_names();

/// One of export_format_names(), in any spelling. Errors: kInvalidArgument listing them.
[[nodiscard]] Result<ExportFormat> parse_export_format(std::string_view name);

/// The YAML file that an export as kRosMap to `output` writes: a stem, or a name in .yaml or .pgm.
[[nodiscard]] std::filesystem::path ros_map_yaml(std::filesystem::path output);

struct ExportRequest {
  ExportFormat format = ExportFormat::kRosMap;
  std::filesystem::path output;
  /// Which 2D layer; the first of the kind that the format needs when absent.
  std::optional<std::string> layer;
  /// Only objects, voxels or grids of these classes; all when empty.
  std::vector<std::string> classes;
  /// Grids keep the yaw of their origin, which most programs ignore; else they are resampled.
  bool keep_rotation = false;
  bool without_objects = false;      ///< kRosMap: the floor that objects stand on is free.
  std::optional<Polygon> area = {};  ///< kRosMap: only the cells whose interior it meets (sub_map).
  std::string area_frame_id = {};    ///< Frame of `area`; empty: the layer's.
  bool complete = false;       ///< kGeojson: with guesses of boxes (`completed_boxes`), as such.
  bool with_voxels = false;    ///< kGlb: objects bear their voxels, which the surface then lacks.
  ClassPalette palette = {};   ///< Of formats in colour.
  ZoneRules zones = {};        ///< kNav2: of its masks.
  RelationOptions rules = {};  ///< kGeojson and kRelations: of relations.
  /// kTopologicalMap: what belongs where, by which vertices bear the class of their place
  /// (`vertex_places`); none, or a map without the floor of its rooms: they bear none.
  std::optional<PlaceRules> place_rules = std::nullopt;
};

/// Whether the format has what is asked of it, and the output ends as its files do, in upper or
/// lower case. Errors: kInvalidArgument naming the flag, "--layer", "--complete", "--class",
/// "--without-objects", "--area", "--with-voxels", and the formats that it goes with, or "--output"
/// and how it must end.
[[nodiscard]] Result<void> validate(const ExportRequest& request);

/// Writes the export; each file is replaced atomically, other files are never touched. Returns the
/// files that were written; none, and nothing is written, when the export would be empty.
///
/// Errors: kNotFound when the archive lacks what the format needs, naming what there is, or a class
/// is not known, an area meets no cell, or nothing connects its frame; kUnsupported for a layer of
/// another kind than the format needs; those of validate; kInvalidArgument for an output of
/// kTiles, kViews or kNav2 that is a folder with other files; kIo.
[[nodiscard]] Result<std::vector<std::filesystem::path>> export_map(const MapArchive& archive,
                                                                    const ExportRequest& request);

}  // namespace hypermap
