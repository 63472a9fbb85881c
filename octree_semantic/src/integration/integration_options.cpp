// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"

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

}  // namespace

const OptionTable& option_table(const IntegrationOptions&) {
  static constexpr OptionTable kTable{kIntegrationRows};
  return kTable;
}

Result<void> validate(const IntegrationOptions& options) {
  return check_options(options);
}

}  // namespace hypermap
