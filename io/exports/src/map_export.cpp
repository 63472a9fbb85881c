// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/exports/map_export.hpp"

#include "export_parts.hpp"
#include "hypermap/core/base/nearest_name.hpp"

#include <array>
#include <utility>

namespace hypermap {
namespace {

constexpr std::array<std::pair<std::string_view, ExportFormat>, 6> kExportFormats{
    {{"ros-map", ExportFormat::kRosMap},
     {"class-grids", ExportFormat::kClassGrids},
     {"octomap", ExportFormat::kOctomap},
     {"color-octomap", ExportFormat::kColorOctomap},
     {"ply", ExportFormat::kPly},
     {"geojson", ExportFormat::kGeojson}}};

std::string joined(std::span<const std::string> names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

Result<ExportFormat> parse_export_format(std::string_view name) {
  std::string known;
  for (const auto& [known_name, format] : kExportFormats) {
    if (known_name == name) return format;
    known += (known.empty() ? "" : ", ") + std::string(known_name);
  }
  return fail(ErrorCode::kInvalidArgument,
              "must be one of " + known + ", is '" + std::string(name) + "'",
              "--format");
}

Result<std::optional<std::set<ClassId>>> wanted_classes(const MapArchive& archive,
                                                        const ExportRequest& request) {
  if (request.classes.empty()) return std::optional<std::set<ClassId>>();
  std::set<ClassId> ids;
  for (const std::string& name : request.classes) {
    const auto id = archive.classes.find(name);
    if (!id) {
      return fail(ErrorCode::kNotFound,
                  "'" + name + "' is no class of this map, which knows " +
                      joined(archive.classes.names()) + did_you_mean(name, archive.classes.names()),
                  "--class");
    }
    ids.insert(*id);
  }
  return std::optional(std::move(ids));
}

Result<WrittenFiles> export_map(const MapArchive& archive, const ExportRequest& request) {
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
  }
  return fail(ErrorCode::kUnsupported, "unknown format");
}

}  // namespace hypermap
