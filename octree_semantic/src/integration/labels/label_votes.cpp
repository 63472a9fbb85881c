// SPDX-License-Identifier: BSD-3-Clause
#include "label_votes.hpp"

#include <algorithm>

namespace hypermap {

void LabelVotes::start(std::size_t num_bricks, std::size_t num_labels, Storage storage) {
  for (std::size_t i = 0; i < num_slabs_; ++i) slab_of_brick_[slabs_[i].brick] = kNoSlab;
  num_slabs_ = 0;
  further_.clear();
  storage_ = storage;
  if (slab_of_brick_.size() < num_bricks) slab_of_brick_.resize(num_bricks, kNoSlab);
  gathered_.reserve(num_labels);
}

std::size_t LabelVotes::slab(std::size_t brick) {
  if (slab_of_brick_[brick] == kNoSlab) {
    if (num_slabs_ == slabs_.size()) slabs_.emplace_back();
    if (storage_ == Storage::kInPlace && num_slabs_ >= places_.size()) {
      places_.resize(num_slabs_ + 1);
    }
    slabs_[num_slabs_] = {.labelled = {}, .brick = brick};
    slab_of_brick_[brick] = static_cast<std::uint32_t>(num_slabs_++);
  }
  return slab_of_brick_[brick];
}

bool LabelVotes::add_in_place(std::size_t slab, std::size_t cell, const LabelVote& vote) {
  auto& [first, second] = places_[slab][cell];
  if (!slabs_[slab].labelled.test(cell)) {
    first = vote;
    second = {};
  } else if (first.label == vote.label) {
    first.count += vote.count;
  } else if (second.count == 0 || second.label == vote.label) {
    second = {vote.label, second.count + vote.count};
  } else {
    return false;
  }
  return true;
}

void LabelVotes::add(std::uint32_t cell, std::uint32_t label, std::uint32_t count) {
  const std::size_t into = slab(cell / kBrickVolume);
  const std::size_t place = cell % kBrickVolume;
  const bool is_placed = storage_ == Storage::kInPlace && add_in_place(into, place, {label, count});
  if (!is_placed) further_.push_back({cell, label, count});
  slabs_[into].labelled.set(place);
}

void LabelVotes::finish() {
  std::sort(further_.begin(), further_.end());
}

std::span<const LabelVote> LabelVotes::votes(std::size_t brick, std::size_t cell) noexcept {
  gathered_.clear();
  if (storage_ == Storage::kInPlace) {
    for (const LabelVote& vote : places_[slab_of_brick_[brick]][cell]) {
      if (vote.count != 0) gathered_.push_back(vote);
    }
  }
  const auto number = static_cast<std::uint32_t>(brick * kBrickVolume + cell);
  auto further = std::lower_bound(further_.begin(), further_.end(), FurtherVote{number, 0, 0});
  for (; further != further_.end() && further->cell == number; ++further) {
    if (!gathered_.empty() && gathered_.back().label == further->label) {
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
