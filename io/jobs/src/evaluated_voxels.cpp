// SPDX-License-Identifier: BSD-3-Clause
#include "evaluated_voxels.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

std::string extension_frame(const MapArchive& archive, std::string_view format) {
  const auto entry = archive.extension_entries.find(format);
  return entry == archive.extension_entries.end() ? ExtensionEntry{}.frame_id
                                                  : entry->second.frame_id;
}

/// Mean coverage of the truths that count.
std::optional<double> surface_covered(const std::vector<SurfaceCoverage>& coverage,
                                      const EvaluatedArchive& truth) {
  double sum = 0.0;
  std::size_t n = 0;
  for (const SurfaceCoverage& surface : coverage) {
    const auto found = std::find(truth.ids.begin(), truth.ids.end(), surface.id.value);
    if (found == truth.ids.end() || !surface.share()) continue;
    if (truth.objects[static_cast<std::size_t>(found - truth.ids.begin())].excluded) continue;
    sum += *surface.share();
    ++n;
  }
  return n == 0 ? std::nullopt : std::optional(sum / static_cast<double>(n));
}

}  // namespace

std::string why_no_voxels(const MapArchive& map, const MapArchive& truth) {
  if (!map.octree) return "the map has no octree";
  if (!truth.true_surfaces) return "the truth has no surfaces: it is an older one, or made by hand";
  if (extension_frame(map, kOctomapFormat) != extension_frame(truth, kTrueSurfacesFormat))
    return "the octree is in another frame than the true surfaces";
  return {};
}

Result<VoxelOutcome> evaluated_voxels(const EvaluatedArchive& map,
                                      const EvaluatedArchive& truth,
                                      const StopCheck& stop) {
  HYPERMAP_ASSIGN_OR_RETURN(const UnderstoodVoxels voxels, understood_voxels(map.archive));
  HYPERMAP_ASSIGN_OR_RETURN(
      VoxelEvaluation labels,
      evaluate_voxels(voxels.leaves, voxels.classes, *truth.archive.true_surfaces, stop));
  const auto covered = surface_covered(labels.coverage, truth);
  return VoxelOutcome{std::move(labels), covered};
}

}  // namespace hypermap
