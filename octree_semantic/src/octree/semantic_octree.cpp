// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"

#include "octree/brick_table.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <string>

namespace hypermap {
namespace {

Result<void> check_leaf(const StoredLeaf& leaf, const SensorModel& model, MilliLogOdds limit) {
  if (leaf.log_odds < model.clamp_min || leaf.log_odds > model.clamp_max) {
    return fail(ErrorCode::kInvalidArgument,
                "must lie between the clamps " + std::to_string(model.clamp_min) + " and " +
                    std::to_string(model.clamp_max) + ", is " + std::to_string(leaf.log_odds),
                "log_odds");
  }
  return leaf.label ? validate(*leaf.label, limit) : Result<void>{};
}

void write_leaf(Brick& brick, std::size_t cell, const StoredLeaf& leaf, const SensorModel& model) {
  brick.known.set(cell);
  brick.log_odds[cell] = leaf.log_odds;
  if (leaf.log_odds >= model.occupied_from) {
    brick.occupied.set(cell);
  } else {
    brick.occupied.reset(cell);
  }
  if (leaf.label) {
    brick.labels->at(cell) = *leaf.label;
  } else if (brick.labels) {
    brick.labels->erase(cell);
  }
}

/// How many leaves from the first on lie in its brick.
std::size_t num_in_first_brick(std::span<const StoredLeaf> leaves) {
  const VoxelKey first = leaves.front().key;
  const auto is_elsewhere = [&](const StoredLeaf& leaf) { return !in_one_brick(leaf.key, first); };
  return static_cast<std::size_t>(std::find_if(leaves.begin(), leaves.end(), is_elsewhere) -
                                  leaves.begin());
}

/// Requires: they lie in the brick.
void write_leaves(Brick& brick, std::span<const StoredLeaf> leaves, const SensorModel& model) {
  const auto is_labelled = [](const StoredLeaf& leaf) { return leaf.label.has_value(); };
  const auto num_labels = std::count_if(leaves.begin(), leaves.end(), is_labelled);
  if (num_labels > 0) {
    if (!brick.labels) brick.labels = std::make_unique<LabelTable>();
    brick.labels->reserve_more(static_cast<std::size_t>(num_labels));
  }
  for (const StoredLeaf& leaf : leaves) write_leaf(brick, cell_in_brick(leaf.key), leaf, model);
}

}  // namespace

SemanticOctree::SemanticOctree(const OctreeOptions& options, const SensorModel& model)
    : options_(options),
      grid_(options.resolution_m),
      model_(model),
      bricks_(CowRef<BrickTable>::make(model.clamp_min)) {}

SemanticOctree::SemanticOctree(const SemanticOctree& other) noexcept = default;
SemanticOctree::SemanticOctree(SemanticOctree&& other) noexcept = default;
SemanticOctree& SemanticOctree::operator=(const SemanticOctree& other) noexcept = default;
SemanticOctree& SemanticOctree::operator=(SemanticOctree&& other) noexcept = default;
SemanticOctree::~SemanticOctree() = default;

Result<SemanticOctree> SemanticOctree::create(const OctreeOptions& options) {
  HYPERMAP_TRY(validate(options));
  HYPERMAP_ASSIGN_OR_RETURN(const SensorModel model, SensorModel::create(options.sensor_model));
  try {
    return SemanticOctree(options, model);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for an octree");
  }
}

Result<SemanticOctree> SemanticOctree::from_leaves(const OctreeOptions& options,
                                                   std::span<const StoredLeaf> leaves) {
  HYPERMAP_ASSIGN_OR_RETURN(SemanticOctree tree, create(options));
  for (const StoredLeaf& leaf : leaves) {
    const Brick* brick = tree.bricks_->find(BrickKey::of(leaf.key));
    if (brick != nullptr && brick->known.test(cell_in_brick(leaf.key))) {
      return fail(ErrorCode::kInvalidArgument,
                  "voxel (" + std::to_string(leaf.key.x) + ", " + std::to_string(leaf.key.y) +
                      ", " + std::to_string(leaf.key.z) + ") occurs twice",
                  "key");
    }
    HYPERMAP_TRY(tree.set_leaf(leaf));
  }
  BrickTable& bricks = tree.bricks_.sole();
  for (std::uint32_t i = 0; i < bricks.size(); ++i) bricks.share_if_fully_free(i);
  return tree;
}

Result<void> SemanticOctree::set_leaf(const StoredLeaf& leaf) {
  return set_leaves({&leaf, 1});
}

Result<void> SemanticOctree::set_leaves(std::span<const StoredLeaf> leaves) {
  if (leaves.empty()) return {};
  const MilliLogOdds limit = to_milli(options_.max_class_log_odds);
  for (const StoredLeaf& leaf : leaves) HYPERMAP_TRY(check_leaf(leaf, model_, limit));
  try {
    BrickTable& bricks = bricks_.writable();
    while (!leaves.empty()) {
      const auto run = leaves.first(num_in_first_brick(leaves));
      const std::uint32_t position = bricks.prepare(BrickKey::of(run.front().key));
      write_leaves(bricks.writable(position), run, model_);
      bricks.note_written(position, true);
      leaves = leaves.subspan(run.size());
    }
    bricks.commit();
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for another voxel");
  }
  return {};
}

std::optional<StoredLeaf> SemanticOctree::stored_at(const VoxelKey& key) const {
  const Brick* brick = bricks_->find(BrickKey::of(key));
  const std::size_t cell = cell_in_brick(key);
  if (brick == nullptr || !brick->known.test(cell)) return std::nullopt;
  StoredLeaf leaf{.key = key, .log_odds = brick->log_odds[cell], .label = std::nullopt};
  if (const VoxelLabel* label = brick->label(cell)) leaf.label = *label;
  return leaf;
}

LeafSample SemanticOctree::sample(const VoxelKey& key, const Brick& brick, std::size_t cell) const {
  LeafSample leaf{.centre_in_map = grid_.centre(key).xyz,
                  .edge_m = resolution_m(),
                  .occupancy = from_milli(brick.log_odds[cell]),
                  .occupied = brick.occupied.test(cell),
                  .best_class = std::nullopt,
                  .class_log_odds = {},
                  .object = kNoObject};
  const VoxelLabel* label = leaf.occupied ? brick.label(cell) : nullptr;
  if (label != nullptr) {
    leaf.best_class = label->best_class();
    if (leaf.best_class) leaf.class_log_odds = from_milli(label->classes[0].log_odds);
    leaf.object = label->object;
  }
  return leaf;
}

std::optional<LeafSample> SemanticOctree::at(const VoxelKey& key) const {
  const Brick* brick = bricks_->find(BrickKey::of(key));
  const std::size_t cell = cell_in_brick(key);
  if (brick == nullptr || !brick->known.test(cell)) return std::nullopt;
  return sample(key, *brick, cell);
}

std::optional<LeafSample> SemanticOctree::at(const PointInMap& point) const {
  const auto key = grid_.key(point);
  return key ? at(*key) : std::nullopt;
}

LeafCount SemanticOctree::num_leaves() const {
  LeafCount count;
  for (std::uint32_t i = 0; i < bricks_->size(); ++i) {
    const Brick& brick = bricks_->brick(i);
    const int occupied = brick.occupied.count();
    count.occupied += static_cast<std::size_t>(occupied);
    count.free += static_cast<std::size_t>(brick.known.count() - occupied);
  }
  return count;
}

std::size_t SemanticOctree::num_bricks() const noexcept {
  return bricks_->size();
}

std::size_t SemanticOctree::memory_bytes() const {
  return sizeof(*this) + bricks_->memory_bytes();
}

Revision SemanticOctree::revision() const noexcept {
  return bricks_->revision();
}

bool operator==(const SemanticOctree& a, const SemanticOctree& b) {
  if (a.options_ != b.options_) return false;
  if (a.bricks_.shares(b.bricks_)) return true;
  const auto each_in = [](const BrickTable& some, const BrickTable& others) {
    for (std::uint32_t i = 0; i < some.size(); ++i) {
      const Brick* other = others.find(some.key(i));
      if (other == nullptr ? some.brick(i).known.any() : !same_content(some.brick(i), *other)) {
        return false;
      }
    }
    return true;
  };
  return each_in(*a.bricks_, *b.bricks_) && each_in(*b.bricks_, *a.bricks_);
}

}  // namespace hypermap
