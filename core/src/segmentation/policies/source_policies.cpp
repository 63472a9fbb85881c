// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The segmentations of [smap] 3.3 and [hypermap] 3.4.4 as their texts have them.
#include "segmentation/point_clusters.hpp"
#include "segmentation/voxel_grid.hpp"
#include "segmentation_policies.hpp"
#include "smooth_regions.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace hypermap {
namespace {

std::vector<Eigen::Vector3f> pick(std::span<const Eigen::Vector3f> points,
                                  std::span<const std::uint32_t> indices) {
  std::vector<Eigen::Vector3f> out;
  out.reserve(indices.size());
  for (const std::uint32_t i : indices) out.push_back(points[i]);
  return out;
}

/// Per voxel its cluster, 1 = largest; kLabelNone in no cluster; kLabelAbsent when it was dropped.
std::vector<std::int32_t> labels_of(std::size_t num_voxels,
                                    const PointIndices& kept,
                                    const std::vector<PointIndices>& clusters) {
  std::vector<std::int32_t> labels(num_voxels, kLabelAbsent);
  for (const std::uint32_t voxel : kept) labels[voxel] = kLabelNone;
  for (std::size_t k = 0; k < clusters.size(); ++k) {
    for (const std::uint32_t i : clusters[k]) labels[kept[i]] = static_cast<std::int32_t>(k + 1);
  }
  return labels;
}

/// The pixels whose voxel has label 1.
std::vector<std::uint32_t> pixels_of_best(const PixelCloud& cloud,
                                          const ThinnedCloud& grid,
                                          const std::vector<std::int32_t>& labels) {
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i < cloud.pixels.size(); ++i) {
    if (labels[grid.voxel_of_point[i]] == 1) out.push_back(cloud.pixels[i]);
  }
  return out;
}

/// Crop and range, the first two steps of every policy.
PixelCloud crop_in_range(const RgbdFrame& frame,
                         const Detection& detection,
                         const GeometricSegmentationOptions& options,
                         StepRecorder* recorder) {
  const auto one = [](std::size_t) { return 1; };
  const PixelCloud cropped = crop(frame, detection);
  if (recorder != nullptr) {
    recorder->record("crop", cropped.pixels.size(), 0, cropped.pixels, one);
  }
  PixelCloud in_range = within_range(cropped, options);
  if (recorder != nullptr) {
    recorder->record("range", in_range.pixels.size(), 0, in_range.pixels, one);
  }
  return in_range;
}

PointIndices all_of(std::size_t count) {
  PointIndices all(count);
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

}  // namespace

Result<Segment> segment_by_cluster(const RgbdFrame& frame,
                                   const Detection& detection,
                                   const GeometricSegmentationOptions& options,
                                   StepRecorder* recorder) {
  const PixelCloud cloud = crop_in_range(frame, detection, options, recorder);
  if (cloud.pixels.empty()) return nothing_left("range");

  const ThinnedCloud grid = voxel_grid(cloud.points_in_camera, options.leaf_size_m);
  const auto show = [&](const char* step,
                        std::size_t num_points,
                        const std::vector<PointIndices>& clusters,
                        const std::vector<std::int32_t>& labels) {
    if (recorder == nullptr) return;
    recorder->record(step, num_points, clusters.size(), cloud.pixels, [&](std::size_t i) {
      return labels[grid.voxel_of_point[i]];
    });
  };
  const std::size_t num_voxels = grid.centroids.size();
  std::vector<std::int32_t> voxel_labels(num_voxels);
  std::iota(voxel_labels.begin(), voxel_labels.end(), 1);
  show("voxel grid", num_voxels, {}, voxel_labels);

  const PointIndices kept =
      options.outlier_neighbours > 0
          ? statistical_inliers(grid.centroids, options.outlier_neighbours, options.outlier_stddev)
          : all_of(num_voxels);
  show("outliers", kept.size(), {}, labels_of(num_voxels, kept, {all_of(kept.size())}));
  if (kept.empty()) return nothing_left("outliers");

  const std::vector<Eigen::Vector3f> inliers = pick(grid.centroids, kept);
  const std::vector<PointIndices> clusters = options.cluster_gap_m > 0.0
                                                 ? euclidean_clusters(inliers,
                                                                      options.cluster_gap_m,
                                                                      options.cluster_min_points,
                                                                      options.cluster_max_points)
                                                 : std::vector<PointIndices>{all_of(kept.size())};
  const std::vector<std::int32_t> labels = labels_of(num_voxels, kept, clusters);
  show("clusters", clusters.empty() ? 0 : clusters.front().size(), clusters, labels);
  if (clusters.empty()) return nothing_left("clusters");

  return describe(
      frame, pixels_of_best(cloud, grid, labels), pick(inliers, clusters.front()), options);
}

Result<Segment> segment_by_region_growing(const RgbdFrame& frame,
                                          const Detection& detection,
                                          const GeometricSegmentationOptions& options,
                                          StepRecorder* recorder) {
  const PixelCloud cloud = crop_in_range(frame, detection, options, recorder);
  if (cloud.pixels.empty()) return nothing_left("range");

  const std::vector<PointIndices> regions =
      smooth_regions(cloud, frame.camera, options.region_growing);
  const std::size_t best_size = regions.empty() ? 0 : regions.front().size();
  if (recorder != nullptr) {
    const auto labels = labels_of(cloud.pixels.size(), all_of(cloud.pixels.size()), regions);
    recorder->record("regions", best_size, regions.size(), cloud.pixels, [&](std::size_t i) {
      return labels[i];
    });
  }
  if (regions.empty()) return nothing_left("regions");

  PixelCloud largest = subset(cloud, regions.front());
  const ThinnedCloud grid = voxel_grid(largest.points_in_camera, options.leaf_size_m);
  if (recorder != nullptr) {
    recorder->record("voxel grid", grid.centroids.size(), 1, largest.pixels, [&](std::size_t i) {
      return static_cast<std::int32_t>(grid.voxel_of_point[i]) + 1;
    });
  }
  return describe(frame, std::move(largest.pixels), grid.centroids, options);
}

}  // namespace hypermap
