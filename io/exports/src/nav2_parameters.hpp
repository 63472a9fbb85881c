// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace hypermap {

/// A costmap filter of Nav2, by the names that its nodes and topics have in the files of a bundle.
struct Nav2Filter {
  std::string name;    ///< `keepout` or `speed`.
  std::string plugin;  ///< Its class in nav2_costmap_2d.
  int type = 0;        ///< Of nav2_msgs/CostmapFilterInfo: 0 keepout, 1 speed in per cent.
};

[[nodiscard]] Nav2Filter keepout_filter();
[[nodiscard]] Nav2Filter speed_filter();

/// Parameters of the two servers of a filter, as a ROS 2 parameter file: of the mask and of what it
/// means. The mask's values are meant as they are: base 0, multiplier 1.
[[nodiscard]] std::string filter_info_yaml(const Nav2Filter& filter, const std::string& frame_id);

/// What a robot's own parameters need besides: the map, both filters in its costmaps, the topic of
/// speed limits, the nodes to be managed.
[[nodiscard]] std::string nav2_params_yaml(const std::string& frame_id);

}  // namespace hypermap
