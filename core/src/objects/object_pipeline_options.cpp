// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_pipeline_options.hpp"

#include "hypermap/core/base/option_rows.hpp"
#include "option_names.hpp"

#include <algorithm>

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
        "transient_classes",
        {.effect = "Classes that touch neither voxels nor objects.",
         .smap = OptionValue(OptionValue::Names{}),
         .hypermap = OptionValue(OptionValue::Names{})}),
};

}  // namespace

const OptionTable& option_table(const ObjectPipelineOptions&) {
  static constexpr OptionTable kTable{kPipelineRows};
  return kTable;
}

bool is_transient_by_default(std::string_view name) {
  return std::ranges::any_of(ObjectPipelineOptions().transient_class_names,
                             [&](const std::string& usual) { return is_spelling_of(name, usual); });
}

std::vector<std::string> transient_names(const ObjectPipelineOptions& options,
                                         const ClassRegistry& classes) {
  std::vector<std::string> names = options.transient_class_names;
  std::erase_if(names, [&](const std::string& name) {
    return !classes.find(name) && is_transient_by_default(name);
  });
  return names;
}

Result<void> validate(const ObjectPipelineOptions& options) {
  return check_options(options);
}

ObjectPipelineOptions preset(PresetName name) {
  return preset_options<ObjectPipelineOptions>(name);
}

}  // namespace hypermap
