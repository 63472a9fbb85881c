// SPDX-License-Identifier: BSD-3-Clause
#include "nav2_parameters.hpp"

#include "hypermap/core/base/value_tree.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"

#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr const char* kSpeedTopic = "/speed_limit";

std::string info_topic(const Nav2Filter& filter) {
  return "/" + filter.name + "_filter_info";
}

std::string mask_server(const Nav2Filter& filter) {
  return filter.name + "_filter_mask_server";
}

std::string info_server(const Nav2Filter& filter) {
  return filter.name + "_costmap_filter_info_server";
}

/// A parameter that ROS takes as a floating-point number, which one without a point is not.
ValueTree make_double(std::string text) {
  return {.kind = ValueKind::kScalar, .text = std::move(text)};
}

/// A node's entry of a parameter file.
ValueTree::Entry node_parameters(std::string node, std::vector<ValueTree::Entry> parameters) {
  return {std::move(node), make_map({{"ros__parameters", make_map(std::move(parameters))}})};
}

ValueTree::Entry plugin_parameters(const Nav2Filter& filter) {
  std::vector<ValueTree::Entry> entries{{"plugin", make_text(filter.plugin)},
                                        {"enabled", make_bool(true)},
                                        {"filter_info_topic", make_text(info_topic(filter))}};
  if (filter.type != 0) entries.emplace_back("speed_limit_topic", make_text(kSpeedTopic));
  return {filter.name + "_filter", make_map(std::move(entries))};
}

/// Costmaps are nodes in a namespace of their own name.
ValueTree::Entry costmap_parameters(const std::string& costmap,
                                    const std::vector<Nav2Filter>& filters) {
  std::vector<ValueTree> names;
  names.reserve(filters.size());
  std::vector<ValueTree::Entry> parameters;
  for (const Nav2Filter& filter : filters) names.push_back(make_text(filter.name + "_filter"));
  parameters.emplace_back("filters", make_list(std::move(names)));
  for (const Nav2Filter& filter : filters) parameters.push_back(plugin_parameters(filter));
  return {costmap, make_map({node_parameters(costmap, std::move(parameters))})};
}

}  // namespace

Nav2Filter keepout_filter() {
  return {.name = "keepout", .plugin = "nav2_costmap_2d::KeepoutFilter", .type = 0};
}

Nav2Filter speed_filter() {
  return {.name = "speed", .plugin = "nav2_costmap_2d::SpeedFilter", .type = 1};
}

std::string filter_info_yaml(const Nav2Filter& filter, const std::string& frame_id) {
  const std::string mask_topic = "/" + filter.name + "_filter_mask";
  return "# For nav2_map_server's map_server and costmap_filter_info_server. yaml_filename is "
         "looked for from where\n# the server is started: give the whole path there.\n" +
         write_yaml(
             make_map({node_parameters(mask_server(filter),
                                       {{"yaml_filename", make_text(filter.name + "_mask.yaml")},
                                        {"topic_name", make_text(mask_topic)},
                                        {"frame_id", make_text(frame_id)}}),
                       node_parameters(info_server(filter),
                                       {{"type", make_number(filter.type)},
                                        {"filter_info_topic", make_text(info_topic(filter))},
                                        {"mask_topic", make_text(mask_topic)},
                                        {"base", make_double("0.0")},
                                        {"multiplier", make_double("1.0")}})}));
}

std::string nav2_params_yaml(const std::string& frame_id) {
  const Nav2Filter keepout = keepout_filter();
  const Nav2Filter speed = speed_filter();
  const std::vector<ValueTree> managed{make_text(mask_server(keepout)),
                                       make_text(info_server(keepout)),
                                       make_text(mask_server(speed)),
                                       make_text(info_server(speed))};
  return "# To be merged into a robot's own parameters; the servers of the masks have theirs in "
         "keepout_filter_info.yaml\n# and speed_filter_info.yaml.\n" +
         write_yaml(make_map(
             {node_parameters(
                  "map_server",
                  {{"yaml_filename", make_text("map.yaml")}, {"frame_id", make_text(frame_id)}}),
              costmap_parameters("global_costmap", {keepout, speed}),
              costmap_parameters("local_costmap", {keepout}),
              node_parameters("controller_server", {{"speed_limit_topic", make_text(kSpeedTopic)}}),
              node_parameters(
                  "lifecycle_manager_costmap_filters",
                  {{"autostart", make_bool(true)}, {"node_names", make_list(managed)}})}));
}

}  // namespace hypermap
