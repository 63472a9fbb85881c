// SPDX-License-Identifier: BSD-3-Clause
#include "belief_batch.hpp"

#include <cassert>
#include <cstdint>

namespace hypermap {
namespace {

constexpr std::int32_t kIdMask = 0xFFFF;

std::int32_t ranked(const ClassWeight& weight) noexcept {
  if (weight.class_id == ClassWeight::kNone) return kernels::kNoClass;
  return std::int32_t{weight.log_odds} * (kIdMask + 1) + kIdMask - weight.class_id;
}

ClassWeight weight_of(std::int32_t ranked) noexcept {
  if (ranked == kernels::kNoClass) return {};
  return {static_cast<std::uint16_t>(kIdMask - (ranked & kIdMask)),
          static_cast<MilliLogOdds>(ranked >> 16)};
}

}  // namespace

void BeliefBatch::add(VoxelLabel& label) noexcept {
  assert(size_ < labels_.size());
  for (std::size_t i = 0; i < label.classes.size(); ++i) {
    lanes_.classes[i][size_] = ranked(label.classes[i]);
  }
  lanes_.rest[size_] = label.rest;
  labels_[size_++] = &label;
}

void BeliefBatch::merge(const kernels::LabelScores& scores) noexcept {
  kernels::best_kernels().merge_labels(scores, size_, lanes_);
  for (std::size_t voxel = 0; voxel < size_; ++voxel) {
    VoxelLabel& label = *labels_[voxel];
    for (std::size_t i = 0; i < label.classes.size(); ++i) {
      label.classes[i] = weight_of(lanes_.classes[i][voxel]);
    }
    label.rest = static_cast<MilliLogOdds>(lanes_.rest[voxel]);
  }
  size_ = 0;
}

}  // namespace hypermap
