// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/listed_instances_file.hpp"

#include "hypermap/io/codec/bounded_yaml.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr std::int64_t kMaxFrame = 1'000'000'000'000;
constexpr std::size_t kMaxTextBytes = 256;
constexpr std::size_t kMaxClasses = 16;
constexpr std::size_t kMaxMarks = 1000;

Unexpected refuse(const YamlNode& node,
                  std::string what,
                  ErrorCode code = ErrorCode::kMalformedFile) {
  return Unexpected(node.error(std::move(what), code));
}

Result<void> require_keys(const YamlNode& node, std::span<const std::string_view> known) {
  if (!node.is_map()) return refuse(node, "must be a map");
  const std::vector<Finding> unknown = node.unknown_keys(known);
  if (!unknown.empty()) return Unexpected(unknown.front().error);
  return {};
}

Result<std::string> read_text(const YamlNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(std::string text, node.as_string());
  if (text.empty() || text.size() > kMaxTextBytes)
    return refuse(node, "must have 1 to 256 bytes, has " + std::to_string(text.size()));
  return text;
}

Result<std::string> read_text_at(const YamlNode& map, std::string_view key) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode node, map.at(key));
  return read_text(node);
}

Result<bool> read_flag(const YamlNode& map, std::string_view key) {
  const auto node = map.find(key);
  if (!node) return false;
  return node->as_bool();
}

/// Three numbers within [min, max].
Result<Eigen::Vector3d> read_vector(const YamlNode& map,
                                    std::string_view key,
                                    double min,
                                    double max) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode node, map.at(key));
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> items, node.as_list());
  if (items.size() != 3)
    return refuse(node, "must have 3 numbers, has " + std::to_string(items.size()));
  Eigen::Vector3d vector;
  for (std::size_t i = 0; i < 3; ++i) {
    HYPERMAP_ASSIGN_OR_RETURN(vector[static_cast<Eigen::Index>(i)], items[i].as_double(min, max));
  }
  return vector;
}

Result<std::vector<YamlNode>> read_list(const YamlNode& node, std::size_t limit) {
  HYPERMAP_ASSIGN_OR_RETURN(std::vector<YamlNode> items, node.as_list());
  if (items.size() > limit)
    return refuse(node,
                  "must have " + std::to_string(limit) + " items or fewer, has " +
                      std::to_string(items.size()),
                  ErrorCode::kLimit);
  return items;
}

/// One class, or a list of those that are right.
Result<std::vector<std::string>> read_classes(const YamlNode& node) {
  if (!node.is_list()) {
    HYPERMAP_ASSIGN_OR_RETURN(std::string name, read_text(node));
    return std::vector<std::string>{std::move(name)};
  }
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> items, read_list(node, kMaxClasses));
  if (items.empty()) return refuse(node, "must have 1 class or more, has 0");
  std::vector<std::string> names;
  names.reserve(items.size());
  for (const YamlNode& item : items) {
    HYPERMAP_ASSIGN_OR_RETURN(std::string name, read_text(item));
    names.push_back(std::move(name));
  }
  return names;
}

Result<std::vector<std::string>> read_class_key(const YamlNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(const bool is_unnameable, read_flag(node, "unnameable"));
  const auto classes = node.find("class");
  if (classes && is_unnameable)
    return refuse(*classes, "must not be given together with `unnameable: true`");
  if (classes) return read_classes(*classes);
  if (!is_unnameable) return refuse(node, "must have `class` or `unnameable: true`, has neither");
  return std::vector<std::string>{};
}

Result<InstanceMark> read_mark(const YamlNode& node) {
  constexpr std::array<std::string_view, 2> kKeys{"frame", "pixel"};
  HYPERMAP_TRY(require_keys(node, kKeys));
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode frame_node, node.at("frame"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t frame, frame_node.as_int(0, kMaxFrame));
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode pixel, node.at("pixel"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> numbers, pixel.as_list());
  if (numbers.size() != 2)
    return refuse(pixel, "must be [column, row], has " + std::to_string(numbers.size()) + " items");
  HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t column, numbers[0].as_int(0, 65'535));
  HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t row, numbers[1].as_int(0, 65'535));
  return InstanceMark{.frame = static_cast<std::uint64_t>(frame),
                      .column = static_cast<int>(column),
                      .row = static_cast<int>(row)};
}

Result<void> read_place(const YamlNode& node, ListedInstance& instance) {
  HYPERMAP_ASSIGN_OR_RETURN(instance.centre.xyz, read_vector(node, "centre", -1000.0, 1000.0));
  HYPERMAP_ASSIGN_OR_RETURN(instance.size_m, read_vector(node, "size", 0.001, 1000.0));
  const auto yaw = node.find("yaw");
  if (!yaw) return {};
  HYPERMAP_ASSIGN_OR_RETURN(const double yaw_deg, yaw->as_double(-3600.0, 3600.0));
  instance.yaw_rad = kRadPerDeg * yaw_deg;
  return {};
}

Result<void> read_sightings(const YamlNode& node, ListedInstance& instance) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode first, node.at("first_frame"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t first_frame, first.as_int(0, kMaxFrame));
  instance.first_frame = static_cast<std::uint64_t>(first_frame);
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode marks, node.at("marks"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> items, read_list(marks, kMaxMarks));
  instance.marks.reserve(items.size());
  for (const YamlNode& item : items) {
    HYPERMAP_ASSIGN_OR_RETURN(const InstanceMark mark, read_mark(item));
    instance.marks.push_back(mark);
  }
  HYPERMAP_ASSIGN_OR_RETURN(instance.has_no_depth, read_flag(node, "no_depth"));
  HYPERMAP_ASSIGN_OR_RETURN(instance.is_never_whole, read_flag(node, "never_whole"));
  HYPERMAP_ASSIGN_OR_RETURN(instance.is_far, read_flag(node, "far"));
  return {};
}

Result<void> read_named_instance(const YamlNode& node, ListedInstance& instance) {
  constexpr std::array<std::string_view, 12> kKeys{"name",
                                                   "class",
                                                   "unnameable",
                                                   "description",
                                                   "centre",
                                                   "size",
                                                   "yaw",
                                                   "first_frame",
                                                   "marks",
                                                   "no_depth",
                                                   "never_whole",
                                                   "far"};
  HYPERMAP_TRY(require_keys(node, kKeys));
  HYPERMAP_ASSIGN_OR_RETURN(instance.class_names, read_class_key(node));
  if (const auto description = node.find("description")) {
    HYPERMAP_ASSIGN_OR_RETURN(instance.description, read_text(*description));
  }
  HYPERMAP_TRY(read_place(node, instance));
  return read_sightings(node, instance);
}

Result<ListedInstance> read_instance(const YamlNode& node) {
  ListedInstance instance;
  HYPERMAP_ASSIGN_OR_RETURN(instance.name, read_text_at(node, "name"));
  if (auto read = read_named_instance(node, instance); !read) {
    read.error().what += " (of thing " + printable(instance.name) + ")";
    return Unexpected(std::move(read).error());
  }
  return instance;
}

Result<void> check_format(const YamlNode& root) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode format, root.at("format"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string name, format.as_string());
  if (name != kListedInstancesFormat)
    return refuse(format,
                  "must be " + std::string(kListedInstancesFormat) + ", is " + printable(name),
                  ErrorCode::kUnsupported);
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode version, root.at("version"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t number,
                            version.as_int(0, std::numeric_limits<std::int32_t>::max()));
  if (number != 1)
    return refuse(version, "must be 1, is " + std::to_string(number), ErrorCode::kUnsupported);
  return {};
}

Result<ListedInstances> read_root(const YamlNode& root) {
  constexpr std::array<std::string_view, 5> kKeys{"format", "version", "sequence", "up", "things"};
  HYPERMAP_TRY(check_format(root));
  HYPERMAP_TRY(require_keys(root, kKeys));
  ListedInstances listed;
  HYPERMAP_ASSIGN_OR_RETURN(listed.sequence, read_text_at(root, "sequence"));
  HYPERMAP_ASSIGN_OR_RETURN(listed.up_in_input, read_vector(root, "up", -2.0, 2.0));
  const double length = listed.up_in_input.norm();
  if (!(std::abs(length - 1.0) <= 0.01)) {
    HYPERMAP_ASSIGN_OR_RETURN(const YamlNode up, root.at("up"));
    return refuse(up, "must have length 1 within 0.01, has " + std::to_string(length));
  }
  listed.up_in_input.normalize();
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode instances, root.at("things"));
  HYPERMAP_ASSIGN_OR_RETURN(const auto items, read_list(instances, kMaxListedInstances));
  listed.instances.reserve(items.size());
  std::set<std::string> names;
  for (const YamlNode& item : items) {
    HYPERMAP_ASSIGN_OR_RETURN(ListedInstance instance, read_instance(item));
    if (!names.insert(instance.name).second)
      return refuse(item, "two things are named " + printable(instance.name));
    listed.instances.push_back(std::move(instance));
  }
  return listed;
}

}  // namespace

Result<ListedInstances> parse_listed_instances(std::string_view bytes, const SourceName& source) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document,
                            parse_yaml(bytes, source, {.max_bytes = kMaxListedInstancesBytes}));
  return read_root(document.root());
}

Result<ListedInstances> load_listed_instances(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document,
                            read_yaml(path, {.max_bytes = kMaxListedInstancesBytes}));
  return read_root(document.root());
}

}  // namespace hypermap
