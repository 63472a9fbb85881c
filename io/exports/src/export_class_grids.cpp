// SPDX-License-Identifier: BSD-3-Clause
#include "export_folder.hpp"
#include "export_parts.hpp"
#include "hypermap/io/archive/footprint_grids.hpp"
#include "map_file_pair.hpp"

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

std::vector<std::string> class_names_of(const std::vector<ClassGrid>& grids) {
  std::vector<std::string> names;
  names.reserve(grids.size());
  for (const ClassGrid& grid : grids) names.push_back(grid.class_name);
  return names;
}

/// Those of `grids` whose class was asked for; a class without a grid that the map knows has none.
Result<std::set<std::string>> wanted_grids(const MapArchive& archive,
                                           const std::vector<ClassGrid>& grids,
                                           const ExportRequest& request) {
  std::vector<std::string> known = class_names_of(grids);
  std::set<std::string> wanted(known.begin(), known.end());
  if (request.classes.empty()) return wanted;
  known.insert(known.end(), archive.classes.names().begin(), archive.classes.names().end());
  HYPERMAP_ASSIGN_OR_RETURN(const NameSelection names,
                            wanted_names(archive, known, request.classes));
  std::erase_if(wanted, [&](const std::string& name) { return !names.contains(name); });
  return wanted;
}

}  // namespace

Result<WrittenFiles> export_class_grids(const MapArchive& archive, const ExportRequest& request) {
  std::vector<ClassGrid> grids = archive.class_grids;
  if (grids.empty()) {
    HYPERMAP_ASSIGN_OR_RETURN(FootprintGrids made, footprint_grids(archive));
    grids = std::move(made.grids);
  }
  HYPERMAP_ASSIGN_OR_RETURN(const std::set<std::string> wanted,
                            wanted_grids(archive, grids, request));
  if (wanted.empty()) return WrittenFiles{};
  HYPERMAP_TRY(make_export_folder(request.output));
  WrittenFiles written;
  FileNames names;
  for (const ClassGrid& grid : grids) {
    const std::string name = names.add(grid.class_name);
    if (!wanted.contains(grid.class_name)) continue;
    HYPERMAP_ASSIGN_OR_RETURN(
        const WrittenFiles pair,
        write_map_pair(OccupancyLayer(grid.grid), request.output / name, request.keep_rotation));
    written.insert(written.end(), pair.begin(), pair.end());
  }
  return written;
}

}  // namespace hypermap
