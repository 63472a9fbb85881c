// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_workspace.hpp"

#include "integration/marking/cell_finder.hpp"
#include "integration/marking/ray_steps.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <string>

namespace hypermap {
namespace {

constexpr std::uint32_t kCellsPerBrick = kBrickVolume;
constexpr std::size_t kBytesPerMb = std::size_t{1} << 20U;
/// Beside marks and votes: the list of bricks to be written.
constexpr std::size_t kBytesPerStagedBrick = 64;

std::size_t labelled_points(std::span<const PixelLabels> labels) {
  std::size_t total = 0;
  for (const PixelLabels& label : labels) total += label.pixel_indices.size();
  return total;
}

/// What a scan takes to work on.
class CloudMemory {
 public:
  CloudMemory(std::size_t num_points, std::span<const PixelLabels> labels)
      : fixed_(num_points * sizeof(std::uint32_t) +
               labelled_points(labels) * LabelVotes::kListBytesPerVote),
        per_brick_(kBytesPerStagedBrick + (labels.empty() ? 0 : LabelVotes::kListBytesPerBrick)) {}

  [[nodiscard]] std::size_t bytes_for(std::size_t num_bricks) const noexcept {
    return fixed_ + num_bricks * per_brick_ + SparseMarks::bytes_for(num_bricks);
  }
  /// The most bricks for which that is within `max_bytes`; 0 when not one is.
  [[nodiscard]] std::size_t max_bricks(std::size_t max_bytes) const noexcept {
    std::size_t least = 0;
    std::size_t beyond = SparseMarks::kMaxBricks + 1;
    while (beyond - least > 1) {
      const std::size_t middle = least + (beyond - least) / 2;
      (bytes_for(middle) <= max_bytes ? least : beyond) = middle;
    }
    return least;
  }

 private:
  std::size_t fixed_;
  std::size_t per_brick_;
};

Unexpected scan_too_large(const CloudMemory& memory, std::size_t max_bricks, std::size_t limit_mb) {
  const std::size_t needed = memory.bytes_for(max_bricks + 1) / kBytesPerMb + 1;
  return fail(ErrorCode::kLimit,
              "the scan needs " + std::to_string(needed) + " MiB or more to work on, of " +
                  std::to_string(limit_mb) + " that are allowed",
              "max_memory_mb");
}

PointF centre_of(const VoxelGrid& grid, const VoxelKey& key) {
  return {static_cast<float>(grid.centre_m(key.x)),
          static_cast<float>(grid.centre_m(key.y)),
          static_cast<float>(grid.centre_m(key.z))};
}

std::optional<VoxelKey> key_of(const VoxelGrid& grid, const PointF& point) {
  return grid.key(PointInMap{Eigen::Vector3f(point.data()).cast<double>()});
}

/// Keys along the axes of a voxel on a ray; they may lie one outside the volume.
using RayVoxel = std::array<int, 3>;

bool is_in_volume(const RayVoxel& at) noexcept {
  return std::min({at[0], at[1], at[2]}) >= 0 && std::max({at[0], at[1], at[2]}) < kKeysPerAxis;
}

BrickKey brick_of(const RayVoxel& at) noexcept {
  return BrickKey::of({static_cast<std::uint16_t>(at[0]),
                       static_cast<std::uint16_t>(at[1]),
                       static_cast<std::uint16_t>(at[2])});
}

/// Place in the brick, in Morton order.
std::uint32_t place_of(const RayVoxel& at) noexcept {
  static constexpr std::array<std::uint32_t, kBrickEdge> kSpread{0, 1, 8, 9, 64, 65, 72, 73};
  const auto along = [&at](std::size_t axis) {
    return kSpread[static_cast<std::size_t>(at[axis]) % kBrickEdge] << axis;
  };
  return along(0) | along(1) | along(2);
}

/// The axis across which a ray leaves its voxel. On a tie z goes before y before x, as in
/// kernels::march_rays.
std::size_t next_axis(const std::array<double, 3>& next) noexcept {
  if (next[0] < next[1]) return next[0] < next[2] ? 0 : 2;
  return next[1] < next[2] ? 1 : 2;
}

}  // namespace

Result<IntegrationReport> CloudWorkspace::integrate(SemanticOctree& tree,
                                                    const PointF& sensor,
                                                    std::span<const Eigen::Vector3f> points_in_map,
                                                    std::span<const PixelLabels> labels,
                                                    const CloudOptions& options) {
  const CloudMemory memory(points_in_map.size(), labels);
  const std::size_t max_bricks = memory.max_bricks(options.max_memory_mb * kBytesPerMb);
  if (max_bricks == 0) return scan_too_large(memory, 0, options.max_memory_mb);
  Scan scan{tree.grid(), sensor, RangeLimit(options.max_range_m), RangeLimit(options.free_range_m)};
  for (std::size_t i = 0; i < 3; ++i) {
    const double voxels = tree.grid().voxels_per_m() * static_cast<double>(sensor[i]);
    scan.sensor_voxel[i] = floor_to_int(voxels);
  }
  IntegrationReport report;
  try {
    marks_.start(max_bricks);
    if (!mark(scan, points_in_map, options.mode, report)) {
      marks_.clear();
      return scan_too_large(memory, max_bricks, options.max_memory_mb);
    }
    report.working_bytes = memory.bytes_for(marks_.num_bricks());
    const MarkedBricks marked{
        marks_.hit, marks_.passed, marks_.num_bricks(), [this](std::size_t brick) {
          return std::optional(marks_.key(brick));
        }};
    writer_.count_votes(
        tree.grid(), marked, cell_of_point_, labels, LabelVotes::Storage::kList, report);
    writer_.stage(tree, marked, workers_, report);
    writer_.commit(tree, marked, workers_, report);
  } catch (const std::bad_alloc&) {
    marks_.clear();
    return fail(ErrorCode::kOutOfMemory, "no memory to integrate the scan");
  }
  marks_.clear();
  return report;
}

bool CloudWorkspace::mark(const Scan& scan,
                          std::span<const Eigen::Vector3f> points,
                          IntegrationMode mode,
                          IntegrationReport& report) {
  cell_of_point_.assign(points.size(), kNoCell);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      ++report.num_not_finite;
      continue;
    }
    const PointF point{points[i].x(), points[i].y(), points[i].z()};
    if (!mark_end(scan, i, point, mode, report)) return false;
  }
  return mode == IntegrationMode::kExact || cast_from_voxels(scan);
}

bool CloudWorkspace::mark_end(const Scan& scan,
                              std::size_t index,
                              const PointF& point,
                              IntegrationMode mode,
                              IntegrationReport& report) {
  const float squared = squared_norm(difference(point, scan.sensor));
  const bool is_within = scan.hit_range.contains(squared);
  const std::optional<VoxelKey> key = key_of(scan.grid, point);
  const bool has_way =
      std::isfinite(squared) &&
      (is_within ? key.has_value()
                 : key_of(scan.grid, point_at_range(scan.sensor, point, scan.free_range.range_m()))
                       .has_value());
  if (!has_way) {
    ++report.num_outside_volume;
    return true;
  }
  ++(is_within ? report.num_hits : report.num_beyond_range);
  if (mode == IntegrationMode::kExact && !cast(scan, point)) return false;
  if (!key) return mode == IntegrationMode::kExact || cast(scan, point);
  if (!is_within && mode == IntegrationMode::kExact) return true;
  const std::uint32_t brick = marks_.touch(BrickKey::of(*key));
  if (brick == SparseMarks::kNone) return false;
  const auto cell = brick * kCellsPerBrick + static_cast<std::uint32_t>(cell_in_brick(*key));
  cell_of_point_[index] = cell;
  (mode == IntegrationMode::kExact ? marks_.hit : marks_.ends).marker().mark(cell);
  return true;
}

bool CloudWorkspace::cast_from_voxels(const Scan& scan) {
  // Rays touch further bricks; in those no measurement ends.
  const std::size_t num_bricks = marks_.num_bricks();
  for (std::size_t brick = 0; brick < num_bricks; ++brick) {
    for (std::size_t cell = 0; cell < kBrickVolume; ++cell) {
      const auto number = static_cast<std::uint32_t>(brick * kBrickVolume + cell);
      if (!marks_.ends.test(number)) continue;
      // A voxel counts by its centre, as in OctoMap: beyond the range it is not hit after all.
      const PointF centre = centre_of(scan.grid, marks_.key(brick).voxel(cell));
      const float squared = squared_norm(difference(centre, scan.sensor));
      if (scan.hit_range.contains(squared)) marks_.hit.marker().mark(number);
      if (!cast(scan, centre)) return false;
    }
  }
  return true;
}

bool CloudWorkspace::cast(const Scan& scan, const PointF& toward) {
  const float squared = squared_norm(difference(toward, scan.sensor));
  const PointF end = scan.free_range.contains(squared)
                         ? toward
                         : point_at_range(scan.sensor, toward, scan.free_range.range_m());
  RayVoxel at{};
  RayVoxel last{};
  for (std::size_t i = 0; i < 3; ++i) {
    at[i] = scan.sensor_voxel[i] + kOriginKey;
    const double voxels = scan.grid.voxels_per_m() * static_cast<double>(end[i]);
    last[i] = floor_to_int(voxels) + kOriginKey;
  }
  if (at == last) return true;
  RaySteps steps = ray_steps(scan.sensor, scan.sensor_voxel, end, scan.grid.resolution_m());
  bool is_outside = false;
  std::uint32_t brick = SparseMarks::kNone;
  do {
    if (brick == SparseMarks::kNone && !is_outside) {
      brick = marks_.touch(brick_of(at));
      if (brick == SparseMarks::kNone) return false;
    }
    if (!is_outside) marks_.passed.marker().mark(brick * kCellsPerBrick + place_of(at));
    const std::size_t axis = next_axis(steps.next);
    steps.next[axis] += steps.per_voxel[axis];
    const int before = at[axis];
    at[axis] += steps.sign[axis];
    if (before / kBrickEdge == at[axis] / kBrickEdge && at[axis] >= 0) continue;
    brick = SparseMarks::kNone;
    is_outside = !is_in_volume(at);
  } while (at != last && !(std::min({steps.next[0], steps.next[1], steps.next[2]}) > steps.limit));
  return true;
}

}  // namespace hypermap
