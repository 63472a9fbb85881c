// SPDX-License-Identifier: BSD-3-Clause
#include "label_votes.hpp"

#include <algorithm>

namespace hypermap {

void LabelVotes::start(std::size_t num_bricks, std::size_t num_labels) {
  for (std::size_t i = 0; i < num_slabs_; ++i) slab_of_brick_[slabs_[i].brick] = kNoSlab;
  num_slabs_ = 0;
  further_.clear();
  if (slab_of_brick_.size() < num_bricks) slab_of_brick_.resize(num_bricks, kNoSlab);
  gathered_.reserve(num_labels);
}

LabelVotes::Slab& LabelVotes::slab(std::size_t brick) {
  if (slab_of_brick_[brick] == kNoSlab) {
    if (num_slabs_ == slabs_.size()) slabs_.emplace_back();
    Slab& fresh = slabs_[num_slabs_];
    fresh.labelled = {};
    fresh.brick = brick;
    slab_of_brick_[brick] = static_cast<std::uint32_t>(num_slabs_++);
  }
  return slabs_[slab_of_brick_[brick]];
}

void LabelVotes::add(std::uint32_t cell, std::uint32_t label, std::uint32_t count) {
  Slab& into = slab(cell / kBrickVolume);
  const std::size_t place = cell % kBrickVolume;
  auto& [first, second] = into.votes[place];
  if (!into.labelled.test(place)) {
    into.labelled.set(place);
    first = {label, count};
    second = {};
  } else if (first.label == label) {
    first.count += count;
  } else if (second.count == 0 || second.label == label) {
    second = {label, second.count + count};
  } else {
    further_.push_back({cell, label, count});
  }
}

void LabelVotes::finish() {
  std::sort(further_.begin(), further_.end());
}

std::span<const LabelVote> LabelVotes::votes(std::size_t brick, std::size_t cell) noexcept {
  gathered_.clear();
  for (const LabelVote& vote : slabs_[slab_of_brick_[brick]].votes[cell]) {
    if (vote.count != 0) gathered_.push_back(vote);
  }
  const auto number = static_cast<std::uint32_t>(brick * kBrickVolume + cell);
  auto further = std::lower_bound(further_.begin(), further_.end(), FurtherVote{number, 0, 0});
  for (; further != further_.end() && further->cell == number; ++further) {
    if (gathered_.back().label == further->label) {
      gathered_.back().count += further->count;
    } else {
      gathered_.push_back({further->label, further->count});
    }
  }
  std::sort(gathered_.begin(), gathered_.end(), [](const LabelVote& a, const LabelVote& b) {
    return a.label < b.label;
  });
  return gathered_;
}

}  // namespace hypermap
