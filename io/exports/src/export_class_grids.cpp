// SPDX-License-Identifier: BSD-3-Clause
#include "export_parts.hpp"
#include "hypermap/core/base/utf8.hpp"
#include "map_file_pair.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

namespace hypermap {
namespace {

constexpr std::size_t kMaxNameBytes = 200;  // leaves room for a number and an extension in 255

/// Letters of any script, digits, hyphens and underscores; no control character.
bool is_plain(std::string_view character) {
  const char c = character.front();
  if (character.size() > 1) return printable(character) == character;
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '_';
}

/// A class name as a file name: nothing in it may lead elsewhere.
std::string file_name(std::string_view class_name) {
  std::string name;
  while (!class_name.empty()) {
    const std::size_t length = std::max<std::size_t>(utf8_length(class_name, 0), 1);
    const std::string_view character = class_name.substr(0, length);
    if (name.size() + length > kMaxNameBytes) break;
    name += is_plain(character) ? character : "_";
    class_name.remove_prefix(length);
  }
  return name;
}

/// Names that differ although what makes classes differ may not stand in a file name.
class FileNames {
 public:
  std::string add(std::string_view class_name) {
    const std::string plain = file_name(class_name);
    std::string name = plain;
    for (int n = 2; !taken_.insert(name).second; ++n) name = plain + "-" + std::to_string(n);
    return name;
  }

 private:
  std::set<std::string> taken_;
};

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
  std::error_code failed;
  std::filesystem::create_directories(request.output, failed);
  if (failed) {
    return Unexpected(Error{ErrorCode::kIo, failed.message(), request.output.string()});
  }
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
