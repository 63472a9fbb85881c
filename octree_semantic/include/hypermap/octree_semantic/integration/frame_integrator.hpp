// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Puts what a depth camera or scanner measured into the 3D map.
///
/// Each voxel is updated at most once per frame: occupied where a measurement ended in it, else
/// free where one passed through it, and labelled where a labelled measurement ended. Source: A.
/// Hornung et al., "OctoMap", Autonomous Robots 34 (2013), section 5.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/max_range.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/core/segmentation/detection.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

struct OptionTable;

/// What frees space. Measurements occupy the voxel in which they end in every mode.
///
/// | mode | frees |
/// |---|---|
/// | exact | what the ray of each measurement passes |
/// | discretize | what a ray to the centre of each end voxel passes |
/// | projective | voxels with a corner before the measured depth; rays where the image is sparse |
///
/// The first two give the voxels of OctoMap's insertPointCloud without and with its `discretize`,
/// the third occupied voxels of IoU 0.991 .. 0.999 with the first.
///
/// What each costs against insertPointCloud: docs/BENCHMARKS.md, with machine and command.
///
/// A cloud takes the first two only: it has no image to project into.
enum class IntegrationMode : std::uint8_t { kExact, kDiscretize, kProjective };

struct IntegrationOptions {
  IntegrationMode mode = IntegrationMode::kProjective;
  /// Farther measurements free the way up to here and occupy nothing. Distance from the sensor, not
  /// depth. In a mapper it is the range of the whole map.
  double max_range_m = kDefaultMaxRangeM;
  /// Threads that share the work of a frame. The result does not depend on it.
  int num_threads = 1;
  friend bool operator==(const IntegrationOptions&, const IntegrationOptions&) = default;
};
/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const IntegrationOptions& options);
[[nodiscard]] const OptionTable& option_table(const IntegrationOptions& options);

/// How a scan that reaches far is put into the map; see FrameIntegrator::integrate_far_cloud.
struct CloudOptions {
  IntegrationMode mode = IntegrationMode::kDiscretize;  ///< Exact or discretize.
  /// Farther points occupy nothing; > 0, at most 100,000. Distance from the sensor.
  double max_range_m = 100.0;
  /// Rays free the way up to here; > 0, at most `max_range_m`. Far rays lie apart: what they free
  /// there is lines, and costs most of the time.
  double free_range_m = 15.0;
  /// A scan whose working memory would be larger is refused whole; 1 .. 1,048,576. Unit: MiB.
  std::size_t max_memory_mb = 512;
  friend bool operator==(const CloudOptions&, const CloudOptions&) = default;
};
/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const CloudOptions& options);
[[nodiscard]] const OptionTable& option_table(const CloudOptions& options);

/// What is known of some measurements of a frame: they belong together.
struct PixelLabels {
  ObjectId object = kNoObject;                ///< kNoObject: they vote for no object.
  std::vector<ClassEvidence> class_scores{};  ///< Sorted by id, sums to 1; may be empty.
  /// Row-major positions of depth pixels (or indices of cloud points), in any order.
  std::vector<std::uint32_t> pixel_indices{};
};

/// Counts of a frame's measurements. Each pixel or point is counted in exactly one of the
/// first six.
struct IntegrationReport {
  std::size_t num_hits = 0;            ///< Ended in a voxel, which became more occupied.
  std::size_t num_beyond_range = 0;    ///< Farther than the range: only freed the way.
  std::size_t num_not_measured = 0;    ///< Depth 0 or negative.
  std::size_t num_not_finite = 0;      ///< NaN or infinite.
  std::size_t num_outside_volume = 0;  ///< Ended outside the 65,536 voxels of an axis: dropped.
  /// Of classes that do not stay, which a SemanticMapper leaves out; an integrator has none.
  std::size_t num_transient = 0;

  std::size_t num_labelled_hits = 0;  ///< Hits among the labelled measurements, counted per label.
  std::size_t num_occupied_voxels = 0;  ///< Voxels updated as hit.
  std::size_t num_free_voxels = 0;      ///< Voxels updated as passed through.
  std::size_t num_labelled_voxels = 0;
  std::size_t num_new_bricks = 0;
  /// What a cloud by CloudOptions took to work on, besides the map; 0 for all else.
  std::size_t working_bytes = 0;
  friend bool operator==(const IntegrationReport&, const IntegrationReport&) = default;
};

/// Writes frames into a tree. Holds the working memory (bounded by the range, reused from frame to
/// frame), no state of the map: one integrator may serve several trees in turn.
///
/// Cost: no allocation once the working memory has its size and the map is known.
/// Threads: one call at a time per integrator and per tree.
class FrameIntegrator {
 public:
  FrameIntegrator();
  FrameIntegrator(FrameIntegrator&&) noexcept;
  FrameIntegrator& operator=(FrameIntegrator&&) noexcept;
  FrameIntegrator(const FrameIntegrator&) = delete;
  FrameIntegrator& operator=(const FrameIntegrator&) = delete;
  ~FrameIntegrator();

  /// The frame is in the map whole or, on an error, not at all.
  ///
  /// Errors: kInvalidArgument from the options, when image and camera disagree, when the pose is
  /// not finite or the camera stands outside the volume of the map, when a label names a pixel that
  /// is not there or a class above 65,534; kLimit when range and resolution would need a window of
  /// more than 2^31 voxels; kOutOfMemory.
  [[nodiscard]] Result<IntegrationReport> integrate(SemanticOctree& tree,
                                                    const RgbdFrame& frame,
                                                    std::span<const PixelLabels> labels,
                                                    const IntegrationOptions& options);

  /// The same for points seen from one place. A point at the sensor itself is a hit there.
  /// Mode projective is refused (kInvalidArgument, field `mode`).
  [[nodiscard]] Result<IntegrationReport> integrate_cloud(
      SemanticOctree& tree,
      const PointInMap& sensor,
      std::span<const Eigen::Vector3f> points_in_map,
      std::span<const PixelLabels> labels,
      const IntegrationOptions& options);

  /// The same for a scan that reaches far: points occupy up to `max_range_m` and rays free up to
  /// `free_range_m`. Where both are one range, the voxels are those of the call above.
  ///
  /// Errors: as above; kLimit, naming both figures, when the scan touches so many bricks that the
  /// working memory would be larger than `max_memory_mb`; nothing is written then.
  /// Cost: one thread; memory follows the bricks that are touched, not the box around them.
  [[nodiscard]] Result<IntegrationReport> integrate_far_cloud(
      SemanticOctree& tree,
      const PointInMap& sensor,
      std::span<const Eigen::Vector3f> points_in_map,
      std::span<const PixelLabels> labels,
      const CloudOptions& options);

  /// For each label of the last call a box around the voxels that have its votes, of whole bricks;
  /// none where no measurement of it hit. Requires: that call succeeded. Valid until the next one.
  [[nodiscard]] std::span<const std::optional<Box>> label_boxes() const noexcept;

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace hypermap
