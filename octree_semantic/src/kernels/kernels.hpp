// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The inner loops of integration and of occlusion rays, on plain arrays: compiled once for each
/// instruction set, chosen when the program runs. No Eigen or PCL type may stand here (their layout
/// depends on the set), and nothing of the standard library that is a function: the linker would
/// keep one copy for all.
///
/// All sets give the same bits: each operation is rounded by itself (no fused ones), divisions and
/// roots are those of IEEE 754. `kernels_test.cpp`, `cell_kernels_test.cpp` and
/// `ray_kernels_test.cpp` compare them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace hypermap::kernels {

/// Arrays of measurements are padded to whole multiples of this.
inline constexpr std::size_t kBlock = 64;
/// "No voxel".
inline constexpr std::uint32_t kNoVoxel = 0xFFFF'FFFF;

/// Rays of one row of a depth image in the map: pixel u looks along
/// `per_column` * (u - centre_column) + `row`, per metre of depth.
struct RowRays {
  double per_column[3] = {};
  double row[3] = {};
  double sensor[3] = {};
  double centre_column = 0.0;
};
struct RowCounts {
  std::size_t num_not_measured = 0;  ///< Depth 0 or negative.
  std::size_t num_not_finite = 0;
};
/// Points of a row; x is NaN where nothing was measured. All of the same, padded, length.
struct PointRow {
  float* x = nullptr;
  float* y = nullptr;
  float* z = nullptr;
};

/// Minimum, maximum and number of the measured depths per column, over some rows.
struct ColumnSummary {
  float* clean = nullptr;  ///< The row itself: 0 where nothing was measured.
  float* min = nullptr;
  float* max = nullptr;
  float* num_measured = nullptr;
};

/// Cells of a window of bricks (as of WindowGeometry), and which distances count.
struct CellGrid {
  double voxels_per_m = 0.0;
  double corner[3] = {};        ///< In voxels from the map's origin.
  std::int32_t first[3] = {};   ///< Offsets from the corner within the volume,
  std::int32_t end[3] = {};     ///< from first to the one before end.
  std::int32_t stride[2] = {};  ///< Bricks from one to the next along x and y.
  float sensor[3] = {};
  float max_squared = 0.0F;        ///< Squared distances up to here are within the range,
  float outer_max_squared = 0.0F;  ///< up to here are near: they get a cell. >= max_squared.
};
/// One bit for each measurement.
struct CellBits {
  std::uint64_t* starts = nullptr;  ///< Has a cell, and another one than the measurement before.
  std::uint64_t* far = nullptr;     ///< Not near, at a finite distance.
  std::uint64_t* lost = nullptr;    ///< Near, but outside the window; or its distance overflows.
};
struct CellCounts {
  std::size_t num_with_cell = 0;
  std::size_t num_within_range = 0;  ///< Of those with a cell.
};

/// A depth image and where the corners of voxels fall in it.
struct CornerProjection {
  const float* depth_m = nullptr;  ///< Row-major; 0 where nothing was measured.
  std::int32_t width_px = 0;
  float width = 0.0F;
  float height = 0.0F;
  /// Centre of the image, plus half a pixel.
  float u0 = 0.0F;
  float v0 = 0.0F;
  float max_squared_m2 = 0.0F;
  float per_fx = 0.0F;  ///< 1 / focal length.
  float per_fy = 0.0F;
  /// From the first corner of a brick to each of its 512 in Morton order, in the camera's axes; x
  /// and y times the focal lengths.
  alignas(64) float x[512] = {};
  alignas(64) float y[512] = {};
  alignas(64) float z[512] = {};
};

/// The bits of a voxel's place in its brick, in Morton order, that belong to x; shifted by one to
/// y, by two to z.
inline constexpr std::int64_t kAxisBits = 0b001'001'001;

/// A ray that walks from voxel to voxel. Distances along it.
///
/// A cell's number is that of its brick's first cell plus the places along the three axes, each in
/// the bits of its axis.
struct MarchedRay {
  double next[3] = {};       ///< To the next face across each axis,
  double per_voxel[3] = {};  ///< and from that to the one behind it.
  double limit = 0.0;        ///< It ends when all next faces lie beyond,
  std::int64_t place[3] = {};
  std::int64_t step[3] = {};        ///< Added to a place, then all bits but the axis' are cleared.
  std::int64_t behind[3] = {};      ///< The place at which it has left the brick,
  std::int64_t brick_step[3] = {};  ///< whose first cell changes by this then.
  std::int64_t brick = 0;
  std::int64_t last_cell = 0;  ///< or here, the last voxel left out. Not the first one.
};
/// Where the voxels that rays pass are marked.
struct CellMarks {
  std::uint64_t* words = nullptr;   ///< One bit for each cell,
  std::uint8_t* touched = nullptr;  ///< one byte for each brick.
};

/// Occlusion rays that are traced together. Unit: voxels from the map's origin.
inline constexpr std::size_t kRayLanes = 16;
struct RayPacket {
  alignas(64) float origin[3][kRayLanes] = {};
  alignas(64) float direction[3][kRayLanes] = {};  ///< Of length 1.
  alignas(64) float inverse[3][kRayLanes] = {};    ///< 1 / direction, finite.
  alignas(64) float end[kRayLanes] = {};           ///< How far it goes.
};
/// Faces across the three axes, in voxels from the map's origin.
struct BoxFaces {
  float low[3] = {};
  float high[3] = {};
};

/// Steps of log-odds and their limits.
struct EvidenceSteps {
  std::int16_t hit = 0;
  std::int16_t miss = 0;
  std::int16_t clamp_min = 0;
  std::int16_t clamp_max = 0;
  std::int16_t occupied_from = 0;
};
/// Occupancy of a brick: 8 words of bits each, 512 log-odds (aligned to 64 bytes).
struct BrickArrays {
  std::uint64_t* known = nullptr;
  std::uint64_t* occupied = nullptr;
  std::int16_t* log_odds = nullptr;
};
struct MergeCounts {
  std::size_t num_hit = 0;
  std::size_t num_passed = 0;  ///< And not hit.
  bool changed = false;        ///< A voxel became occupied or ceased to be.
};

/// Beliefs of voxels side by side. A class and its log-odds are one number, ordered as classes are
/// kept, by log-odds and of equals the lower id first: log-odds * 65536 + 65535 - id.
struct BeliefLanes {
  alignas(64) std::int32_t classes[3][512] = {};  ///< Best first; kNoClass where one is unused.
  alignas(64) std::int32_t rest[512] = {};        ///< Bound of all others' log-odds.
};
inline constexpr std::int32_t kNoClass = -2'147'483'647 - 1;
/// What one frame says of the classes of some voxels.
struct LabelScores {
  const std::int32_t* by_class = nullptr;  ///< Evidence per class id; kNotNamed for those left out.
  std::int32_t num_classes = 0;            ///< Ids of `by_class`.
  const std::int32_t* best_ids = nullptr;  ///< The strongest, strongest first,
  const std::int32_t* best = nullptr;      ///< and their evidence.
  std::size_t num_best = 0;
  std::int32_t limit = 0;  ///< All are lowered by what the best exceeds it, down to -limit.
};
inline constexpr std::int32_t kNotNamed = kNoClass;

/// One instruction set's functions.
struct Kernels {
  const char* name;
  /// Depth row of `size` pixels to points in the map. Fills `points` up to a multiple of kBlock.
  RowCounts (*unproject_row)(const RowRays& rays,
                             const float* depth_m,
                             std::size_t size,
                             const PointRow& points);
  /// Adds a row to the summary of its columns.
  void (*summarise_row)(const float* depth_m, std::size_t size, const ColumnSummary& summary);
  /// The largest finite one of `size` depths, at least 0.
  float (*farthest)(const float* depth_m, std::size_t size);
  /// Cells of `size` points, a multiple of kBlock; kNoVoxel for those without.
  CellCounts (*find_cells)(const CellGrid& grid,
                           const PointRow& points,
                           std::size_t size,
                           std::uint32_t* cells,
                           const CellBits& bits);
  /// Bits of the visible corners of a brick: in the image and nearer than the depth measured there.
  /// `first`: the brick's first corner in the camera's axes, x and y times the focal lengths.
  /// `check_range`: only those within the range.
  void (*test_corners)(const CornerProjection& projection,
                       const float* first,
                       bool check_range,
                       std::uint64_t* visible);
  /// Marks the voxels that rays pass, from the first to the one before the last. On a tie of next
  /// faces z goes before y before x.
  /// Requires: all rays begin in the same voxel.
  void (*march_rays)(const MarchedRay* rays, std::size_t size, const CellMarks& marks);
  /// Bits of the first `num_lanes` rays that intersect a box, of those whose `valid` is not 0.
  /// Requires: num_lanes is 4, 8 or 16.
  std::uint32_t (*intersect_box)(const RayPacket& lines,
                                 const BoxFaces& box,
                                 const std::int32_t* valid,
                                 std::size_t num_lanes);
  /// Adds a hit to the voxels of `hit` and a miss to those of `passed` that are not hit, and
  /// clamps. 8 words of bits each.
  MergeCounts (*merge_brick)(const BrickArrays& brick,
                             const std::uint64_t* hit,
                             const std::uint64_t* passed,
                             const EvidenceSteps& steps);
  /// Adds evidence to the first `size` beliefs: to the classes kept, then the four strongest others
  /// at most compete with them for their places; the best that has none is the rest's bound.
  void (*merge_labels)(const LabelScores& scores, std::size_t size, BeliefLanes& beliefs);
};

/// The best of those that this processor has.
[[nodiscard]] const Kernels& best_kernels();
/// One value at a time: the reference.
[[nodiscard]] const Kernels& scalar_kernels();

}  // namespace hypermap::kernels
