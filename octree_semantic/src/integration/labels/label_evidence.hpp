// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What one frame's labels say about the class and object of a voxel.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"
#include "hypermap/octree_semantic/octree/voxel_label.hpp"
#include "kernels/kernels.hpp"
#include "label_votes.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// Evidence for one class in steps of 0.001: logit(p) - logit(1/N).
struct ScoredClass {
  std::uint16_t class_id = 0;
  std::int32_t evidence = 0;
};

/// A frame's evidence for the classes that its vector names.
struct VoxelEvidence {
  std::span<const ScoredClass> by_id;  ///< Ascending ids; at least those that the voxel keeps.
  /// The seven strongest at most, strongest first. Which of equals at the end of the seven are
  /// taken may depend on differences smaller than a step.
  std::span<const ScoredClass> best;
  ObjectId object;  ///< Of most measurements; the lower id of equals.
};

/// Turns votes into evidence: the class vectors are averaged over the measurements first, so that a
/// voxel gets one observation per frame however many measurements ended in it, then come to
/// log-odds. Where all measurements have one label (nearly everywhere), nothing is computed per
/// voxel; else only what the voxel's belief can use.
class LabelEvidence {
 public:
  /// Throws std::bad_alloc. Requires: `labels` outlives the use.
  void start(std::span<const PixelLabels> labels);
  /// Where all measurements of voxels have one label: what it says of them, for the kernel, and of
  /// which object. No scores when it names no class, or ids too large for a table.
  [[nodiscard]] std::optional<kernels::LabelScores> scores_of(std::uint32_t label,
                                                              MilliLogOdds limit) const noexcept;
  [[nodiscard]] ObjectId object_of(std::uint32_t label) const noexcept {
    return labels_[label].object;
  }
  /// For a voxel with that label. Valid until the next call.
  [[nodiscard]] VoxelEvidence of(std::span<const LabelVote> votes,
                                 const VoxelLabel& label) noexcept;

 private:
  struct Range {
    std::size_t first = 0;
    std::size_t count = 0;
  };
  struct Scored {
    std::vector<ScoredClass> by_id;
    std::vector<ScoredClass> best;
  };
  struct Prepared {
    Range by_id;
    Range best;
    Range table;  ///< Of evidence per class id.
  };
  /// Appends the table of a label whose evidence is prepared.
  [[nodiscard]] Range append_table(const Range& by_id);
  /// The votes' class vectors, weighted by their counts; stays in `sum_`.
  void average(std::span<const LabelVote> votes) noexcept;
  [[nodiscard]] VoxelEvidence mixed(std::span<const LabelVote> votes,
                                    const VoxelLabel& label,
                                    ObjectId object) noexcept;

  std::span<const PixelLabels> labels_;
  Scored scored_;  // of all labels, one after the other
  std::vector<Prepared> prepared_;
  std::vector<std::int32_t> tables_;
  std::vector<std::int32_t> best_ids_;  // beside those of scored_.best
  std::vector<std::int32_t> best_evidence_;
  std::vector<ClassEvidence> sum_;  // of the voxel at hand
  std::vector<ClassEvidence> merged_;
  Scored mixed_;
};

/// Adds the evidence to a voxel's belief: every class of the vector, then the cut to the best
/// three. When the best exceeds `limit`, all are lowered alike: two classes that a detector
/// confuses keep their difference.
///
/// Source: [smap] Eq. (3.18) in log-odds, within +-`limit`.
void observe(VoxelLabel& label, const VoxelEvidence& evidence, MilliLogOdds limit) noexcept;

}  // namespace hypermap
