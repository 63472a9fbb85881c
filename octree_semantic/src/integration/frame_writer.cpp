// SPDX-License-Identifier: BSD-3-Clause
#include "frame_writer.hpp"

#include "integration/marking/cell_finder.hpp"
#include "octree/brick_access.hpp"

#include <algorithm>
#include <bit>
#include <memory>

namespace hypermap {
namespace {

constexpr std::size_t kBricksPerChunk = 32;

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

/// The brick whose lower corner has this key. Unit: metre.
Box box_of_brick(const VoxelKey& corner, const VoxelGrid& grid) {
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * grid.resolution_m());
  const Eigen::Vector3d low = grid.centre(corner).xyz - half;
  return {low, low + 2.0 * kBrickEdge * half};
}

void include(std::optional<Box>& box, const Box& other) {
  box = box ? bounding_box(*box, other) : other;
}

}  // namespace

void FrameWriter::count_votes(const VoxelGrid& grid,
                              const MarkedBricks& marked,
                              std::span<const std::uint32_t> cell_of_measurement,
                              std::span<const PixelLabels> labels,
                              LabelVotes::Storage storage,
                              IntegrationReport& report) {
  votes_.start(marked.num_bricks, labels.size(), storage);
  evidence_.start(labels);
  label_boxes_.assign(labels.size(), std::nullopt);
  for (std::uint32_t label = 0; label < labels.size(); ++label) {
    std::size_t last_brick = marked.num_bricks;
    const auto vote = [&](std::uint32_t cell, std::uint32_t count) {
      if (cell == kNoCell || !marked.hit.test(cell)) return;
      votes_.add(cell, label, count);
      report.num_labelled_hits += count;
      const std::size_t brick = cell / kBrickVolume;
      if (brick == last_brick) return;
      last_brick = brick;
      if (const auto key = marked.key_of(brick)) {
        include(label_boxes_[label], box_of_brick(key->corner(), grid));
      }
    };
    // Neighbouring pixels mostly end in one voxel: they vote together.
    std::uint32_t cell = kNoCell;
    std::uint32_t count = 0;
    for (const std::uint32_t index : labels[label].pixel_indices) {
      if (cell_of_measurement[index] != cell) {
        vote(cell, count);
        cell = cell_of_measurement[index];
        count = 0;
      }
      ++count;
    }
    vote(cell, count);
  }
  votes_.finish();
}

void FrameWriter::stage(SemanticOctree& tree,
                        const MarkedBricks& marked,
                        const Workers& workers,
                        IntegrationReport& report) {
  staged_.clear();
  BrickTable& bricks = BrickAccess::writable(tree);
  const std::size_t num_bricks_before = bricks.size();
  for (std::size_t group = 0; group < marked.hit.num_groups(); ++group) {
    if ((marked.hit.touched_group(group) | marked.passed.touched_group(group)) == 0) continue;
    for (std::size_t brick = group * 8; brick < group * 8 + 8; ++brick) {
      if (marked.hit.touched(brick) || marked.passed.touched(brick)) {
        stage_brick(bricks, marked, brick, report);
      }
    }
  }
  merged_.assign(workers.num_slots(), {});
  merged_chunks_.assign((staged_.size() + kBricksPerChunk - 1) / kBricksPerChunk, 0);
  report.num_new_bricks = bricks.size() - num_bricks_before;
}

void FrameWriter::stage_brick(BrickTable& bricks,
                              const MarkedBricks& marked,
                              std::size_t brick_number,
                              IntegrationReport& report) {
  const std::optional<BrickKey> key = marked.key_of(brick_number);
  if (!key) return;
  const bool is_hit = marked.hit.touched(brick_number);
  const std::uint32_t position = is_hit ? bricks.prepare(*key) : bricks.prepare_to_free(*key);
  if (!is_hit && bricks.is_fully_free(position)) {
    report.num_free_voxels += count_bits(marked.passed.words(brick_number));
    return;
  }
  stage_labels(bricks.writable(position), brick_number);
  staged_.push_back({brick_number, position, false});
}

void FrameWriter::stage_labels(Brick& brick, std::size_t brick_number) const {
  const BrickBits* labelled = votes_.labelled(brick_number);
  if (labelled == nullptr) return;
  if (!brick.labels) brick.labels = std::make_unique<LabelTable>();
  BrickBits fresh = *labelled;
  for (std::size_t i = 0; i < fresh.words.size(); ++i) {
    fresh.words[i] &= ~brick.labels->labelled().words[i];
  }
  brick.labels->reserve_more(static_cast<std::size_t>(fresh.count()));
}

void FrameWriter::commit(SemanticOctree& tree,
                         const MarkedBricks& marked,
                         const Workers& workers,
                         IntegrationReport& report) noexcept {
  merge(tree, marked, workers, report);
  BrickTable& bricks = BrickAccess::sole(tree);
  for (const auto& [brick_number, position, occupancy_changed] : staged_) {
    Brick& brick = bricks.writable(position);
    bool changed = occupancy_changed;
    if (brick.labels) changed |= commit_labels(brick, brick_number, tree);
    if (const BrickBits* labelled = votes_.labelled(brick_number)) {
      report.num_labelled_voxels += static_cast<std::size_t>(labelled->count());
    }
    bricks.note_written(position, changed);
    bricks.share_if_fully_free(position);
  }
  bricks.commit();
}

void FrameWriter::merge(SemanticOctree& tree,
                        const MarkedBricks& marked,
                        const Workers& workers,
                        IntegrationReport& report) noexcept {
  const kernels::EvidenceSteps steps = steps_of(tree.sensor_model());
  BrickTable& bricks = BrickAccess::sole(tree);
  const auto merge_brick = kernels::best_kernels().merge_brick;
  const auto merge_chunk = [&](std::size_t slot, std::size_t chunk) {
    kernels::MergeCounts& total = merged_[slot];
    const std::size_t end = std::min(staged_.size(), (chunk + 1) * kBricksPerChunk);
    for (std::size_t i = chunk * kBricksPerChunk; i < end; ++i) {
      Staged& staged = staged_[i];
      Brick& brick = bricks.writable(staged.position);
      const kernels::MergeCounts counts = merge_brick(
          {brick.known.words.data(), brick.occupied.words.data(), brick.log_odds.data()},
          marked.hit.words(staged.brick_number),
          marked.passed.words(staged.brick_number),
          steps);
      staged.changed = counts.changed;
      total.num_hit += counts.num_hit;
      total.num_passed += counts.num_passed;
    }
  };
  workers.finish_each(merged_chunks_, merge_chunk);
  for (const kernels::MergeCounts& total : merged_) {
    report.num_occupied_voxels += total.num_hit;
    report.num_free_voxels += total.num_passed;
  }
}

bool FrameWriter::commit_labels(Brick& brick,
                                std::size_t brick_number,
                                const SemanticOctree& tree) noexcept {
  const SensorModel& model = tree.sensor_model();
  const MilliLogOdds limit = to_milli(tree.options().max_class_log_odds);
  // What was there is gone for good where the voxel is as free as it can be.
  const BrickBits before = brick.labels->labelled();
  before.for_each([&](std::size_t cell) {
    if (brick.log_odds[cell] == model.clamp_min) brick.labels->erase(cell);
  });
  bool changed = brick.labels->labelled() != before;
  if (votes_.labelled(brick_number) != nullptr) {
    observe_labels(*brick.labels, brick_number, limit);
    changed = true;
  }
  return changed;
}

void FrameWriter::observe_labels(LabelTable& labels,
                                 std::size_t brick_number,
                                 MilliLogOdds limit) noexcept {
  const BrickBits& labelled = *votes_.labelled(brick_number);
  labelled.for_each([&](std::size_t cell) { static_cast<void>(labels.at(cell)); });
  // From here on no label moves. Voxels of one label are merged together.
  std::uint32_t of_batch = 0;
  std::optional<kernels::LabelScores> scores;
  labelled.for_each([&](std::size_t cell) {
    VoxelLabel& label = *labels.find(cell);
    const std::span<const LabelVote> votes = votes_.votes(brick_number, cell);
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

}  // namespace hypermap
