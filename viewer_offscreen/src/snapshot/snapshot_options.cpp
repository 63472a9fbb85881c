// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/snapshot/snapshot_options.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/base/option_rows.hpp"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::int64_t kMaxDrawnPixels = std::int64_t{1} << 25U;

constexpr OptionRange kSidePx{64, 8192};

constexpr OptionRow kSnapshotRows[] = {
    option::count<&SnapshotOptions::width_px>(
        "width_px", kSidePx, {.unit = "px", .effect = "Of the image."}),
    option::count<&SnapshotOptions::height_px>(
        "height_px", kSidePx, {.unit = "px", .effect = "Of the image."}),
    option::count<&SnapshotOptions::supersampling>(
        "supersampling", {1, 4}, {.effect = "Drawn so many times larger, then averaged."}),
    option::number<&SnapshotOptions::cut_above_m>(
        "cut_above_m",
        {-kUnbounded, kUnbounded},
        {.unit = "m",
         .effect = "What lies higher over the floor is left out; none: below the ceiling."}),
    option::flag<&SnapshotOptions::cut_near_walls>(
        "cut_near_walls", {.effect = "Iso view: walls between the eye and the room are cut low."}),
    option::flag<&SnapshotOptions::annotations>(
        "annotations", {.effect = "Title, legend, scale bar, axes, labels."}),
};

constexpr OptionRow kIsoRows[] = {
    option::number<&IsoView::azimuth_deg>(
        "azimuth_deg",
        {-360, 360},
        {.unit = "degrees", .effect = "Where the eye stands; 0 is +x, 90 is +y."}),
    option::number<&IsoView::elevation_deg>(
        "elevation_deg", {5, 85}, {.unit = "degrees", .effect = "Of the eye over the horizon."}),
};

constexpr OptionRow kPoseRows[] = {
    option::number<&PoseView::horizontal_fov_deg>(
        "horizontal_fov_deg",
        {10, 150},
        {.unit = "degrees", .effect = "Without a camera to imitate."}),
};

constexpr std::array<std::pair<std::string_view, bool SnapshotLayers::*>, 6> kLayerNames{{
    {"voxels", &SnapshotLayers::voxels},
    {"objects", &SnapshotLayers::objects},
    {"occupancy", &SnapshotLayers::occupancy},
    {"semantic", &SnapshotLayers::semantic},
    {"trajectory", &SnapshotLayers::trajectory},
    {"overlay", &SnapshotLayers::overlay},
}};

std::vector<std::string_view> names_of_layers() {
  std::vector<std::string_view> names;
  names.reserve(kLayerNames.size() + 1);
  for (const auto& [name, member] : kLayerNames) names.push_back(name);
  names.emplace_back("all");
  return names;
}

Result<void> check_view(const IsoView& view) {
  return check_options(view);
}

Result<void> check_view(const TopView& /*view*/) {
  return {};
}

Result<void> check_view(const PoseView& view) {
  if (!view.map_from_camera.isometry().matrix().allFinite()) {
    return fail(ErrorCode::kInvalidArgument, "must be finite", "map_from_camera");
  }
  if (view.camera) return validate(*view.camera);
  return check_options(view);
}

Result<void> check_drawn(const SnapshotOptions& options) {
  const std::int64_t drawn = std::int64_t{options.width_px} * options.height_px *
                             options.supersampling * options.supersampling;
  if (drawn > kMaxDrawnPixels) {
    return fail(ErrorCode::kInvalidArgument,
                "width x height x supersampling^2 must be at most " +
                    std::to_string(kMaxDrawnPixels) + ", is " + std::to_string(drawn),
                "supersampling");
  }
  return std::visit([](const auto& view) { return check_view(view); }, options.view);
}

template <class Number>
bool parse_whole(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

/// Cuts the first part off `rest`, up to any of the separators, and skips these.
std::string_view take_part(std::string_view& rest, std::string_view separators) {
  const std::size_t end = std::min(rest.find_first_of(separators), rest.size());
  const std::string_view part = rest.substr(0, end);
  const std::size_t next = std::min(rest.find_first_not_of(separators, end), rest.size());
  rest.remove_prefix(next);
  return part;
}

Unexpected no_view(std::string_view text) {
  constexpr std::array<std::string_view, 2> kNamed{"top", "iso"};
  return fail(ErrorCode::kInvalidArgument,
              "must be top, iso or seven numbers x y z qx qy qz qw, is \"" + printable(text, 80) +
                  "\"" + did_you_mean(text, kNamed),
              "view");
}

Result<SnapshotView> parse_pose(std::string_view text) {
  std::array<double, 7> numbers{};
  std::string_view rest = text;
  for (double& number : numbers) {
    if (!parse_whole(take_part(rest, ", "), number) || !std::isfinite(number)) {
      return no_view(text);
    }
  }
  if (!rest.empty()) return no_view(text);
  const Eigen::Quaterniond turn(numbers[6], numbers[3], numbers[4], numbers[5]);
  if (std::abs(turn.norm() - 1.0) > 0.01) {
    return fail(ErrorCode::kInvalidArgument,
                "the quaternion must have length 1, has " + number_text(turn.norm()),
                "view");
  }
  Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();
  map_from_camera.linear() = turn.normalized().toRotationMatrix();
  map_from_camera.translation() = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
  return PoseView{.map_from_camera = MapFromCamera(map_from_camera)};
}

}  // namespace

const OptionTable& option_table(const SnapshotOptions&) {
  static constexpr OptionTable kTable{kSnapshotRows, kRule<check_drawn>};
  return kTable;
}

const OptionTable& option_table(const IsoView&) {
  static constexpr OptionTable kTable{kIsoRows};
  return kTable;
}

const OptionTable& option_table(const PoseView&) {
  static constexpr OptionTable kTable{kPoseRows};
  return kTable;
}

Result<void> validate(const SnapshotOptions& options) {
  return check_options(options);
}

Result<SnapshotView> parse_snapshot_view(std::string_view text) {
  if (is_spelling_of(text, "top")) return TopView{};
  if (is_spelling_of(text, "iso")) return IsoView{};
  return parse_pose(text);
}

Result<SnapshotLayers> parse_snapshot_layers(std::string_view text) {
  SnapshotLayers layers;
  std::string_view rest = text;
  do {
    const std::string_view name = take_part(rest, ",");
    const bool is_all = is_spelling_of(name, "all");
    bool known = is_all;
    for (const auto& [layer_name, member] : kLayerNames) {
      if (!is_all && !is_spelling_of(name, layer_name)) continue;
      layers.*member = true;
      known = true;
    }
    if (!known) {
      return fail(ErrorCode::kInvalidArgument, not_one_of(name, names_of_layers()), "layers");
    }
  } while (!rest.empty());
  return layers;
}

Result<SnapshotSize> parse_image_size(std::string_view text) {
  const std::size_t cross = text.find('x');
  SnapshotSize size;
  if (cross == std::string_view::npos || !parse_whole(text.substr(0, cross), size.width_px) ||
      !parse_whole(text.substr(cross + 1), size.height_px)) {
    return fail(ErrorCode::kInvalidArgument,
                "must be WIDTHxHEIGHT, is \"" + printable(text, 80) + "\"",
                "size");
  }
  for (const int side_px : {size.width_px, size.height_px}) {
    if (kSidePx.contains(side_px)) continue;
    return fail(ErrorCode::kInvalidArgument,
                "must be in " + number_text(kSidePx.min) + ".." + number_text(kSidePx.max) +
                    ", is " + number_text(side_px),
                "size");
  }
  return size;
}

}  // namespace hypermap
