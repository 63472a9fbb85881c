// SPDX-License-Identifier: BSD-3-Clause
#include "tune_options.hpp"

#include "choices.hpp"
#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/base/preset_name.hpp"
#include "number_lists.hpp"
#include "option_flags.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <span>
#include <string_view>
#include <utility>

namespace hypermap::app {
namespace {

constexpr const char* kPolicyOption = "segmentation.policy";
constexpr const char* kAngleOption = "segmentation.region_growing.angle_threshold_rad";
constexpr const char* kCurvatureOption = "segmentation.region_growing.curvature_threshold";
constexpr const char* kLeafOption = "segmentation.leaf_size_m";
constexpr const char* kMaxRangeOption = "integration.max_range_m";

struct OptionValue {
  std::string_view name;
  std::string_view text;
};

/// A step that can be left out, the policies that have it, and the values without it.
struct OptionalStep {
  std::string_view name;
  std::array<bool, 3> is_in;  ///< By SegmentationPolicy: foreground, cluster, region growing.
  std::array<OptionValue, 2> off;
};

constexpr std::array<OptionalStep, 7> kOptionalSteps{{
    {"range",
     {true, true, true},
     {{{"segmentation.min_range_m", "0"}, {"segmentation.max_range_m", "100"}}}},
    {"voxel-grid", {false, true, true}, {{{kLeafOption, "0"}, {}}}},
    {"outliers", {false, true, false}, {{{"segmentation.outlier_neighbours", "0"}, {}}}},
    {"clusters", {false, true, false}, {{{"segmentation.cluster_gap_m", "0"}, {}}}},
    {"surroundings",
     {true, false, false},
     {{{"segmentation.foreground.context_share", "0"},
       {"segmentation.foreground.context_min_px", "0"}}}},
    {"planes", {true, false, false}, {{{"segmentation.foreground.max_planes", "0"}, {}}}},
    {"parts", {true, false, false}, {{{"segmentation.foreground.part_gap_m", "0"}, {}}}},
}};

std::vector<std::string> step_names() {
  std::vector<std::string> names;
  names.reserve(kOptionalSteps.size());
  for (const OptionalStep& step : kOptionalSteps) names.emplace_back(step.name);
  return names;
}

bool is_in(const OptionalStep& step, SegmentationPolicy policy) {
  return step.is_in.at(static_cast<std::size_t>(policy));
}

/// As the option's text.
std::optional<std::string> radians_of(std::optional<double> angle_deg) {
  if (!angle_deg) return std::nullopt;
  return number_text(*angle_deg * std::numbers::pi / 180.0);
}

Result<MapOptions> without_step(MapOptions options, std::string_view name) {
  const auto step = std::ranges::find(kOptionalSteps, name, &OptionalStep::name);
  const SegmentationPolicy policy = options.mapper.objects.segmentation.policy;
  if (!is_in(*step, policy)) {
    std::string known;
    for (const OptionalStep& one : kOptionalSteps) {
      if (is_in(one, policy)) known += (known.empty() ? "" : ", ") + std::string(one.name);
    }
    return fail(ErrorCode::kInvalidArgument,
                std::string(name) + " is no step of this policy, which has " + known,
                "--without");
  }
  for (const OptionValue& value : step->off) {
    if (value.name.empty()) continue;
    HYPERMAP_ASSIGN_OR_RETURN(options, with_option(options, value.name, value.text));
  }
  return options;
}

Result<MapOptions> with_setting(const MapOptions& options, const std::string& setting) {
  const std::size_t equals = setting.find('=');
  if (equals == 0 || equals == std::string::npos) {
    return fail(ErrorCode::kInvalidArgument,
                "must be NAME=VALUE, is '" + printable(setting) + "'",
                "--set");
  }
  return with_option(options, setting.substr(0, equals), setting.substr(equals + 1));
}

/// What is asked of a policy as such has its source's own values for all else of the segmentation.
Result<MapOptions> with_policy(MapOptions options, const std::optional<std::string>& policy) {
  if (!policy) return options;
  GeometricSegmentationOptions& segmentation = options.mapper.objects.segmentation;
  const SegmentationPolicy before = segmentation.policy;
  HYPERMAP_ASSIGN_OR_RETURN(options, with_option(options, kPolicyOption, *policy));
  if (segmentation.policy == before) return options;
  if (segmentation.policy == SegmentationPolicy::kCluster) segmentation = smap_segmentation();
  if (segmentation.policy == SegmentationPolicy::kRegionGrowing) {
    segmentation = hypermap_segmentation();
  }
  return options;
}

Result<void> check_growing_flags(const TuneOptions& arguments, const MapOptions& options) {
  const bool is_growing =
      options.mapper.objects.segmentation.policy == SegmentationPolicy::kRegionGrowing;
  if (is_growing || (!arguments.angle_deg && !arguments.curvature)) return {};
  return fail(ErrorCode::kInvalidArgument,
              "belongs to --policy region_growing, is given with " +
                  arguments.policy.value_or("foreground"),
              arguments.angle_deg ? "--angle" : "--curvature");
}

std::vector<std::string> steps_left_out(const TuneOptions& arguments) {
  std::vector<std::string> steps = arguments.without;
  if (arguments.no_outliers) steps.emplace_back("outliers");
  if (arguments.no_clusters) steps.emplace_back("clusters");
  return steps;
}

}  // namespace

void TuneOptions::add_to(CLI::App& command) {
  command.add_option("--preset", preset, "where options start from")
      ->transform(one_of(preset_names()))
      ->capture_default_str();
  command.add_option("--config", config, "YAML file of options, see `hypermap config`");
  command
      .add_option("--policy",
                  policy,
                  "how objects are separated from their surroundings, with the values of its "
                  "source (default: as the options say)")
      ->transform(choice_of_option(kPolicyOption));
  command.add_option("--angle", angle_deg, "region growing: degrees between normals")
      ->check(number_in(0.0, 90.0));
  command.add_option("--curvature", curvature, "region growing: of points that lead on")
      ->check(value_of_option(kCurvatureOption));
  command.add_option("--leaf-size", leaf_size_m, "voxel grid, metres; 0 leaves it out")
      ->check(value_of_option(kLeafOption));
  command.add_option("--max-range", max_range_m, "farther depth shows no object")
      ->check(value_of_option(kMaxRangeOption));
  command.add_option("--set", settings, "NAME=VALUE: any option of `hypermap config`");
  command
      .add_option("--without", without, "steps to leave out, separated by commas; may be repeated")
      ->delimiter(',')
      ->transform(one_of(step_names()));
  command.add_flag("--no-outliers", no_outliers, "as --without outliers");
  command.add_flag("--no-clusters", no_clusters, "as --without clusters");
}

Result<MapOptions> map_options_of(const TuneOptions& arguments) {
  MapOptions options;
  options.mapper.objects = preset(*preset_of(arguments.preset));
  if (arguments.config) {
    HYPERMAP_ASSIGN_OR_RETURN(options, read_options(*arguments.config, options));
  }
  HYPERMAP_ASSIGN_OR_RETURN(options, with_policy(std::move(options), arguments.policy));
  HYPERMAP_TRY(check_growing_flags(arguments, options));
  HYPERMAP_ASSIGN_OR_RETURN(options,
                            with_flags(std::move(options),
                                       {{kAngleOption, radians_of(arguments.angle_deg)},
                                        {kCurvatureOption, arguments.curvature},
                                        {kLeafOption, arguments.leaf_size_m},
                                        {kMaxRangeOption, arguments.max_range_m}}));
  for (const std::string& setting : arguments.settings) {
    HYPERMAP_ASSIGN_OR_RETURN(options, with_setting(options, setting));
  }
  for (const std::string& step : steps_left_out(arguments)) {
    HYPERMAP_ASSIGN_OR_RETURN(options, without_step(std::move(options), step));
  }
  return options;
}

}  // namespace hypermap::app
