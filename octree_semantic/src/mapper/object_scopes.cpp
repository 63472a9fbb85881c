// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/object_scopes.hpp"

#include "hypermap/core/places/object_vertices.hpp"

#include <optional>

namespace hypermap {
namespace {

ObjectScope scope_around(const RgbdFrame& frame,
                         const TopologicalMap& places,
                         const GeometricSegmentationOptions& ranges,
                         const std::optional<int>& num_layers) {
  ObjectScope scope{.cone = active_cone(frame, ranges.min_range_m, ranges.max_range_m.value())};
  if (!num_layers || places.vertices().empty()) return scope;
  scope.is_near =
      [near = VertexNeighbourhood(places, frame.map_from_camera.origin().xyz, *num_layers)](
          const Eigen::Vector3d& centroid) { return near.contains(centroid); };
  return scope;
}

}  // namespace

ObjectScope scope_of_candidates(const RgbdFrame& frame,
                                const TopologicalMap& places,
                                const ObjectPipelineOptions& options) {
  if (options.association.policy != AssociationPolicy::kSmap) return {};
  return scope_around(frame, places, options.segmentation, options.association.graph_layers);
}

ObjectScope scope_of_absences(const RgbdFrame& frame,
                              const TopologicalMap& places,
                              const ObjectPipelineOptions& options) {
  if (options.absence.policy != VisibilityPolicy::kPanels) return {};
  return scope_around(frame, places, options.segmentation, options.absence.graph_layers);
}

}  // namespace hypermap
