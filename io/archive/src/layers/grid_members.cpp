// SPDX-License-Identifier: BSD-3-Clause
#include "grid_members.hpp"

#include "hypermap/io/codec/value_limits.hpp"

#include <cstdint>
#include <limits>

namespace hypermap {
namespace {

constexpr double kAnyYaw = std::numeric_limits<double>::max();

Result<int> side_of_key(const YamlNode& root, std::string_view key) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode node, root.at(key));
  HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t cells,
                            node.as_int(0, std::numeric_limits<std::uint16_t>::max()));
  return static_cast<int>(cells);
}

}  // namespace

void append_geometry(std::vector<ValueTree::Entry>& keys, const GridGeometry& geometry) {
  keys.emplace_back("resolution", make_number(geometry.resolution_m));
  keys.emplace_back("origin",
                    make_list({make_number(geometry.origin.x()),
                               make_number(geometry.origin.y()),
                               make_number(geometry.yaw_rad)}));
  keys.emplace_back("cols", make_number(geometry.cols));
  keys.emplace_back("rows", make_number(geometry.rows));
}

Result<GridGeometry> geometry_of_keys(const YamlNode& root) {
  GridGeometry geometry;
  HYPERMAP_ASSIGN_OR_RETURN(geometry.resolution_m, number_of_key(root, "resolution", 1e-6, 1e3));
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode origin, root.at("origin"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<double> pose, origin.as_doubles(3));
  geometry.origin = Eigen::Vector2d(pose[0], pose[1]);
  geometry.yaw_rad = pose[2];
  HYPERMAP_ASSIGN_OR_RETURN(geometry.cols, side_of_key(root, "cols"));
  HYPERMAP_ASSIGN_OR_RETURN(geometry.rows, side_of_key(root, "rows"));
  if (const auto valid = validate(geometry); !valid)
    return tl::make_unexpected(root.error(valid.error().what, valid.error().code));
  return geometry;
}

Result<double> number_of_key(const YamlNode& root, std::string_view key, double min, double max) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode node, root.at(key));
  return node.as_double(min, max);
}

Result<std::vector<std::string>> texts_of_key(const YamlNode& root, std::string_view key) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode node, root.at(key));
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> items, node.as_list());
  std::vector<std::string> texts;
  texts.reserve(items.size());
  for (const YamlNode& item : items) {
    HYPERMAP_ASSIGN_OR_RETURN(std::string text, item.as_string());
    texts.push_back(std::move(text));
  }
  return texts;
}

ValueTree make_text_list(std::span<const std::string> texts) {
  std::vector<ValueTree> items;
  items.reserve(texts.size());
  for (const std::string& text : texts) items.push_back(make_text(text));
  return make_list(std::move(items));
}

}  // namespace hypermap
