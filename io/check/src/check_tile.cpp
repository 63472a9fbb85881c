// SPDX-License-Identifier: BSD-3-Clause
#include "file_checks.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/tiles/sogm_tile.hpp"
#include "hypermap/io/tiles/tile_file.hpp"
#include "hypermap/io/tiles/tile_folder.hpp"

#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

std::string tile_text(const GridGeometry& geometry, std::size_t num_layers) {
  return "tile of " + std::to_string(geometry.cols) + " x " + std::to_string(geometry.rows) +
         " cells of " + number_text(geometry.resolution_m) + " m, " +
         count_text(num_layers, "layer");
}

/// Each tile by itself; what is wrong with one is a finding.
Result<FileSummary> check_tile_folder(const std::filesystem::path& folder) {
  HYPERMAP_ASSIGN_OR_RETURN(std::vector<std::string> names, files_in(folder, ".tile"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<std::string> others, files_in(folder, ".bin"));
  names.insert(names.end(), others.begin(), others.end());
  FileSummary summary{"folder of " + count_text(names.size(), "tile"), {}};
  for (const std::string& name : names) {
    auto checked = check_tile(folder / name);
    if (!checked) {
      summary.findings.push_back(
          {Severity::kError,
           with_source(std::move(checked).error(), {.file = (folder / name).string()})});
      continue;
    }
    for (Finding& finding : checked->findings) {
      finding.error.file = (folder / name).string();
      summary.findings.push_back(std::move(finding));
    }
  }
  return summary;
}

}  // namespace

Result<FileSummary> check_tile(const std::filesystem::path& path) {
  std::error_code failed;
  if (std::filesystem::is_directory(path, failed)) return check_tile_folder(path);
  if (path.extension() != ".tile") {
    HYPERMAP_ASSIGN_OR_RETURN(const SogmTile tile, read_sogm_tile(path));
    return FileSummary{tile_text(tile.grid.geometry(), 1), {}};
  }
  HYPERMAP_ASSIGN_OR_RETURN(const FiledTile filed, read_tile_file(path));
  HYPERMAP_ASSIGN_OR_RETURN(const GridGeometry geometry,
                            geometry_of(filed.lattice, {.first = filed.tile.index}));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string expected,
                            tile_file_name(filed.lattice, filed.tile.index));
  FileSummary summary{tile_text(geometry, filed.tile.layers.size()), {}};
  if (path.filename() != expected) {
    summary.findings.push_back({Severity::kWarning,
                                {.code = ErrorCode::kMalformedFile,
                                 .what = "a folder of tiles with it is refused, by its content it "
                                         "must be called " +
                                         printable(expected, expected.size()),
                                 .field = "name"}});
  }
  return summary;
}

}  // namespace hypermap
