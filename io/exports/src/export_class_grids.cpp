// SPDX-License-Identifier: BSD-3-Clause
#include "export_folder.hpp"
#include "export_parts.hpp"
#include "map_file_pair.hpp"

#include <algorithm>
#include <set>
#include <string>

namespace hypermap {
namespace {

bool is_wanted(const ClassGrid& grid,
               const MapArchive& archive,
               const std::optional<std::set<ClassId>>& wanted) {
  if (!wanted) return true;
  const auto id = archive.classes.find(grid.class_name);
  return id && wanted->contains(*id);
}

}  // namespace

Result<WrittenFiles> export_class_grids(const MapArchive& archive, const ExportRequest& request) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto wanted, wanted_classes(archive, request));
  if (archive.class_grids.empty()) return fail(ErrorCode::kNotFound, "the map has no class grids");
  const bool has_any = std::any_of(
      archive.class_grids.begin(), archive.class_grids.end(), [&](const ClassGrid& grid) {
        return is_wanted(grid, archive, wanted);
      });
  if (!has_any) return WrittenFiles{};
  HYPERMAP_TRY(make_export_folder(request.output));
  WrittenFiles written;
  FileNames names;
  for (const ClassGrid& grid : archive.class_grids) {
    const std::string name = names.add(grid.class_name);
    if (!is_wanted(grid, archive, wanted)) continue;
    HYPERMAP_ASSIGN_OR_RETURN(
        const WrittenFiles pair,
        write_map_pair(OccupancyLayer(grid.grid), request.output / name, request.keep_rotation));
    written.insert(written.end(), pair.begin(), pair.end());
  }
  return written;
}

}  // namespace hypermap
