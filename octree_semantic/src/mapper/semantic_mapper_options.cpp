// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace hypermap {
namespace {

constexpr OptionRow kMapperRows[] = {
    option::section<&SemanticMapperOptions::octree>("octree"),
    option::section<&SemanticMapperOptions::integration>("integration"),
    option::section<&SemanticMapperOptions::cloud>("cloud"),
    option::section<&SemanticMapperOptions::deadline>("deadline"),
    option::section<&SemanticMapperOptions::smoothing>("smoothing"),
    option::section<&SemanticMapperOptions::refinement>("refinement"),
    option::section<&SemanticMapperOptions::visibility>("visibility"),
    option::section<&SemanticMapperOptions::places>("places"),
    option::section<&SemanticMapperOptions::prior>("prior"),
    option::section<&SemanticMapperOptions::objects>(""),
    option::names<&SemanticMapperOptions::wanted_class_names>(
        "wanted_classes", {.effect = "The only classes that touch voxels and objects; none: all."}),
    option::count<&SemanticMapperOptions::num_threads>(
        "num_threads",
        {1, 256},
        {.effect = "Threads for the detections of a frame and for rays.", .is_listed = false}),
    option::count<&SemanticMapperOptions::publish_every_n_frames>(
        "publish_every_n_frames",
        {0, 1'000'000},
        {.effect = "Frames between two snapshots for other threads; 0: none.", .is_listed = false}),
};

/// Gives `range_m` the map's range where it has none.
void follow(std::optional<double>& range_m, double map_range_m) {
  if (!range_m) range_m = map_range_m;
}

}  // namespace

SemanticMapperOptions with_ranges(SemanticMapperOptions options) {
  const double range_m = options.integration.max_range_m;
  follow(options.visibility.max_range_m, range_m);
  follow(options.objects.segmentation.max_range_m, std::min(range_m, kMaxSegmentedRangeM));
  follow(options.objects.binned_depth.max_range_m, range_m);
  return options;
}

const OptionTable& option_table(const SemanticMapperOptions&) {
  static constexpr OptionTable kTable{kMapperRows};
  return kTable;
}

Result<void> validate(const SemanticMapperOptions& options) {
  return check_options(with_ranges(options));
}

}  // namespace hypermap
