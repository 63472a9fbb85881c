// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/gravity_alignment.hpp"

#include "hypermap/io/dataset/up_axis.hpp"

namespace hypermap {
namespace {

Result<GravityAlignment> by_axis(const std::string& axis, const std::string& who) {
  HYPERMAP_ASSIGN_OR_RETURN(const MapFromInput map_from_input, map_from_input_axis(axis));
  return GravityAlignment{map_from_input, axis + " of the input is up, " + who};
}

Result<GravityAlignment> by_floor(const DatasetReader& dataset) {
  auto floor = estimate_floor(dataset);
  if (!floor) {
    Error error = std::move(floor).error();
    error.what += "; the axis that points up can be given with --up";
    return Unexpected(std::move(error));
  }
  return GravityAlignment{floor->map_from_input, "by the floor found: " + to_string(*floor)};
}

}  // namespace

Result<GravityAlignment> align_to_gravity(const DatasetReader& dataset,
                                          const std::optional<std::string>& wanted) {
  if (wanted && *wanted != "floor") return by_axis(*wanted, "as asked for");
  if (wanted) return by_floor(dataset);
  const DatasetSummary& summary = dataset.summary();
  if (summary.up_axis && *summary.up_axis != "floor") {
    return by_axis(*summary.up_axis, "says the dataset's description");
  }
  if (!summary.up_axis && summary.layout == "tum") return by_axis("z", "as TUM RGB-D has it");
  return by_floor(dataset);
}

}  // namespace hypermap
