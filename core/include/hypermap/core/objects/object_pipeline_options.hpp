// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// All options from detections to confirmed objects, and the named sets of them.
///
/// Source: [smap] tables D.1 and D.2 (preset smap); [hypermap] 3.4.4, 3.4.5, 5.2.2 (preset
/// hypermap). `data/options/*.yaml` are the same sets as files.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/preset_name.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/objects/absence.hpp"
#include "hypermap/core/objects/association.hpp"
#include "hypermap/core/objects/confirmation.hpp"
#include "hypermap/core/objects/object.hpp"
#include "hypermap/core/segmentation/binned_depth_map.hpp"
#include "hypermap/core/segmentation/geometric_segmentation.hpp"
#include "hypermap/core/segmentation/stacking.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

struct OptionTable;

/// Options of each stage, in the order of the stages.
struct ObjectPipelineOptions {
  StackingOptions stacking;                      ///< Several detectors become one.
  GeometricSegmentationOptions segmentation;     ///< Boxes become points.
  AssociationOptions association;                ///< Points become objects.
  BinnedDepthMapOptions binned_depth;            ///< For visibility policy panels.
  AbsenceOptions absence;                        ///< Objects that are not seen.
  ConfirmationOptions confirmation;              ///< Which objects are confirmed.
  ShapePolicy footprint = ShapePolicy::kVoxels;  ///< What they cover from above.
  /// Names of classes that touch neither voxels nor objects; resolved by the class registry. People
  /// walk about, and a map is of what stays.
  std::vector<std::string> transient_class_names = {"person"};

  friend bool operator==(const ObjectPipelineOptions&, const ObjectPipelineOptions&) = default;
};

/// Whether a name is a spelling (`is_spelling_of`) of one of the default's transient classes.
[[nodiscard]] bool is_transient_by_default(std::string_view name);

/// The names of transient classes, without one of the default that no class has: it is no error
/// where a detector knows no people.
[[nodiscard]] std::vector<std::string> transient_names(const ObjectPipelineOptions& options,
                                                       const ClassRegistry& classes);

/// Errors: those of each stage, the field prefixed with the stage's name.
[[nodiscard]] Result<void> validate(const ObjectPipelineOptions& options);
[[nodiscard]] const OptionTable& option_table(const ObjectPipelineOptions& options);

[[nodiscard]] ObjectPipelineOptions preset(PresetName name);
}  // namespace hypermap
