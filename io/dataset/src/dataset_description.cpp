// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/dataset_description.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/dataset/trajectory_file.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 23> kDescriptionKeys{"name",
                                                            "world",
                                                            "intrinsics",
                                                            "depth",
                                                            "depth_scale",
                                                            "invalid_depth",
                                                            "depth_rotated_bits",
                                                            "color",
                                                            "trajectory",
                                                            "trajectory_format",
                                                            "pair_by",
                                                            "pose_direction",
                                                            "camera_axes",
                                                            "up_axis",
                                                            "detections",
                                                            "stamp_tolerance_s",
                                                            "frame_rate_hz",
                                                            "depth_intrinsics",
                                                            "color_from_depth",
                                                            "labels",
                                                            "instances",
                                                            "label_names",
                                                            "description"};

template <class Value>
struct Choice {
  std::string_view name;
  Value value;
};

constexpr std::array<Choice<TrajectoryFormat>, 6> kTrajectoryFormats{
    {{"tum", TrajectoryFormat::kTum},
     {"log", TrajectoryFormat::kLog},
     {"matrix", TrajectoryFormat::kMatrix},
     {"lines", TrajectoryFormat::kLines},
     {"7scenes", TrajectoryFormat::kMatrix},
     {"open3d", TrajectoryFormat::kLog}}};
constexpr std::array<Choice<PosePairing>, 3> kPairings{{{"stamp", PosePairing::kStamp},
                                                        {"number", PosePairing::kNumber},
                                                        {"order", PosePairing::kOrder}}};
constexpr std::array<Choice<PoseDirection>, 2> kDirections{
    {{"camera_to_world", PoseDirection::kCameraToWorld},
     {"world_to_camera", PoseDirection::kWorldToCamera}}};
constexpr std::array<Choice<CameraAxes>, 3> kAxes{{{"optical", CameraAxes::kOptical},
                                                   {"opengl", CameraAxes::kOpenGl},
                                                   {"robot", CameraAxes::kRobot}}};
constexpr std::array<Choice<std::string_view>, 6> kUpAxes{
    {{"x", "x"}, {"-x", "-x"}, {"y", "y"}, {"-y", "-y"}, {"z", "z"}, {"-z", "-z"}}};

/// The value of `key` among named choices; `fallback` when the key is absent.
template <class Value, std::size_t N>
Result<Value> choose(const YamlNode& root,
                     std::string_view key,
                     const std::array<Choice<Value>, N>& choices,
                     Value fallback) {
  const auto node = root.find(key);
  if (!node) return fallback;
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, node->as_string());
  std::vector<std::string_view> names;
  for (const Choice<Value>& choice : choices) {
    if (choice.name == text) return choice.value;
    names.push_back(choice.name);
  }
  return Unexpected(node->error(not_one_of(text, names)));
}

/// A path that stays in the folder.
Result<std::string> inner_path(const YamlNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(std::string text, node.as_string());
  const std::filesystem::path path(text);
  const bool leaves = std::any_of(
      path.begin(), path.end(), [](const std::filesystem::path& part) { return part == ".."; });
  if (!text.empty() && !path.is_absolute() && !leaves && text.find('\0') == std::string::npos) {
    return text;
  }
  return Unexpected(
      node.error("must be a path inside the dataset's folder, is " + printable(text)));
}

Result<std::string> optional_path(const YamlNode& root, std::string_view key) {
  const auto node = root.find(key);
  if (!node) return std::string{};
  return inner_path(*node);
}

struct RequiredKey {
  std::string_view name;
  std::string_view example;
};
constexpr std::array<RequiredKey, 4> kRequiredKeys{
    {{"intrinsics",
      "intrinsics: {width: 640, height: 480, fx: 525, fy: 525, cx: 319.5, cy: 239.5}"},
     {"depth", "depth: depth/*.png"},
     {"depth_scale", kDepthScaleExample},
     {"trajectory", "trajectory: poses.txt"}}};

/// A file of intrinsics may name the scale itself.
bool may_be_missing(const YamlNode& root, std::string_view key) {
  const auto intrinsics = root.find("intrinsics");
  return key == "depth_scale" && intrinsics && intrinsics->is_scalar();
}

/// Errors: kMalformedFile naming all required keys that are missing, an example of each.
Result<void> check_required_keys(const YamlNode& root) {
  HYPERMAP_TRY(root.as_map());
  std::string names;
  std::string examples;
  for (const RequiredKey& key : kRequiredKeys) {
    if (root.find(key.name) || may_be_missing(root, key.name)) continue;
    names.append(names.empty() ? "" : ", ").append(key.name);
    examples.append("; ").append(key.example);
  }
  if (names.empty()) return {};
  return Unexpected(root.error("must name " + names + ", for example: " + examples.substr(2)));
}

Result<std::string> required_path(const YamlNode& root, std::string_view key) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode node, root.at(key));
  return inner_path(node);
}

Result<Intrinsics> inline_intrinsics(const YamlNode& node) {
  constexpr double kHuge = 1e6;
  const auto number = [&](std::string_view key, double min) -> Result<double> {
    HYPERMAP_ASSIGN_OR_RETURN(const YamlNode value, node.at(key));
    return value.as_double(min, kHuge);
  };
  Intrinsics out;
  HYPERMAP_ASSIGN_OR_RETURN(out.fx_px, number("fx", 1e-3));
  HYPERMAP_ASSIGN_OR_RETURN(out.fy_px, number("fy", -kHuge));
  if (out.fy_px < 1e-3) {
    HYPERMAP_ASSIGN_OR_RETURN(const YamlNode fy, node.at("fy"));
    return Unexpected(
        fy.error("must be >= 0.001, is " + json_number(out.fy_px) + rows_up_hint(out.fy_px)));
  }
  HYPERMAP_ASSIGN_OR_RETURN(out.cx_px, number("cx", -kHuge));
  HYPERMAP_ASSIGN_OR_RETURN(out.cy_px, number("cy", -kHuge));
  for (const auto& [key, side] : {std::pair{"width", &out.width_px}, {"height", &out.height_px}}) {
    const auto value = node.find(key);
    if (!value) continue;
    HYPERMAP_ASSIGN_OR_RETURN(const auto pixels, value->as_int(1, 65'535));
    *side = static_cast<int>(pixels);
  }
  return out;
}

/// Numbers in place, or the path of a file with them.
Result<void> read_intrinsics_key(const YamlNode& root,
                                 std::string_view key,
                                 std::optional<Intrinsics>& numbers,
                                 std::string& file) {
  const auto node = root.find(key);
  if (!node) return {};
  if (node->is_map()) {
    HYPERMAP_ASSIGN_OR_RETURN(numbers, inline_intrinsics(*node));
    return {};
  }
  HYPERMAP_ASSIGN_OR_RETURN(file, inner_path(*node));
  return {};
}

Result<DepthFormat> read_depth_format(const YamlNode& root) {
  DepthFormat format;
  if (const auto node = root.find("depth_scale")) {
    HYPERMAP_ASSIGN_OR_RETURN(format.units_per_m, node->as_double(1e-3, 1e6));
  }
  if (const auto node = root.find("depth_rotated_bits")) {
    HYPERMAP_ASSIGN_OR_RETURN(const auto bits, node->as_int(0, 15));
    format.rotated_left_bits = static_cast<int>(bits);
  }
  const auto node = root.find("invalid_depth");
  if (!node) return format;
  HYPERMAP_ASSIGN_OR_RETURN(const auto items, node->as_list());
  format.invalid_values.clear();
  for (const YamlNode& item : items) {
    HYPERMAP_ASSIGN_OR_RETURN(const auto value, item.as_int(0, 65'535));
    format.invalid_values.push_back(static_cast<std::uint16_t>(value));
  }
  return format;
}

Result<double> number_or(
    const YamlNode& root, std::string_view key, double fallback, double min, double max) {
  const auto node = root.find(key);
  if (!node) return fallback;
  return node->as_double(min, max);
}

Result<std::vector<std::string>> read_detections_key(const YamlNode& root) {
  std::vector<std::string> out;
  const auto node = root.find("detections");
  if (!node) return out;
  if (!node->is_list()) {
    HYPERMAP_ASSIGN_OR_RETURN(std::string path, inner_path(*node));
    out.push_back(std::move(path));
    return out;
  }
  HYPERMAP_ASSIGN_OR_RETURN(const auto items, node->as_list());
  for (const YamlNode& item : items) {
    HYPERMAP_ASSIGN_OR_RETURN(std::string path, inner_path(item));
    out.push_back(std::move(path));
  }
  return out;
}

Result<Eigen::Isometry3d> read_extrinsics(const YamlNode& root) {
  const auto node = root.find("color_from_depth");
  if (!node) return Eigen::Isometry3d::Identity();
  HYPERMAP_ASSIGN_OR_RETURN(const auto numbers, node->as_doubles(16));
  auto pose = rigid_from_rows(numbers, 1e-2);
  if (!pose) return Unexpected(node->error(pose.error().field + ": " + pose.error().what));
  return pose;
}

PosePairing usual_pairing(TrajectoryFormat format) {
  if (format == TrajectoryFormat::kTum) return PosePairing::kStamp;
  return format == TrajectoryFormat::kLines ? PosePairing::kOrder : PosePairing::kNumber;
}

Result<void> read_trajectory_keys(const YamlNode& root, DatasetDescription& out) {
  HYPERMAP_ASSIGN_OR_RETURN(out.trajectory, required_path(root, "trajectory"));
  HYPERMAP_ASSIGN_OR_RETURN(
      out.trajectory_format,
      choose(root, "trajectory_format", kTrajectoryFormats, TrajectoryFormat::kTum));
  HYPERMAP_ASSIGN_OR_RETURN(
      out.pair_by, choose(root, "pair_by", kPairings, usual_pairing(out.trajectory_format)));
  HYPERMAP_ASSIGN_OR_RETURN(
      out.pose_direction,
      choose(root, "pose_direction", kDirections, PoseDirection::kCameraToWorld));
  HYPERMAP_ASSIGN_OR_RETURN(out.camera_axes,
                            choose(root, "camera_axes", kAxes, CameraAxes::kOptical));
  if (root.find("up_axis")) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string_view axis,
                              choose(root, "up_axis", kUpAxes, std::string_view{"z"}));
    out.up_axis = std::string(axis);
  }
  return {};
}

Result<void> read_image_keys(const YamlNode& root, DatasetDescription& out) {
  HYPERMAP_ASSIGN_OR_RETURN(out.depth, required_path(root, "depth"));
  HYPERMAP_ASSIGN_OR_RETURN(out.color, optional_path(root, "color"));
  HYPERMAP_ASSIGN_OR_RETURN(out.labels, optional_path(root, "labels"));
  HYPERMAP_ASSIGN_OR_RETURN(out.instances, optional_path(root, "instances"));
  HYPERMAP_ASSIGN_OR_RETURN(out.label_names, optional_path(root, "label_names"));
  HYPERMAP_ASSIGN_OR_RETURN(out.depth_format, read_depth_format(root));
  HYPERMAP_TRY(read_intrinsics_key(root, "intrinsics", out.intrinsics, out.intrinsics_file));
  HYPERMAP_TRY(read_intrinsics_key(
      root, "depth_intrinsics", out.depth_intrinsics, out.depth_intrinsics_file));
  out.names_depth_scale = root.find("depth_scale").has_value();
  HYPERMAP_ASSIGN_OR_RETURN(out.color_from_depth, read_extrinsics(root));
  return {};
}

}  // namespace

Result<Loaded<DatasetDescription>> read_dataset_description(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, read_yaml(path));
  const YamlNode root = document.root();
  HYPERMAP_TRY(check_required_keys(root));
  DatasetDescription out;
  if (const auto name = root.find("name")) {
    HYPERMAP_ASSIGN_OR_RETURN(out.name, name->as_string());
  }
  if (const auto world = root.find("world")) {
    HYPERMAP_ASSIGN_OR_RETURN(out.world, world->as_string());
  }
  HYPERMAP_TRY(read_image_keys(root, out));
  HYPERMAP_TRY(read_trajectory_keys(root, out));
  HYPERMAP_ASSIGN_OR_RETURN(out.detections, read_detections_key(root));
  HYPERMAP_ASSIGN_OR_RETURN(
      out.stamp_tolerance_s,
      number_or(root, "stamp_tolerance_s", out.stamp_tolerance_s, 0.0, 3600.0));
  HYPERMAP_ASSIGN_OR_RETURN(out.frame_rate_hz,
                            number_or(root, "frame_rate_hz", out.frame_rate_hz, 1e-3, 1e4));
  return Loaded<DatasetDescription>{std::move(out), root.unknown_keys(kDescriptionKeys)};
}

}  // namespace hypermap
