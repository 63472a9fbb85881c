// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// From when on objects count as standing on, in, under or beside each other, or as parts.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

struct OptionTable;

/// Edge of a voxel where nobody says one.
inline constexpr double kUsualVoxelM = 0.05;

/// Source: ours. Lengths that noise decides are in voxels: a coarser map is less exact.
struct RelationOptions {
  /// Edge of the map's voxels; columns of surfaces are as wide. None: as the map's octree has it,
  /// else `kUsualVoxelM`.
  std::optional<double> voxel_m = std::nullopt;
  double gap_voxels = 1.5;   ///< A foot may be so far above its support. Unit: voxel.
  double sink_voxels = 1.0;  ///< A foot may be so far below it. Unit: voxel.
  /// Height of the floor. Unit: metre. Frame: Map. None: as the map has it, else 0.
  std::optional<double> floor_m = std::nullopt;

  double min_support_share = 0.5;  ///< Share of a footprint over what it stands on.
  /// Share of the surface around the foot that lies at its height. What is beside a wall or below a
  /// table top has less.
  double min_surface_share = 0.3;

  double min_under_share = 0.5;  ///< Share of a plan that lies below the other's underside.
  double max_clearance_m = 1.0;  ///< Free height to what is above.

  double min_inside_share = 0.5;  ///< Share of a volume within what holds it.
  /// Classes that hold others.
  std::vector<std::string> holders = {"refrigerator",
                                      "oven",
                                      "microwave",
                                      "cupboard",
                                      "cabinet",
                                      "wardrobe",
                                      "bookshelf",
                                      "shelf",
                                      "sink",
                                      "bin",
                                      "box",
                                      "basket",
                                      "bowl",
                                      "cup",
                                      "vase",
                                      "backpack",
                                      "handbag",
                                      "suitcase"};

  double min_part_share = 0.8;     ///< Share of a part's volume within the whole.
  double min_contact_share = 0.5;  ///< Share of a part's surface on that of the whole.
  /// Which class is a part of which, as "part of whole".
  std::vector<std::string> parts = {
      "keyboard of laptop", "cushion of sofa", "pillow of sofa", "drawer of cabinet"};

  double reach_share = 1.0;    ///< Beside: gap over the smaller one's longest horizontal side.
  double least_reach_m = 0.2;  ///< Gap that small objects may have, too.
  double max_reach_m = 1.0;    ///< Gap that large objects may not exceed.
  /// Beside: feet differ at most by this share of the lower one's height, hidden feet, or by a
  /// contact's gap.
  double max_foot_share = 0.5;
  std::uint32_t max_beside = 4;  ///< Of an object: the nearest ones.
  friend bool operator==(const RelationOptions&, const RelationOptions&) = default;
};

/// Errors: kInvalidArgument naming the field and its range; a part that is not "part of whole".
[[nodiscard]] Result<void> validate(const RelationOptions& options);
[[nodiscard]] const OptionTable& option_table(const RelationOptions& options);

}  // namespace hypermap
