// SPDX-License-Identifier: BSD-3-Clause
#include "output_ending.hpp"

#include "hypermap/core/base/class_registry.hpp"

#include <algorithm>
#include <string>

namespace hypermap {
namespace {

struct Ending {
  std::string_view text;  ///< Empty: any, and so for the next.
  std::string_view other = {};
  bool may_lack = false;
};

Ending ending_of(ExportFormat format) {
  switch (format) {
    case ExportFormat::kOctomap:
      return {.text = ".ot", .other = ".bt"};
    case ExportFormat::kColorOctomap:
      return {.text = ".ot"};
    case ExportFormat::kPly:
      return {.text = ".ply", .may_lack = true};
    case ExportFormat::kGlb:
      return {.text = ".glb", .may_lack = true};
    case ExportFormat::kGeopackage:
      return {.text = ".gpkg", .may_lack = true};
    case ExportFormat::kGeojson:
      // Plain .geojson promises longitude and latitude (RFC 7946); these are metres of the map.
      return {.text = ".local.geojson"};
    case ExportFormat::kRelations:
      return {.text = ".dot", .other = ".local.geojson"};
    case ExportFormat::kTopologicalMap:
      return {.text = ".dot"};
    case ExportFormat::kRosMap:
    case ExportFormat::kClassGrids:
    case ExportFormat::kTiles:
    case ExportFormat::kViews:
    case ExportFormat::kNav2:
      break;
  }
  return {};
}

}  // namespace

bool has_ending(const ExportRequest& request, std::string_view ending) {
  const std::string name = request.output.filename().string();
  if (ending.empty() || name.size() < ending.size()) return false;
  return is_spelling_of(std::string_view(name).substr(name.size() - ending.size()), ending);
}

Result<void> check_ending(const ExportRequest& request) {
  const Ending wanted = ending_of(request.format);
  const bool is_missing = wanted.may_lack && request.output.extension().empty();
  if (wanted.text.empty() || is_missing || has_ending(request, wanted.text) ||
      has_ending(request, wanted.other)) {
    return {};
  }
  std::string endings(wanted.text);
  if (!wanted.other.empty()) endings.append(" or ").append(wanted.other);
  const bool is_geojson = wanted.text == ".local.geojson" || wanted.other == ".local.geojson";
  return fail(ErrorCode::kInvalidArgument,
              "must end in " + endings + (is_geojson ? " (it is in metres of the map)" : "") +
                  ", is '" + printable(request.output.string()) + "'",
              "--output");
}

}  // namespace hypermap
