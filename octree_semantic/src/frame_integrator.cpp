// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/frame_integrator.hpp"

#include "bit_window.hpp"
#include "brick_merge.hpp"
#include "end_points.hpp"
#include "frame_checks.hpp"
#include "label_evidence.hpp"
#include "label_votes.hpp"
#include "measured_points.hpp"
#include "ray_marking.hpp"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <new>

namespace hypermap {
namespace {

/// Farther than any volume of a map: no limit.
constexpr double kEverywhereM = 1e9;
/// Measurements beyond the range are united by voxel within a window of at most so many cells, that
/// is 32 MiB of bits; else each gets a ray of its own.
constexpr double kMaxFarCells = 268435456.0;

}  // namespace

/// Working memory of an integrator and the steps of one integration.
struct FrameIntegrator::Workspace {
  /// A brick of the map that the frame changes.
  struct Staged {
    std::size_t window_brick = 0;
    std::uint32_t position = 0;
  };

  MarkedWindow hit;              // voxels in which measurements ended, around the sensor
  MarkedWindow far;              // the same for measurements beyond the range
  std::vector<BitLayer> passed;  // voxels that rays went through, one layer per thread
  std::vector<PointF> ray_ends;
  std::vector<std::uint32_t> cell_of_measurement;
  PointChunk chunk;
  LabelVotes votes;
  LabelEvidence evidence;
  std::vector<Staged> staged;

  Result<IntegrationReport> integrate(SemanticOctree& tree,
                                      const MeasuredPoints& points,
                                      std::span<const PixelLabels> labels,
                                      const IntegrationOptions& options);
  void prepare(const IntegrationOptions& options);
  MarkedWindow* prepare_far(const KeyBox& everything);
  void find_ends(const SemanticOctree& tree,
                 const MeasuredPoints& points,
                 const IntegrationOptions& options,
                 IntegrationReport& report);
  void mark_rays(double resolution_m, const PointF& sensor);
  void count_votes(std::span<const PixelLabels> labels, IntegrationReport& report);
  void stage(SemanticOctree& tree);
  void stage_labels(Brick& brick, std::size_t window_brick) const;
  void commit(SemanticOctree& tree, IntegrationReport& report) noexcept;
  bool commit_labels(Brick& brick, std::size_t window_brick, const SemanticOctree& tree) noexcept;
  void gather_passed(std::size_t window_brick) noexcept;
  void clear() noexcept;
};

Result<IntegrationReport> FrameIntegrator::Workspace::integrate(SemanticOctree& tree,
                                                                const MeasuredPoints& points,
                                                                std::span<const PixelLabels> labels,
                                                                const IntegrationOptions& options) {
  const KeyBox reach = points.reach(tree.resolution_m(), options.max_range_m);
  if (!hit.geometry.cover(reach, WindowGeometry::kMaxCells))
    return window_too_large(reach, options);
  IntegrationReport report;
  try {
    prepare(options);
    find_ends(tree, points, options, report);         // where measurements end
    mark_rays(tree.resolution_m(), points.sensor());  // what they passed through
    count_votes(labels, report);                      // which labels ended where
    const std::size_t num_bricks_before = tree.num_bricks();
    stage(tree);  // all memory that the map will need
    report.num_new_bricks = tree.num_bricks() - num_bricks_before;
  } catch (const std::bad_alloc&) {
    clear();
    return fail(ErrorCode::kOutOfMemory, "no memory to integrate the frame");
  }
  commit(tree, report);
  return report;
}

void FrameIntegrator::Workspace::prepare(const IntegrationOptions& options) {
  const std::size_t num_bricks = hit.geometry.num_bricks();
  passed.resize(static_cast<std::size_t>(options.num_threads));
  hit.bits.fit(num_bricks);
  for (BitLayer& layer : passed) layer.fit(num_bricks);
  ray_ends.clear();
}

MarkedWindow* FrameIntegrator::Workspace::prepare_far(const KeyBox& everything) {
  if (!far.geometry.cover(everything, kMaxFarCells)) return nullptr;
  far.bits.fit(far.geometry.num_bricks());
  return &far;
}

void FrameIntegrator::Workspace::find_ends(const SemanticOctree& tree,
                                           const MeasuredPoints& points,
                                           const IntegrationOptions& options,
                                           IntegrationReport& report) {
  cell_of_measurement.resize(points.size());
  const KeyBox everything = points.reach(tree.resolution_m(), kEverywhereM);
  EndPoints ends(tree.resolution_m(),
                 points.sensor(),
                 options,
                 hit,
                 options.mode == IntegrationMode::kExact ? nullptr : prepare_far(everything),
                 ray_ends);
  for (std::size_t first = 0; first < points.size();) {
    const std::size_t size = points.read(first, chunk, report);
    ends.add(chunk, std::span(cell_of_measurement).subspan(first, size), report);
    first += size;
  }
  ends.finish();
}

void FrameIntegrator::Workspace::mark_rays(double resolution_m, const PointF& sensor) {
  const RayMarker marker(hit.geometry, resolution_m, sensor);
  const std::size_t num_parts = passed.size();
  const auto mark_part = [&](std::size_t part) {
    const std::size_t first = ray_ends.size() * part / num_parts;
    const std::size_t last = ray_ends.size() * (part + 1) / num_parts;
    const BitMarker into = passed[part].marker();
    for (std::size_t i = first; i < last; ++i) marker.mark(ray_ends[i], into);
  };
  if (num_parts == 1) {
    mark_part(0);
    return;
  }
  // More threads than the machine has would only make TBB complain; the parts stay the same.
  const int num_threads = std::min(static_cast<int>(num_parts), tbb::info::default_concurrency());
  tbb::task_arena arena(num_threads);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, num_parts, mark_part); });
}

void FrameIntegrator::Workspace::count_votes(std::span<const PixelLabels> labels,
                                             IntegrationReport& report) {
  votes.start(hit.geometry.num_bricks(), labels.size());
  evidence.start(labels);
  for (std::uint32_t label = 0; label < labels.size(); ++label) {
    // Neighbouring pixels mostly end in one voxel: they vote together.
    std::uint32_t cell = kNoCell;
    std::uint32_t count = 0;
    const auto vote = [&] {
      if (cell == kNoCell || !hit.bits.test(cell)) return;
      votes.add(cell, label, count);
      report.num_labelled_hits += count;
    };
    for (const std::uint32_t index : labels[label].pixel_indices) {
      if (cell_of_measurement[index] != cell) {
        vote();
        cell = cell_of_measurement[index];
        count = 0;
      }
      ++count;
    }
    vote();
  }
  votes.finish();
}

void FrameIntegrator::Workspace::stage(SemanticOctree& tree) {
  staged.clear();
  for (std::size_t brick = 0; brick < hit.geometry.num_bricks(); ++brick) {
    const auto touched = [brick](const BitLayer& layer) { return layer.touched(brick); };
    if (!touched(hit.bits) && std::none_of(passed.begin(), passed.end(), touched)) continue;
    const auto [x, y, z] = hit.geometry.brick_corner(brick);
    // Rounding may carry a ray along the edge of the volume one voxel too far.
    if (std::min({x, y, z}) < 0 || std::max({x, y, z}) >= kKeysPerAxis) continue;
    const VoxelKey corner{static_cast<std::uint16_t>(x),
                          static_cast<std::uint16_t>(y),
                          static_cast<std::uint16_t>(z)};
    const std::uint32_t position = tree.bricks().prepare(BrickKey::of(corner));
    stage_labels(tree.bricks().writable(position), brick);
    staged.push_back({brick, position});
  }
  tree.bricks().reserve_changes(staged.size());
}

void FrameIntegrator::Workspace::stage_labels(Brick& brick, std::size_t window_brick) const {
  const BrickBits* labelled = votes.labelled(window_brick);
  if (labelled == nullptr) return;
  if (!brick.labels) brick.labels = std::make_unique<LabelTable>();
  BrickBits fresh = *labelled;
  for (std::size_t i = 0; i < fresh.words.size(); ++i) {
    fresh.words[i] &= ~brick.labels->labelled().words[i];
  }
  brick.labels->reserve_more(static_cast<std::size_t>(fresh.count()));
}

void FrameIntegrator::Workspace::gather_passed(std::size_t window_brick) noexcept {
  for (std::size_t part = 1; part < passed.size(); ++part) {
    if (!passed[part].touched(window_brick)) continue;
    passed.front().unite_brick(window_brick, passed[part].words(window_brick));
  }
}

void FrameIntegrator::Workspace::commit(SemanticOctree& tree, IntegrationReport& report) noexcept {
  for (const auto& [window_brick, position] : staged) {
    gather_passed(window_brick);
    Brick& brick = tree.bricks().writable(position);
    const std::uint64_t* hits = hit.bits.words(window_brick);
    const std::uint64_t* passes = passed.front().words(window_brick);
    bool changed =
        add_evidence({brick.known.words.data(), brick.occupied.words.data(), brick.log_odds.data()},
                     hits,
                     passes,
                     tree.sensor_model());
    for (std::size_t i = 0; i < 8; ++i) {
      report.num_occupied_voxels += static_cast<std::size_t>(std::popcount(hits[i]));
      report.num_free_voxels += static_cast<std::size_t>(std::popcount(passes[i] & ~hits[i]));
    }
    if (brick.labels) changed |= commit_labels(brick, window_brick, tree);
    if (const BrickBits* labelled = votes.labelled(window_brick)) {
      report.num_labelled_voxels += static_cast<std::size_t>(labelled->count());
    }
    if (changed) tree.bricks().note_change(position);
  }
  tree.bricks().commit();
  clear();
}

bool FrameIntegrator::Workspace::commit_labels(Brick& brick,
                                               std::size_t window_brick,
                                               const SemanticOctree& tree) noexcept {
  const SensorModel& model = tree.sensor_model();
  const MilliLogOdds limit = to_milli(tree.options().max_class_log_odds);
  // What was there is gone for good where the voxel is as free as it can be.
  const BrickBits before = brick.labels->labelled();
  before.for_each([&](std::size_t cell) {
    if (brick.log_odds[cell] == model.clamp_min) brick.labels->erase(cell);
  });
  bool changed = brick.labels->labelled() != before;
  if (const BrickBits* labelled = votes.labelled(window_brick)) {
    labelled->for_each([&](std::size_t cell) {
      observe(brick.labels->at(cell), evidence.of(votes.votes(window_brick, cell)), limit);
    });
    changed = true;
  }
  return changed;
}

void FrameIntegrator::Workspace::clear() noexcept {
  hit.bits.clear();
  far.bits.clear();
  for (BitLayer& layer : passed) layer.clear();
}

FrameIntegrator::FrameIntegrator() : workspace_(std::make_unique<Workspace>()) {}
FrameIntegrator::FrameIntegrator(FrameIntegrator&&) noexcept = default;
FrameIntegrator& FrameIntegrator::operator=(FrameIntegrator&&) noexcept = default;
FrameIntegrator::~FrameIntegrator() = default;

Result<IntegrationReport> FrameIntegrator::integrate(SemanticOctree& tree,
                                                     const RgbdFrame& frame,
                                                     std::span<const PixelLabels> labels,
                                                     const IntegrationOptions& options) {
  HYPERMAP_TRY(validate(options));
  HYPERMAP_TRY(validate(frame));
  HYPERMAP_TRY(check_sensor(tree.grid(), frame.map_from_camera.origin()));
  HYPERMAP_TRY(check_labels(labels, frame.depth_m.size()));
  return workspace_->integrate(tree, DepthPoints(frame), labels, options);
}

Result<IntegrationReport> FrameIntegrator::integrate_cloud(
    SemanticOctree& tree,
    const PointInMap& sensor,
    std::span<const Eigen::Vector3f> points_in_map,
    std::span<const PixelLabels> labels,
    const IntegrationOptions& options) {
  HYPERMAP_TRY(validate(options));
  HYPERMAP_TRY(check_sensor(tree.grid(), sensor));
  HYPERMAP_TRY(check_labels(labels, points_in_map.size()));
  return workspace_->integrate(tree, CloudPoints(sensor, points_in_map), labels, options);
}

}  // namespace hypermap
