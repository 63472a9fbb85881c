// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/object_scopes.hpp"

namespace hypermap {
namespace {

ObjectScope within_cone(const RgbdFrame& frame, const GeometricSegmentationOptions& options) {
  return {.cone = active_cone(frame, options.min_range_m, options.max_range_m.value())};
}

}  // namespace

ObjectScope scope_of_candidates(const RgbdFrame& frame, const ObjectPipelineOptions& options) {
  if (options.association.policy != AssociationPolicy::kSmap) return {};
  return within_cone(frame, options.segmentation);
}

ObjectScope scope_of_absences(const RgbdFrame& frame, const ObjectPipelineOptions& options) {
  if (options.absence.policy != VisibilityPolicy::kPanels) return {};
  return within_cone(frame, options.segmentation);
}

}  // namespace hypermap
