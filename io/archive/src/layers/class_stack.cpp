// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/class_stack.hpp"

#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/vocabulary/asked_names.hpp"
#include "hypermap/projection/stack/leaf_evidence.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace hypermap {
namespace {

Result<std::set<ClassId>> classes_asked_for(const ClassRegistry& classes,
                                            const ClassStackRequest& request) {
  const auto ids = asked_classes(classes, request.vocabulary, request.classes);
  if (!ids) return fail(ids.error().code, ids.error().what, "--class");
  return std::set<ClassId>(ids->begin(), ids->end());
}

/// The geometry of the leaves' grids. Errors: kNotFound when no leaf lies in the band.
Result<GridGeometry> geometry_of_band(const LeafSource& leaves, const HeightBand& band) {
  HYPERMAP_ASSIGN_OR_RETURN(const GridGeometry geometry, projection_geometry(leaves, band));
  if (geometry.num_cells() > 0) return geometry;
  return fail(ErrorCode::kNotFound,
              "no voxel lies between heights of " + number_text(band.min_m) + " and " +
                  number_text(band.max_m) + " m");
}

}  // namespace

Result<GridStack> class_stack(const LeafSource& leaves,
                              const ClassRegistry& classes,
                              const ClassStackRequest& request) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto wanted, classes_asked_for(classes, request));
  HYPERMAP_ASSIGN_OR_RETURN(const GridGeometry geometry, geometry_of_band(leaves, request.band));
  HYPERMAP_ASSIGN_OR_RETURN(GridStack stack, GridStack::create(geometry, request.options));
  HYPERMAP_ASSIGN_OR_RETURN(auto grids,
                            project_class_evidence(leaves, request.band, {}, classes.size()));
  for (ClassEvidenceGrid& evidence : grids) {
    const bool is_wanted = request.classes.empty() || wanted.contains(evidence.id);
    if (!is_wanted || !classes.contains(evidence.id)) continue;
    std::string layer = stack_layer_name(stack.options().parent, classes.name(evidence.id));
    if (stack.layers().contains(layer)) layer += "-" + std::to_string(evidence.id.value);
    HYPERMAP_TRY(stack.fuse({.layer = std::move(layer), .grid = std::move(evidence.grid)},
                            Eigen::Matrix3d(Eigen::Matrix3d::Identity()),
                            {.rule = ResamplingRule::kNearest}));
  }
  return stack;
}

}  // namespace hypermap
