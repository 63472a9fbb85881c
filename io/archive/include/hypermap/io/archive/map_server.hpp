// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Occupancy grids as others keep them: a YAML file and an image.
///
/// Source: [hypermap] 3.3.5 (occupancy files); ROS wiki, map_server.
/// Row 0 of the image is the top, row 0 of a grid the bottom. With c the grey value, p = (255 -
/// c) / 255 (p = c / 255 when negated); occupied when p > occupied_thresh, free when p <
/// free_thresh.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/base/value_tree.hpp"
#include "hypermap/io/codec/file_reach.hpp"
#include "hypermap/io/codec/image_file.hpp"
#include "hypermap/io/codec/source_name.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"
#include "hypermap/projection/layers/hypermap.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

namespace hypermap {

enum class MapMode {
  kTrinary,  ///< Occupied, free or unknown.
  kScale,    ///< Between the thresholds in proportion.
  kRaw,      ///< The grey value is the occupancy.
};

/// Where readers of the same files differ.
enum class MapDialect {
  /// [hypermap] 3.3.5: any alpha below full is unknown; between the thresholds 100 r, rounded; a
  /// raw
  /// value is taken as it is (255 is -1), others above 100 are unknown and counted as a finding.
  kHypermap,
  /// ROS: in trinary mode alpha is averaged with the colours; in scale mode alpha below full is
  /// unknown
  /// and r is truncated to 99 r; raw values above 100 are unknown.
  kMapServer,
};

/// What the YAML file says.
struct MapMetadata {
  std::string image;
  double resolution_m = 0.05;         ///< 1e-6 to 1e3.
  std::array<double, 3> origin = {};  ///< x, y, yaw of the lower-left corner.
  bool negate = false;
  double occupied_thresh = 0.65;  ///< 0 to 1, not below free_thresh.
  double free_thresh = 0.196;     ///< 0 to 1.
  MapMode mode = MapMode::kTrinary;
  ValueTree extra = {};  ///< Unknown keys, as a map; null when there are none.
};

/// Errors: kMalformedFile naming the field: a missing key (`mode` alone may be missing), a wrong
/// type, a number outside its range, swapped thresholds, an unknown mode. `negate` may be 0, 1 or a
/// truth value. Unknown keys are findings.
[[nodiscard]] Result<Loaded<MapMetadata>> parse_map_metadata(std::string_view yaml,
                                                             const SourceName& source);

/// Turns an image into occupancies. Errors: kLimit; kInterrupted when `budget` is told to stop, of
/// which nothing is drawn: the image was.
/// Deviation: a PGM of another maxval and 16-bit images are scaled to 0..255 (their full
/// precision counts in p), where the first implementation reads 8 bit only.
[[nodiscard]] Result<Loaded<OccupancyGrid>> grid_from_image(const DecodedImage& image,
                                                            const MapMetadata& metadata,
                                                            MapDialect dialect,
                                                            const LoadBudget& budget = {});

/// A map on disk; the image is looked for beside the YAML file, within `reach`. The pixels that its
/// header declares are drawn from `budget` before it is decoded.
/// Findings: also an image whose name says that it is another (hashed_image_name).
/// Errors: those above, of read_image_file, check_reach and LoadBudget, and kIo. Nothing is half
/// loaded.
[[nodiscard]] Result<Loaded<OccupancyLayer>> read_map(const std::filesystem::path& yaml_path,
                                                      MapDialect dialect = MapDialect::kMapServer,
                                                      FileReach reach = FileReach::kAnywhere,
                                                      const LoadBudget& budget = {});

/// The bytes of a map's two files.
struct MapFiles {
  std::string yaml;
  std::string image;
};

/// The strict form of archives: scale mode, thresholds 1 and 0, PNG of grey and alpha: 100 is (0,
/// 255), 0 is (255, 255), unknown (127, 0). Reading it as kHypermap gives the same grid. Errors:
/// kInvalidArgument when the grid has no cells.
[[nodiscard]] Result<MapFiles> write_scale_map(const OccupancyLayer& layer,
                                               const std::string& image_name);

/// The form for ROS: trinary, PGM P5: free 254, unknown 205 (so is every value between), occupied
/// 0; thresholds 0.65 and 0.196. Errors: kInvalidArgument when the grid has no cells.
[[nodiscard]] Result<MapFiles> write_trinary_map(const OccupancyLayer& layer,
                                                 const std::string& image_name);

/// The form of filter masks: raw, PGM P5 whose grey values are the occupancies, unknown 255. All
/// readers of either dialect give the same grid. Errors: kInvalidArgument when the grid has no
/// cells.
[[nodiscard]] Result<MapFiles> write_raw_map(const OccupancyLayer& layer,
                                             const std::string& image_name);

/// The same area without a turn, for consumers that ignore the origin's yaw: each new cell takes
/// the most occupied of the old cells that it meets, unknown before free. Boundary: a grid without
/// yaw is returned as it is. Errors: kLimit when the new grid would be too large.
[[nodiscard]] Result<OccupancyGrid> without_rotation(const OccupancyGrid& grid);

}  // namespace hypermap
