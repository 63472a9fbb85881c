// SPDX-License-Identifier: BSD-3-Clause
#include "integration_workspace.hpp"

#include "frame_checks.hpp"
#include "integration/marking/cell_finder.hpp"
#include "integration/marking/ray_marking.hpp"
#include "integration/marking/sparse_rays.hpp"
#include "octree/brick_access.hpp"

#include <algorithm>
#include <bit>
#include <new>
#include <optional>

namespace hypermap {
namespace {

/// Farther than any volume of a map: no limit.
constexpr double kEverywhereM = 1e9;
/// Measurements beyond the range are united by voxel within a window of at most so many cells, that
/// is 32 MiB of bits; else each gets a ray of its own.
constexpr double kMaxFarCells = 268435456.0;
constexpr std::size_t kRaysPerChunk = RayMarker::kMaxRays;
constexpr std::size_t kBricksPerChunk = 32;

std::size_t num_chunks_of(std::size_t size, std::size_t per_chunk) {
  return (size + per_chunk - 1) / per_chunk;
}

void add(IntegrationReport& total, const IntegrationReport& more) {
  total.num_hits += more.num_hits;
  total.num_beyond_range += more.num_beyond_range;
  total.num_not_measured += more.num_not_measured;
  total.num_not_finite += more.num_not_finite;
  total.num_outside_volume += more.num_outside_volume;
}

template <class T>
void append(std::vector<T>& all, std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
  more.clear();
}

std::size_t count_bits(const std::uint64_t* words) {
  std::size_t total = 0;
  for (std::size_t i = 0; i < kBrickVolume / 64; ++i) {
    total += static_cast<std::size_t>(std::popcount(words[i]));
  }
  return total;
}

kernels::EvidenceSteps steps_of(const SensorModel& model) {
  return {model.hit, model.miss, model.clamp_min, model.clamp_max, model.occupied_from};
}

}  // namespace

Result<IntegrationReport> IntegrationWorkspace::integrate(SemanticOctree& tree,
                                                          const MeasuredPoints& points,
                                                          const DepthPoints* picture,
                                                          std::span<const PixelLabels> labels,
                                                          const IntegrationOptions& options) {
  const double resolution_m = tree.resolution_m();
  const KeyBox reach = points.reach(resolution_m, options.max_range_m);
  if (!window_.cover(reach, WindowGeometry::kMaxCells)) return window_too_large(reach, options);
  IntegrationReport report;
  try {
    prepare(options);
    const bool by_voxel = options.mode == IntegrationMode::kDiscretize;
    const EndPoints ends(
        resolution_m,
        points.sensor(),
        options,
        window_,
        by_voxel ? prepare_far(points.reach(resolution_m, kEverywhereM)) : nullptr);
    find_ends(points, ends, options.mode, report);  // where measurements end
    if (by_voxel) ends.cast_from_voxels(slots_.front().ends);
    if (options.mode == IntegrationMode::kProjective) {
      project(*picture, ends, resolution_m, options.max_range_m);  // what they looked through
    }
    cast_rays(resolution_m, points.sensor());  // what rays passed through
    count_votes(labels, report);               // which labels ended where
    const std::size_t num_bricks_before = tree.num_bricks();
    stage(tree, report);  // all memory that the map will need
    report.num_new_bricks = tree.num_bricks() - num_bricks_before;
  } catch (const std::bad_alloc&) {
    clear();
    return fail(ErrorCode::kOutOfMemory, "no memory to integrate the frame");
  }
  commit(tree, report);
  return report;
}

void IntegrationWorkspace::prepare(const IntegrationOptions& options) {
  workers_.set_num_threads(options.num_threads);
  slots_.resize(workers_.num_slots());
  for (Slot& slot : slots_) {
    slot.ends.hit.fit(window_.num_bricks());
    slot.passed.fit(window_.num_bricks());
    slot.ends.ray_ends.clear();
    slot.ends.dropped.clear();
    slot.ends.report = {};
    slot.merged = {};
  }
}

const WindowGeometry* IntegrationWorkspace::prepare_far(const KeyBox& everything) {
  if (!far_window_.cover(everything, kMaxFarCells)) return nullptr;
  for (Slot& slot : slots_) slot.ends.far.fit(far_window_.num_bricks());
  return &far_window_;
}

void IntegrationWorkspace::find_ends(const MeasuredPoints& points,
                                     const EndPoints& ends,
                                     IntegrationMode mode,
                                     IntegrationReport& report) {
  cell_of_measurement_.resize(points.size());
  if (mode == IntegrationMode::kExact) {
    // Any thread may get most of them, from frame to frame.
    for (Slot& slot : slots_) slot.ends.ray_ends.reserve(points.size());
  }
  workers_.for_each(points.num_chunks(), [&](std::size_t slot, std::size_t chunk) {
    EndSink& sink = slots_[slot].ends;
    points.read(chunk, sink.chunk, sink.report);
    ends.add(sink, std::span(cell_of_measurement_).subspan(sink.chunk.first, sink.chunk.size));
  });
  EndSink& first = slots_.front().ends;
  for (Slot& slot : slots_) {
    add(report, slot.ends.report);
    if (&slot == &slots_.front()) continue;
    first.hit.take(slot.ends.hit);
    first.far.take(slot.ends.far);
    append(first.ray_ends, slot.ends.ray_ends);
    append(first.dropped, slot.ends.dropped);
  }
}

void IntegrationWorkspace::cast_rays(double resolution_m, const PointF& sensor) {
  const RayMarker marker(window_, resolution_m, sensor);
  const std::vector<PointF>& rays = ray_ends();
  workers_.for_each(
      num_chunks_of(rays.size(), kRaysPerChunk), [&](std::size_t slot, std::size_t chunk) {
        const std::size_t first = chunk * kRaysPerChunk;
        const std::size_t size = std::min(rays.size() - first, kRaysPerChunk);
        marker.mark(std::span(rays).subspan(first, size), slots_[slot].passed.marker());
      });
  for (std::size_t i = 1; i < slots_.size(); ++i) passed().take(slots_[i].passed);
}

void IntegrationWorkspace::project(const DepthPoints& picture,
                                   const EndPoints& ends,
                                   double resolution_m,
                                   double max_range_m) {
  const RgbdFrame& frame = picture.frame();
  const EndSink& found = slots_.front().ends;
  pyramid_.build(frame.depth_m.pixels(), frame.camera.width_px, found.dropped, workers_);
  projection_.mark(frame, pyramid_, resolution_m, max_range_m, window_, workers_, passed());
  add_sparse_rays(picture, pyramid_, ends, cell_of_measurement_, ray_ends());
}

void IntegrationWorkspace::count_votes(std::span<const PixelLabels> labels,
                                       IntegrationReport& report) {
  votes_.start(window_.num_bricks(), labels.size());
  evidence_.start(labels);
  for (std::uint32_t label = 0; label < labels.size(); ++label) {
    // Neighbouring pixels mostly end in one voxel: they vote together.
    std::uint32_t cell = kNoCell;
    std::uint32_t count = 0;
    const auto vote = [&] {
      if (cell == kNoCell || !hit().test(cell)) return;
      votes_.add(cell, label, count);
      report.num_labelled_hits += count;
    };
    for (const std::uint32_t index : labels[label].pixel_indices) {
      if (cell_of_measurement_[index] != cell) {
        vote();
        cell = cell_of_measurement_[index];
        count = 0;
      }
      ++count;
    }
    vote();
  }
  votes_.finish();
}

void IntegrationWorkspace::stage(SemanticOctree& tree, IntegrationReport& report) {
  staged_.clear();
  BrickTable& bricks = BrickAccess::writable(tree);
  for (std::size_t group = 0; group < hit().num_groups(); ++group) {
    if ((hit().touched_group(group) | passed().touched_group(group)) == 0) continue;
    for (std::size_t brick = group * 8; brick < group * 8 + 8; ++brick) {
      if (hit().touched(brick) || passed().touched(brick)) stage_brick(bricks, brick, report);
    }
  }
}

void IntegrationWorkspace::stage_brick(BrickTable& bricks,
                                       std::size_t window_brick,
                                       IntegrationReport& report) {
  const auto [x, y, z] = window_.brick_corner(window_brick);
  // Rounding may carry a ray along the edge of the volume one voxel too far.
  if (std::min({x, y, z}) < 0 || std::max({x, y, z}) >= kKeysPerAxis) return;
  const VoxelKey corner{
      static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), static_cast<std::uint16_t>(z)};
  const BrickKey key = BrickKey::of(corner);
  const bool is_hit = hit().touched(window_brick);
  const std::uint32_t position = is_hit ? bricks.prepare(key) : bricks.prepare_to_free(key);
  if (!is_hit && bricks.is_freest(position)) {
    report.num_free_voxels += count_bits(passed().words(window_brick));
    return;
  }
  stage_labels(bricks.writable(position), window_brick);
  staged_.push_back({window_brick, position, false});
}

void IntegrationWorkspace::stage_labels(Brick& brick, std::size_t window_brick) const {
  const BrickBits* labelled = votes_.labelled(window_brick);
  if (labelled == nullptr) return;
  if (!brick.labels) brick.labels = std::make_unique<LabelTable>();
  BrickBits fresh = *labelled;
  for (std::size_t i = 0; i < fresh.words.size(); ++i) {
    fresh.words[i] &= ~brick.labels->labelled().words[i];
  }
  brick.labels->reserve_more(static_cast<std::size_t>(fresh.count()));
}

void IntegrationWorkspace::commit(SemanticOctree& tree, IntegrationReport& report) noexcept {
  merge(tree, report);
  BrickTable& bricks = BrickAccess::sole(tree);
  for (const auto& [window_brick, position, occupancy_changed] : staged_) {
    Brick& brick = bricks.writable(position);
    bool changed = occupancy_changed;
    if (brick.labels) changed |= commit_labels(brick, window_brick, tree);
    if (const BrickBits* labelled = votes_.labelled(window_brick)) {
      report.num_labelled_voxels += static_cast<std::size_t>(labelled->count());
    }
    bricks.note_written(position, changed);
    bricks.share_if_freest(position);
  }
  bricks.commit();
  clear();
}

void IntegrationWorkspace::merge(SemanticOctree& tree, IntegrationReport& report) noexcept {
  const kernels::EvidenceSteps steps = steps_of(tree.sensor_model());
  BrickTable& bricks = BrickAccess::sole(tree);
  const auto merge_brick = kernels::best_kernels().merge_brick;
  const auto merge_chunk = [&](std::size_t slot, std::size_t chunk) {
    kernels::MergeCounts& total = slots_[slot].merged;
    const std::size_t end = std::min(staged_.size(), (chunk + 1) * kBricksPerChunk);
    for (std::size_t i = chunk * kBricksPerChunk; i < end; ++i) {
      Staged& staged = staged_[i];
      Brick& brick = bricks.writable(staged.position);
      const kernels::MergeCounts counts = merge_brick(
          {brick.known.words.data(), brick.occupied.words.data(), brick.log_odds.data()},
          hit().words(staged.window_brick),
          passed().words(staged.window_brick),
          steps);
      staged.changed = counts.changed;
      total.num_hit += counts.num_hit;
      total.num_passed += counts.num_passed;
    }
  };
  workers_.for_each(num_chunks_of(staged_.size(), kBricksPerChunk), merge_chunk);
  for (const Slot& slot : slots_) {
    report.num_occupied_voxels += slot.merged.num_hit;
    report.num_free_voxels += slot.merged.num_passed;
  }
}

bool IntegrationWorkspace::commit_labels(Brick& brick,
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
  if (votes_.labelled(window_brick) != nullptr) {
    observe_labels(*brick.labels, window_brick, limit);
    changed = true;
  }
  return changed;
}

void IntegrationWorkspace::observe_labels(LabelTable& labels,
                                          std::size_t window_brick,
                                          MilliLogOdds limit) noexcept {
  const BrickBits& labelled = *votes_.labelled(window_brick);
  labelled.for_each([&](std::size_t cell) { static_cast<void>(labels.at(cell)); });
  // From here on no label moves. Voxels of one label are merged together.
  std::uint32_t of_batch = 0;
  std::optional<kernels::LabelScores> scores;
  labelled.for_each([&](std::size_t cell) {
    VoxelLabel& label = *labels.find(cell);
    const std::span<const LabelVote> votes = votes_.votes(window_brick, cell);
    const std::uint32_t named = votes.front().label;
    if (votes.size() == 1 && (!scores || named != of_batch)) {
      if (!batch_.empty()) batch_.merge(*scores);
      of_batch = named;
      scores = evidence_.scores_of(named, limit);
    }
    if (votes.size() == 1 && scores) {
      label.vote(evidence_.object_of(named));
      batch_.add(label);
    } else {
      observe(label, evidence_.of(votes, label), limit);
    }
  });
  if (!batch_.empty()) batch_.merge(*scores);
}

void IntegrationWorkspace::clear() noexcept {
  for (Slot& slot : slots_) {
    slot.ends.hit.clear();
    slot.ends.far.clear();
    slot.passed.clear();
  }
}

}  // namespace hypermap
