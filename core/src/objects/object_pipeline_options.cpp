// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_pipeline_options.hpp"

#include "hypermap/core/base/option_rows.hpp"
#include "option_names.hpp"

namespace hypermap {
namespace {

using Pipeline = ObjectPipelineOptions;

constexpr OptionRow kPipelineRows[] = {
    option::section<&Pipeline::stacking>("stacking"),
    option::section<&Pipeline::segmentation>("segmentation"),
    option::section<&Pipeline::association>("association"),
    option::section<&Pipeline::binned_depth>("binned_depth"),
    option::section<&Pipeline::absence>("absence"),
    option::section<&Pipeline::confirmation>("publication"),
    option::choice<&Pipeline::footprint>("footprint",
                                         kShapeNames,
                                         {.effect = "What objects cover from above.",
                                          .smap = ShapePolicy::kHull,
                                          .hypermap = ShapePolicy::kBest}),
    option::names<&Pipeline::transient_class_names>(
        "transient_classes", {.effect = "Classes that touch neither voxels nor objects."}),
};

}  // namespace

const OptionTable& option_table(const ObjectPipelineOptions&) {
  static constexpr OptionTable kTable{kPipelineRows};
  return kTable;
}

Result<void> validate(const ObjectPipelineOptions& options) {
  return check_options(options);
}

ObjectPipelineOptions preset(PresetName name) {
  return preset_options<ObjectPipelineOptions>(name);
}

}  // namespace hypermap
