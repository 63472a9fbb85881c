// SPDX-License-Identifier: BSD-3-Clause
#include "octree/brick.hpp"

#include "octree/brick_pool.hpp"

#include <algorithm>

namespace hypermap {
namespace {

bool same_occupancy(const Brick& a, const Brick& b) noexcept {
  return a.known == b.known && a.log_odds == b.log_odds;
}

bool is_labelled(const Brick& brick) noexcept {
  return brick.labels && brick.labels->size() != 0;
}

/// Whether `other` has each label of `brick` that is not blank.
bool labels_are_those_of(const Brick& other, const Brick& brick) noexcept {
  bool same = true;
  if (!brick.labels) return same;
  brick.labels->labelled().for_each([&](std::size_t cell) {
    const VoxelLabel* label = other.label(cell);
    same = same && *brick.label(cell) == (label == nullptr ? VoxelLabel{} : *label);
  });
  return same;
}

}  // namespace

VoxelLabel& LabelTable::at(std::size_t cell) {
  const std::size_t rank = labelled_.rank(cell);
  if (!labelled_.test(cell)) {
    labels_.insert(labels_.begin() + static_cast<std::ptrdiff_t>(rank), VoxelLabel{});
    labelled_.set(cell);
  }
  return labels_[rank];
}

void LabelTable::reserve_more(std::size_t num_new) {
  const std::size_t needed = labels_.size() + num_new;
  if (needed <= labels_.capacity()) return;
  // Grows by half: brick by brick, a map's labels should not hold twice what they need.
  labels_.reserve(std::min(kBrickVolume, std::max(needed, labels_.capacity() * 3 / 2)));
}

void LabelTable::erase(std::size_t cell) noexcept {
  if (!labelled_.test(cell)) return;
  labels_.erase(labels_.begin() + static_cast<std::ptrdiff_t>(labelled_.rank(cell)));
  labelled_.reset(cell);
}

Brick::Brick(const Brick& other)
    : known(other.known),
      occupied(other.occupied),
      log_odds(other.log_odds),
      labels(other.labels ? std::make_unique<LabelTable>(*other.labels) : nullptr) {}

bool same_content(const Brick& a, const Brick& b) noexcept {
  if (!same_occupancy(a, b)) return false;
  if (a.labels && b.labels && *a.labels == *b.labels) return true;
  return labels_are_those_of(a, b) && labels_are_those_of(b, a);
}

bool same_unlabelled(const Brick& a, const Brick& b) noexcept {
  return same_occupancy(a, b) && !is_labelled(a) && !is_labelled(b);
}

void Brick::dispose(Brick* brick) noexcept {
  if (brick->home != nullptr) {
    brick->home->give_back(brick);
  } else {
    const std::unique_ptr<Brick> last(brick);
  }
}

}  // namespace hypermap
