// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/transformed_map.hpp"

#include "hypermap/core/base/number_text.hpp"
#include "transformed_parts.hpp"

#include <cmath>
#include <new>
#include <string>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

constexpr std::string_view kMapFrame = "map";
constexpr double kMaxRotationError = 1e-6;
constexpr double kMaxTiltRad = 1e-6;
constexpr double kMaxShiftM = 1e6;

Result<UprightMotion> upright(const Eigen::Isometry3d& transform) {
  const auto refuse = [](const std::string& what) {
    return fail(ErrorCode::kInvalidArgument, what, "map_from_old");
  };
  if (!is_rigid(transform, kMaxRotationError)) return refuse("must be a finite rigid motion");
  const Eigen::Matrix3d rotation = transform.linear();
  const double tilt_rad = std::atan2(std::hypot(rotation(0, 2), rotation(1, 2)), rotation(2, 2));
  if (tilt_rad > kMaxTiltRad) {
    return refuse("must leave +z up, tilts it by " + std::to_string(tilt_rad) + " rad");
  }
  if (transform.translation().cwiseAbs().maxCoeff() > kMaxShiftM) {
    return fail(ErrorCode::kLimit, "must shift by at most 1e6 m", "map_from_old");
  }
  return UprightMotion{.yaw_rad = std::atan2(rotation(1, 0), rotation(0, 0)),
                       .shift_m = transform.translation()};
}

Unexpected unsupported(std::string_view part, std::string_view why) {
  return fail(ErrorCode::kUnsupported, std::string(why), std::string(part));
}

/// What has height and content that nobody here can move. Its frame moves in the plane only.
Result<void> check_moved_by_frame(std::string_view name,
                                  std::string_view frame_id,
                                  bool is_flat,
                                  const UprightMotion& motion) {
  if (frame_id == kMapFrame) return unsupported(name, "lies in frame map and cannot be moved");
  if (!is_flat && motion.shift_m.z() != 0.0) {
    return unsupported(name, "may have a height, which transforms of frames cannot raise or lower");
  }
  return {};
}

Result<void> check_extensions(const MapArchive& archive, const UprightMotion& motion) {
  for (const OctomapExtension& octomap : archive.octomaps) {
    HYPERMAP_TRY(check_moved_by_frame(octomap.entry.name, octomap.entry.frame_id, false, motion));
  }
  if (!archive.foreign_extensions.empty()) {
    return unsupported("extensions", "one of unknown format cannot be moved");
  }
  for (const std::string_view format :
       {kOctomapFormat, kObjectsFormat, kTopologicalMapFormat, kTrueSurfacesFormat}) {
    const auto entry = archive.extension_entries.find(format);
    if (entry == archive.extension_entries.end() || entry->second.frame_id == kMapFrame) continue;
    return unsupported(format, "must lie in frame map to be moved");
  }
  return {};
}

Result<FrameTree> moved_frames(const FrameTree& frames, const UprightMotion& motion) {
  const Eigen::Isometry2d map_from_old = motion.in_plane();
  FrameTree moved;
  for (FrameTransform transform : frames.transforms()) {
    Eigen::Isometry2d pose = transform.parent_from_child();
    if (transform.frame_id == kMapFrame) {
      pose = map_from_old * pose;
      transform.yaw_rad += motion.yaw_rad;
    } else if (transform.child_frame_id == kMapFrame) {
      pose = pose * map_from_old.inverse();
      transform.yaw_rad -= motion.yaw_rad;
    }
    transform.x_m = pose.translation().x();
    transform.y_m = pose.translation().y();
    HYPERMAP_TRY(moved.add(std::move(transform)));
  }
  return moved;
}

/// None when the layer is of another type.
template <class T>
std::optional<Result<LayerContent>> moved_as(const Layer& layer, const UprightMotion& motion) {
  const auto* content = layer.content.as<T>();
  if (content == nullptr) return std::nullopt;
  return transformed(*content, motion).map([](T moved) { return LayerContent(std::move(moved)); });
}

Result<LayerContent> moved_content(const Layer& layer, const UprightMotion& motion) {
  if (const auto* occupancy = layer.content.as<OccupancyLayer>()) {
    HYPERMAP_ASSIGN_OR_RETURN(OccupancyGrid grid, transformed(occupancy->grid, motion));
    return LayerContent(OccupancyLayer(std::move(grid), occupancy->extra));
  }
  if (const auto moved = moved_as<SemanticLayer>(layer, motion)) return *moved;
  if (const auto moved = moved_as<GridStackLayer>(layer, motion)) return *moved;
  if (const auto moved = moved_as<SupercellLayer>(layer, motion)) return *moved;
  return unsupported(layer.info.name, "lies in frame map and cannot be moved");
}

Result<void> move_layers(Hypermap& hypermap, const UprightMotion& motion) {
  const Hypermap old = hypermap;
  for (const Layer& layer : old.layers()) {
    if (layer.info.frame_id == kMapFrame) {
      HYPERMAP_ASSIGN_OR_RETURN(LayerContent content, moved_content(layer, motion));
      HYPERMAP_TRY(hypermap.set_content(layer.info.name, std::move(content)));
    } else {
      const bool is_flat = layer.content->is_flat() && layer.content.as<OpaqueLayer>() == nullptr;
      HYPERMAP_TRY(check_moved_by_frame(layer.info.name, layer.info.frame_id, is_flat, motion));
    }
  }
  HYPERMAP_ASSIGN_OR_RETURN(hypermap.frames(), moved_frames(old.frames(), motion));
  return {};
}

/// To whole micrometres: what rounding leaves of a motion there and back is no height.
Result<MapFloor> moved_floor(MapFloor floor, const UprightMotion& motion) {
  constexpr double kStepsPerM = 1e6;
  const double height_m = floor.height_m + motion.shift_m.z();
  if (!(std::abs(height_m) <= kMaxFloorHeightM)) {
    return fail(ErrorCode::kLimit,
                "must stay within " + number_text(kMaxFloorHeightM) + " m of z = 0, would be at " +
                    number_text(height_m) + " m",
                "floor");
  }
  floor.height_m = std::round(height_m * kStepsPerM) / kStepsPerM;
  return floor;
}

bool is_identity(const UprightMotion& motion) {
  return motion.yaw_rad == 0.0 && motion.shift_m.isZero(0.0);
}

Result<MapArchive> moved_archive(MapArchive archive, const UprightMotion& motion) {
  archive.checkpoint = {};  // no run goes on from a map that was moved
  if (is_identity(motion)) return archive;
  HYPERMAP_TRY(check_extensions(archive, motion));
  HYPERMAP_TRY(move_layers(archive.hypermap, motion));
  for (ClassGrid& grid : archive.class_grids) {
    if (grid.frame_id != kMapFrame) continue;
    HYPERMAP_ASSIGN_OR_RETURN(grid.grid, transformed(grid.grid, motion));
  }
  HYPERMAP_ASSIGN_OR_RETURN(archive.objects, transformed(archive.objects, motion));
  if (archive.topological_map) {
    HYPERMAP_ASSIGN_OR_RETURN(archive.topological_map,
                              transformed(*archive.topological_map, motion));
  }
  HYPERMAP_ASSIGN_OR_RETURN(archive.floor, moved_floor(archive.floor, motion));
  const MapFromOldMap map_from_old(motion.in_space());
  if (archive.octree) {
    HYPERMAP_ASSIGN_OR_RETURN(archive.octree, transformed(*archive.octree, map_from_old));
  }
  if (archive.true_surfaces) {
    archive.true_surfaces = transformed(*std::move(archive.true_surfaces), motion.in_space());
  }
  for (Provenance& run : archive.provenance) {
    run.map_from_input = MapFromInput(map_from_old.isometry() * run.map_from_input.isometry());
  }
  return archive;
}

}  // namespace

Result<MapArchive> transformed(const MapArchive& archive, const MapFromOldMap& map_from_old) {
  HYPERMAP_ASSIGN_OR_RETURN(const UprightMotion motion, upright(map_from_old.isometry()));
  try {
    return moved_archive(archive, motion);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for another map");
  }
}

}  // namespace hypermap
