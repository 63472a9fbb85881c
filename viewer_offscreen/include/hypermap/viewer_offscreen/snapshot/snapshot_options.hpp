// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What an image of a map is to show, and from where.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/camera.hpp"
#include "hypermap/core/geometry/frames.hpp"

#include <filesystem>
#include <optional>
#include <string_view>
#include <variant>

namespace hypermap {

struct OptionTable;

/// From straight above, north (+y of the map) up, to scale.
struct TopView {};

/// From above at an angle, parallel lines stay parallel, so that the scale bar holds everywhere.
struct IsoView {
  /// Where the eye stands as seen from the scene; 0 is +x, 90 is +y. -360 .. 360.
  double azimuth_deg = -120.0;
  double elevation_deg = 42.0;  ///< Of the eye over the horizon, 5 .. 85.
};

/// From where a camera stands, as a camera sees.
struct PoseView {
  MapFromCamera map_from_camera = {};
  /// The camera to imitate, scaled to the image's size; none: `horizontal_fov_deg`.
  std::optional<PinholeCamera> camera = std::nullopt;
  double horizontal_fov_deg = 70.0;  ///< 10 .. 150.
};

using SnapshotView = std::variant<IsoView, TopView, PoseView>;

struct SnapshotLayers {
  bool voxels = false;      ///< Occupied voxels.
  bool objects = false;     ///< Boxes with labels.
  bool occupancy = false;   ///< The occupancy grid, on the floor.
  bool semantic = false;    ///< Polygons with labels, on the floor.
  bool trajectory = false;  ///< The camera's way.
  bool overlay = false;     ///< What layers of other types draw, on the floor.
  friend bool operator==(const SnapshotLayers&, const SnapshotLayers&) = default;
};

struct SnapshotOptions {
  SnapshotView view = IsoView{};
  int width_px = 1280;  ///< 64 .. 8192.
  int height_px = 720;  ///< 64 .. 8192.
  /// None: for the top view the 2D layers when the scene has any, else all that is 3D.
  std::optional<SnapshotLayers> layers = std::nullopt;
  int supersampling = 1;  ///< 1 .. 4: drawn so many times larger, then averaged, besides 4x MSAA.
  /// Top and iso view look into rooms: what lies higher over the floor than this is left out.
  /// Infinite shows all; none finds the ceiling, and cuts below it.
  std::optional<double> cut_above_m = std::nullopt;
  /// Iso view: tall unlabelled voxels (walls) between the eye and the room are cut low.
  bool cut_near_walls = true;
  bool annotations = true;  ///< Title, legend, scale bar, axes, labels.
  /// A TrueType font; empty: DejaVu Sans where systems keep it.
  std::filesystem::path font_file = {};
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const SnapshotOptions& options);
[[nodiscard]] const OptionTable& option_table(const SnapshotOptions& options);
[[nodiscard]] const OptionTable& option_table(const IsoView& view);
[[nodiscard]] const OptionTable& option_table(const PoseView& view);

/// "top", "iso", or a pose of the camera in the map as trajectory files write it: x y z qx qy qz
/// qw, separated by commas or blanks. Errors: kInvalidArgument.
[[nodiscard]] Result<SnapshotView> parse_snapshot_view(std::string_view text);

/// Names separated by commas: voxels objects occupancy semantic trajectory overlay; "all" is all of
/// them. Errors: kInvalidArgument naming the unknown name and the known ones.
[[nodiscard]] Result<SnapshotLayers> parse_snapshot_layers(std::string_view text);

struct SnapshotSize {
  int width_px = 0;
  int height_px = 0;
  friend bool operator==(SnapshotSize, SnapshotSize) = default;
};
/// "1280x720". Errors: kInvalidArgument when it is no size or a side is outside 64..8192.
[[nodiscard]] Result<SnapshotSize> parse_image_size(std::string_view text);

}  // namespace hypermap
