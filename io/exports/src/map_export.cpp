// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/exports/map_export.hpp"

#include "export_parts.hpp"
#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/vocabulary/asked_names.hpp"
#include "hypermap/io/archive/asked_of_map.hpp"
#include "hypermap/io/archive/grid_stack_layer.hpp"
#include "output_ending.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace hypermap {
namespace {

/// In the order of the enumerators, then shorter names, after what the files are called.
constexpr std::array<std::string_view, 15> kExportFormats{"ros-map",
                                                          "class-grids",
                                                          "octomap",
                                                          "color-octomap",
                                                          "ply",
                                                          "geojson",
                                                          "tiles",
                                                          "relations",
                                                          "views",
                                                          "topological-map",
                                                          "glb",
                                                          "nav2",
                                                          "geopackage",
                                                          "gpkg",
                                                          "dot"};
/// What the last of them stand for.
constexpr std::array kShorterNamesMean{ExportFormat::kGeopackage, ExportFormat::kTopologicalMap};
constexpr std::size_t kNumFormats = kExportFormats.size() - kShorterNamesMean.size();

std::string flag_of(ExportFormat format) {
  return "--format " + std::string(kExportFormats.at(static_cast<std::size_t>(format)));
}

/// How to get what the map has of a class that was taken for a layer.
std::string class_hint(const MapArchive& archive,
                       const std::string& class_name,
                       ExportFormat format) {
  const std::string known = printable(class_name);
  const std::string option = "--class \"" + known + "\"";
  if (format != ExportFormat::kRosMap) return known + " is a class: " + option;
  const bool has_grid = std::ranges::any_of(archive.class_grids, [&](const ClassGrid& grid) {
    return is_spelling_of(grid.class_name, class_name);
  });
  if (!has_grid) return known + " is a class of which the map has no grid";
  return known + " is a class, whose grid is had by: --format class-grids " + option;
}

}  // namespace

std::span<const std::string_view> export_format_names() {
  return kExportFormats;
}

Result<ExportFormat> parse_export_format(std::string_view name) {
  const auto found = std::ranges::find_if(
      kExportFormats, [&](std::string_view known) { return is_spelling_of(known, name); });
  if (found == kExportFormats.end())
    return fail(ErrorCode::kInvalidArgument, not_one_of(name, kExportFormats), "--format");
  const auto place = static_cast<std::size_t>(found - kExportFormats.begin());
  if (place >= kNumFormats) return kShorterNamesMean.at(place - kNumFormats);
  return static_cast<ExportFormat>(place);
}

Result<void> validate(const ExportRequest& request) {
  const bool is_flat =
      request.format == ExportFormat::kRosMap || request.format == ExportFormat::kGeojson ||
      request.format == ExportFormat::kNav2 || request.format == ExportFormat::kGeopackage;
  if (request.layer && !is_flat) {
    return fail(ErrorCode::kInvalidArgument,
                "goes with --format ros-map, geojson, nav2 and geopackage, not with " +
                    flag_of(request.format),
                "--layer");
  }
  if (request.complete && request.format != ExportFormat::kGeojson) {
    return fail(ErrorCode::kInvalidArgument,
                "goes with --format geojson, not with " + flag_of(request.format),
                "--complete");
  }
  if (request.without_objects && request.format != ExportFormat::kRosMap) {
    return fail(ErrorCode::kInvalidArgument,
                "goes with --format ros-map, not with " + flag_of(request.format),
                "--without-objects");
  }
  if (request.area && request.format != ExportFormat::kRosMap) {
    return fail(ErrorCode::kInvalidArgument,
                "goes with --format ros-map, not with " + flag_of(request.format) +
                    "; crop makes a part of a whole map",
                "--area");
  }
  if (!request.area_frame_id.empty() && !request.area) {
    return fail(ErrorCode::kInvalidArgument, "needs --area", "--frame");
  }
  if (request.keep_rotation && request.format == ExportFormat::kNav2) {
    return fail(ErrorCode::kInvalidArgument,
                "does not go with --format nav2, whose filters do not turn masks",
                "--keep-rotation");
  }
  if (request.with_voxels && request.format != ExportFormat::kGlb) {
    return fail(ErrorCode::kInvalidArgument,
                "goes with --format glb, not with " + flag_of(request.format),
                "--with-voxels");
  }
  if (!request.classes.empty() && request.format == ExportFormat::kTopologicalMap) {
    return fail(ErrorCode::kInvalidArgument,
                "does not go with --format topological-map, whose vertices have no class",
                "--class");
  }
  if (!request.classes.empty() && request.format == ExportFormat::kRosMap) {
    return fail(ErrorCode::kInvalidArgument,
                "does not go with --format ros-map, whose cells have no class; --format "
                "class-grids has a grid for each",
                "--class");
  }
  return check_ending(request);
}

Result<std::optional<std::set<ClassId>>> wanted_classes(const MapArchive& archive,
                                                        const ExportRequest& request) {
  if (request.classes.empty()) return std::optional<std::set<ClassId>>();
  const auto ids = asked_classes(archive, request.classes);
  if (!ids) return fail(ids.error().code, ids.error().what, "--class");
  return std::optional(std::set<ClassId>(ids->begin(), ids->end()));
}

Result<double> octree_resolution_m(const MapArchive& archive) {
  if (archive.octree) return archive.octree->resolution_m();
  if (!archive.octomaps.empty()) return archive.octomaps.front().tree.resolution_m;
  return fail(ErrorCode::kNotFound, "the map has no octree");
}

Result<NameSelection> wanted_names(const MapArchive& archive,
                                   std::span<const std::string> known,
                                   std::span<const std::string> texts) {
  std::set<std::string> all;
  for (const std::string& text : texts) {
    const auto names = asked_names(text, known, archive.vocabulary);
    if (!names) return fail(names.error().code, names.error().what, "--class");
    const auto is_asked = [&](const std::string& name) { return names->contains(name); };
    if (std::ranges::none_of(known, is_asked)) {
      return fail(ErrorCode::kNotFound, nothing_asked(text, known, archive.vocabulary), "--class");
    }
    all.insert(names->canonical_names().begin(), names->canonical_names().end());
  }
  return NameSelection::of_canonical({all.begin(), all.end()});
}

Result<const Layer*> named_layer(const MapArchive& archive, const ExportRequest& request) {
  const std::string& name = *request.layer;
  if (const Layer* layer = archive.hypermap.find(name)) return layer;
  for (const Layer& layer : archive.hypermap.layers()) {
    if (is_spelling_of(layer.info.name, name)) return &layer;
  }
  Error unknown = archive.hypermap.at(name).error();
  if (const auto id = archive.classes.find(name)) {
    unknown.what += "; " + class_hint(archive, archive.classes.name(*id), request.format);
  }
  return Unexpected(std::move(unknown));
}

Unexpected no_layer_of_kind(const MapArchive& archive,
                            const ExportRequest& request,
                            std::string_view needed,
                            const Layer* named) {
  const auto layers = archive.hypermap.layers();
  const auto is_stack = [](const Layer& layer) {
    return layer.content.as<GridStackLayer>() != nullptr;
  };
  const auto found = std::ranges::find_if(layers, is_stack);
  const Layer* stack = found == layers.end() ? nullptr : &*found;
  if (named != nullptr && is_stack(*named)) stack = named;
  std::string text = flag_of(request.format) + " needs a layer of kind " + std::string(needed);
  if (named != nullptr) {
    text +=
        ", '" + printable(named->info.name) + "' is a " + printable(named->content->class_name());
  } else {
    text += ", the map has none";
  }
  if (stack != nullptr && request.format == ExportFormat::kRosMap) {
    text += "; grids of a stack are written by: hypermap stack FILE --from " +
            printable(stack->info.name);
  }
  return fail(named != nullptr ? ErrorCode::kUnsupported : ErrorCode::kNotFound,
              std::move(text),
              "--layer");
}

Result<WrittenFiles> export_map(const MapArchive& archive, const ExportRequest& request) {
  HYPERMAP_TRY(validate(request));
  switch (request.format) {
    case ExportFormat::kRosMap:
      return export_ros_map(archive, request);
    case ExportFormat::kClassGrids:
      return export_class_grids(archive, request);
    case ExportFormat::kOctomap:
      return export_octomap(archive, request);
    case ExportFormat::kColorOctomap:
      return export_color_octomap(archive, request);
    case ExportFormat::kPly:
      return export_ply(archive, request);
    case ExportFormat::kGeojson:
      return export_geojson(archive, request);
    case ExportFormat::kTiles:
      return export_tiles(archive, request);
    case ExportFormat::kRelations:
      return export_relations(archive, request);
    case ExportFormat::kViews:
      return export_views(archive, request);
    case ExportFormat::kTopologicalMap:
      return export_topological_map(archive, request);
    case ExportFormat::kGlb:
      return export_glb(archive, request);
    case ExportFormat::kNav2:
      return export_nav2(archive, request);
    case ExportFormat::kGeopackage:
      return export_geopackage(archive, request);
  }
  return fail(ErrorCode::kUnsupported, "unknown format");
}

}  // namespace hypermap
