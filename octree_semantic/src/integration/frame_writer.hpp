// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// From the marked voxels of a frame and its labels to the map: the steps that all frames and
/// clouds share once it is known what was hit and what was passed.
#pragma once

#include "hypermap/octree_semantic/integration/frame_integrator.hpp"
#include "integration/labels/belief_batch.hpp"
#include "integration/labels/label_evidence.hpp"
#include "integration/labels/label_votes.hpp"
#include "integration/marking/bit_window.hpp"
#include "kernels/kernels.hpp"
#include "octree/brick_table.hpp"
#include "workers.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// Bits of numbered bricks.
struct MarkedBricks {
  const BitLayer& hit;
  const BitLayer& passed;
  std::size_t num_bricks;
  /// Where a brick of that number lies; none outside the volume of the map.
  std::function<std::optional<BrickKey>(std::size_t)> key_of;
};

/// Call in this order: count_votes, stage, commit. All memory is kept from frame to frame.
class FrameWriter {
 public:
  /// Which labels ended where. Throws std::bad_alloc.
  void count_votes(const VoxelGrid& grid,
                   const MarkedBricks& marked,
                   std::span<const std::uint32_t> cell_of_measurement,
                   std::span<const PixelLabels> labels,
                   LabelVotes::Storage storage,
                   IntegrationReport& report);
  /// Makes or unshares every brick that will be written and a place for every label. Throws
  /// std::bad_alloc, and what is known of space is unchanged then.
  void stage(SemanticOctree& tree,
             const MarkedBricks& marked,
             const Workers& workers,
             IntegrationReport& report);
  void commit(SemanticOctree& tree,
              const MarkedBricks& marked,
              const Workers& workers,
              IntegrationReport& report) noexcept;

  /// Of the last frame's labels, see FrameIntegrator::label_boxes.
  [[nodiscard]] std::span<const std::optional<Box>> label_boxes() const noexcept {
    return label_boxes_;
  }

 private:
  /// A brick of the map that the frame changes.
  struct Staged {
    std::size_t brick_number = 0;
    std::uint32_t position = 0;
    bool changed = false;
  };
  void stage_brick(BrickTable& bricks,
                   const MarkedBricks& marked,
                   std::size_t brick_number,
                   IntegrationReport& report);
  void stage_labels(Brick& brick, std::size_t brick_number) const;
  void merge(SemanticOctree& tree,
             const MarkedBricks& marked,
             const Workers& workers,
             IntegrationReport& report) noexcept;
  bool commit_labels(Brick& brick, std::size_t brick_number, const SemanticOctree& tree) noexcept;
  /// Adds what the frame says to the labels of a brick that has votes.
  void observe_labels(LabelTable& labels, std::size_t brick_number, MilliLogOdds limit) noexcept;

  BeliefBatch batch_;
  std::vector<Staged> staged_;
  std::vector<std::uint8_t> merged_chunks_;   // 1: done
  std::vector<kernels::MergeCounts> merged_;  // one per worker
  std::vector<std::optional<Box>> label_boxes_;
  LabelVotes votes_;
  LabelEvidence evidence_;
};

}  // namespace hypermap
