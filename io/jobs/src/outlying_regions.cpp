// SPDX-License-Identifier: BSD-3-Clause
#include "outlying_regions.hpp"

#include "hypermap/core/base/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kMaxNamedRegions = 10;

/// To a tenth of a metre.
std::string metres(double value_m) {
  return number_text(std::round(10.0 * value_m) / 10.0);
}

std::string place_text(const Eigen::Vector3d& point) {
  return "(" + metres(point.x()) + ", " + metres(point.y()) + ", " + metres(point.z()) + ") m";
}

/// The region nearest to the camera: 0 is the main one, then the outlying ones.
std::size_t region_of(const FramePlace& frame, const DerivedLayers& derived) {
  const Box camera{frame.camera_in_map, frame.camera_in_map};
  std::size_t nearest = 0;
  double least_m = gap_between_m(camera, derived.main.bounds_in_map);
  for (std::size_t i = 0; i < derived.outlying.size(); ++i) {
    const double gap_m = gap_between_m(camera, derived.outlying[i].bounds_in_map);
    if (gap_m >= least_m) continue;
    least_m = gap_m;
    nearest = i + 1;
  }
  return nearest;
}

/// The frames of each outlying region.
std::vector<std::vector<std::size_t>> frames_of(const DerivedLayers& derived,
                                                std::span<const FramePlace> frames) {
  std::vector<std::vector<std::size_t>> of_region(derived.outlying.size());
  if (derived.outlying.empty()) return of_region;
  for (const FramePlace& frame : frames) {
    const std::size_t region = region_of(frame, derived);
    if (region > 0) of_region[region - 1].push_back(frame.index);
  }
  return of_region;
}

std::string frames_text(const std::vector<std::size_t>& frames, const DatasetReader& dataset) {
  if (frames.empty()) return "";
  const std::string first = printable(dataset.frame_name(frames.front()), 100);
  if (frames.size() == 1) return ", of frame " + first;
  return ", of " + std::to_string(frames.size()) + " frames, the first " + first;
}

std::string voxels_text(const LeafCount& leaves) {
  return std::to_string(leaves.occupied + leaves.free) + " voxels (" +
         std::to_string(leaves.occupied) + " occupied)";
}

Finding of_layers(std::string what, const std::filesystem::path& output) {
  return {Severity::kWarning,
          {.code = ErrorCode::kLimit,
           .what = std::move(what),
           .file = output.string(),
           .field = "layers"}};
}

/// All regions that are not named one by one.
Finding of_the_rest(std::span<const MapRegion> regions, const std::filesystem::path& output) {
  LeafCount leaves;
  for (const MapRegion& region : regions) {
    leaves.occupied += region.leaves.occupied;
    leaves.free += region.leaves.free;
  }
  return of_layers("leave out " + voxels_text(leaves) + " of " + std::to_string(regions.size()) +
                       " more regions, which stay in the octree",
                   output);
}

}  // namespace

std::vector<Finding> findings_of(const DerivedLayers& derived,
                                 std::span<const FramePlace> frames,
                                 const DatasetReader& dataset,
                                 const std::filesystem::path& output) {
  std::vector<Finding> findings;
  const auto of_region = frames_of(derived, frames);
  const std::span<const MapRegion> outlying = derived.outlying;
  const std::size_t num_named = std::min(outlying.size(), kMaxNamedRegions);
  findings.reserve(num_named + 1 + derived.left_out.size());
  for (std::size_t i = 0; i < num_named; ++i) {
    const MapRegion& region = outlying[i];
    const double gap_m = gap_between_m(region.bounds_in_map, derived.main.bounds_in_map);
    findings.push_back(of_layers(
        "leave out " + voxels_text(region.leaves) + " around " +
            place_text(region.bounds_in_map.centre()) + ", " + metres(gap_m) + " m from the rest" +
            frames_text(of_region[i], dataset) + ", which stay in the octree",
        output));
  }
  if (num_named < outlying.size()) {
    findings.push_back(of_the_rest(outlying.subspan(num_named), output));
  }
  for (const Finding& left_out : derived.left_out) {
    findings.push_back(left_out);
    findings.back().error.file = output.string();
  }
  return findings;
}

}  // namespace hypermap
