// SPDX-License-Identifier: BSD-3-Clause
#include "export_parts.hpp"
#include "map_file_pair.hpp"

namespace hypermap {
namespace {

/// A class name as a file name: nothing in it may lead elsewhere.
std::string file_name(const std::string& class_name) {
  std::string name;
  for (const char c : class_name) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '-' || c == '_' ||
                          (static_cast<unsigned char>(c) & 0x80U) != 0;
    name += is_plain ? c : '_';
  }
  return name;
}

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
  std::error_code failed;
  std::filesystem::create_directories(request.output, failed);
  if (failed) {
    return Unexpected(Error{ErrorCode::kIo, failed.message(), request.output.string()});
  }
  WrittenFiles written;
  for (const ClassGrid& grid : archive.class_grids) {
    if (!is_wanted(grid, archive, wanted)) continue;
    HYPERMAP_ASSIGN_OR_RETURN(const WrittenFiles pair,
                              write_map_pair(OccupancyLayer{grid.grid},
                                             request.output / file_name(grid.class_name),
                                             request.keep_rotation));
    written.insert(written.end(), pair.begin(), pair.end());
  }
  return written;
}

}  // namespace hypermap
