// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What stands in a recorded sequence, listed by hand, and where it lies in a map of it.
///
/// Files and prose call such an instance a thing, since "object" is what a map has.
///
/// Source: docs/EVALUATION.md, "Listed things"; data/truth/README.md.
#pragma once

#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/core/geometry/turned_box.hpp"

#include <Eigen/Geometry>

#include <cstdint>
#include <string>
#include <vector>

namespace hypermap {

namespace frame {
struct Instance {};  ///< Of one listed thing: origin at its centre, +x along its width, +z up.
}  // namespace frame

using InputFromInstance = Transform<frame::Input, frame::Instance>;

/// A pixel on a thing, for people.
struct InstanceMark {
  std::uint64_t frame = 0;  ///< The number in the picture's name.
  int column = 0;
  int row = 0;
  friend bool operator==(const InstanceMark&, const InstanceMark&) = default;
};

struct ListedInstance {
  std::string name;
  std::vector<std::string> class_names = {};  ///< All that are right; empty: there is no word.
  std::string description = {};
  Point<frame::Input> centre = {};                   ///< Of the whole thing.
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< Width, depth, height along `up`.
  double yaw_rad = 0.0;                              ///< Of the width, see `input_from_instance`.
  std::uint64_t first_frame = 0;                     ///< The first that shows it.
  std::vector<InstanceMark> marks = {};
  bool has_no_depth = false;    ///< The sensor measures nothing there.
  bool is_never_whole = false;  ///< Centre and size are guesses.
  bool is_far = false;          ///< Farther than 4 m from every camera.
};

struct ListedInstances {
  std::string sequence;  ///< Name of the dataset.
  Eigen::Vector3d up_in_input = Eigen::Vector3d::UnitZ();
  std::vector<ListedInstance> instances = {};
};

/// How a thing stands in the world of its sequence. `yaw_rad` turns about `up`, counter-clockwise
/// seen from above, from the input's x axis laid level; from its y axis where x lies within 45
/// degrees of `up` or its opposite.
/// Requires: up_in_input of length 1.
[[nodiscard]] InputFromInstance input_from_instance(const ListedInstance& instance,
                                                    const Eigen::Vector3d& up_in_input);

/// The smallest upright box around a thing, aligned to the axes of a map, as boxes of objects are.
[[nodiscard]] Box box_in_map(const ListedInstance& instance,
                             const Eigen::Vector3d& up_in_input,
                             const MapFromInput& map_from_input);

/// The thing's own upright box as it stands in the map: its width along the horizontal part of its
/// first axis there. Requires: that axis is not along the map's z.
[[nodiscard]] TurnedBox turned_box_in_map(const ListedInstance& instance,
                                          const Eigen::Vector3d& up_in_input,
                                          const MapFromInput& map_from_input);

}  // namespace hypermap
