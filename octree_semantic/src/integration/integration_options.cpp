// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"

#include <span>
#include <string>

namespace hypermap {
namespace {

constexpr std::string_view kModeNames[] = {"exact", "discretize", "projective"};

constexpr OptionRow kIntegrationRows[] = {
    option::choice<&IntegrationOptions::mode>(
        "mode",
        kModeNames,
        {.source = "OctoMap",
         .effect = "What frees space: all rays, one an end voxel, or projection."}),
    option::number<&IntegrationOptions::max_range_m>(
        "max_range_m",
        option::above(0, 100000),
        {.unit = "m",
         .effect = "Farther measurements only free the way up to here. Other ranges follow it."}),
    option::count<&IntegrationOptions::num_threads>(
        "num_threads",
        {1, 256},
        {.effect = "Threads that share the work of a frame.", .is_listed = false}),
};

/// Scans come through the library alone: their options are in no file.
constexpr OptionRow kCloudRows[] = {
    option::choice<&CloudOptions::mode>(
        "mode",
        std::span(kModeNames).first(2),
        {.effect = "What frees space: all rays, or one an end voxel.", .is_listed = false}),
    option::number<&CloudOptions::max_range_m>(
        "max_range_m",
        option::above(0, 100000),
        {.unit = "m", .effect = "Farther points occupy nothing.", .is_listed = false}),
    option::number<&CloudOptions::free_range_m>(
        "free_range_m",
        option::above(0, 100000),
        {.unit = "m", .effect = "Rays free the way up to here.", .is_listed = false}),
    option::count<&CloudOptions::max_memory_mb>(
        "max_memory_mb",
        {1, 1048576},
        {.unit = "MiB", .effect = "A scan that needs more is refused whole.", .is_listed = false}),
};

Result<void> check_ranges(const CloudOptions& options) {
  if (options.free_range_m <= options.max_range_m) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be at most max_range_m, is " + std::to_string(options.free_range_m),
              "free_range_m");
}

}  // namespace

const OptionTable& option_table(const IntegrationOptions&) {
  static constexpr OptionTable kTable{kIntegrationRows};
  return kTable;
}

Result<void> validate(const IntegrationOptions& options) {
  return check_options(options);
}

const OptionTable& option_table(const CloudOptions&) {
  static constexpr OptionTable kTable{kCloudRows, kRule<check_ranges>};
  return kTable;
}

Result<void> validate(const CloudOptions& options) {
  return check_options(options);
}

}  // namespace hypermap
