// SPDX-License-Identifier: BSD-3-Clause
#include "approach_arguments.hpp"

#include "option_flags.hpp"
#include "tables.hpp"

namespace hypermap::app {

void ApproachArguments::add_to(CLI::App& command) {
  const ApproachOptions defaults;
  const OptionTable& table = option_table(defaults);
  command.add_flag("--free-space",
                   free_space,
                   "--nearest by the way that a robot takes along the free space of the layer "
                   "occupancy, with that way; octree and 3D objects are not read");
  command
      .add_option(
          "--robot-radius",
          robot_radius_m,
          "radius of that robot in metres (default: " + fixed(defaults.robot_radius_m, 2) + ")")
      ->check(value_of_field(table, "robot_radius_m"));
  command
      .add_option("--reach",
                  reach_m,
                  "metres between its rim and an object's footprint, within which it has arrived "
                  "(default: " +
                      fixed(defaults.reach_m, 2) + ")")
      ->check(value_of_field(table, "reach_m"));
}

ApproachOptions ApproachArguments::options() const {
  ApproachOptions options;
  options.robot_radius_m = robot_radius_m.value_or(options.robot_radius_m);
  options.reach_m = reach_m.value_or(options.reach_m);
  return options;
}

}  // namespace hypermap::app
