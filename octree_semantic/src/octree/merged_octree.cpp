// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/merged_octree.hpp"

#include "hypermap/core/base/number_text.hpp"
#include "octree/brick_access.hpp"
#include "octree/clamp_trace.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <new>
#include <string>

namespace hypermap {
namespace {

struct ComparedOption {
  const char* field;
  double first;
  double second;
};

/// Two maps add up voxel by voxel only when a step of log-odds means the same in both.
Result<void> check_same_options(const OctreeOptions& first, const OctreeOptions& second) {
  const SensorModelOptions& a = first.sensor_model;
  const SensorModelOptions& b = second.sensor_model;
  const std::array<ComparedOption, 7> numbers{
      {{"resolution_m", first.resolution_m, second.resolution_m},
       {"hit", a.hit.value(), b.hit.value()},
       {"miss", a.miss.value(), b.miss.value()},
       {"clamp_min", a.clamp_min.value(), b.clamp_min.value()},
       {"clamp_max", a.clamp_max.value(), b.clamp_max.value()},
       {"occupied_from", a.occupied_from.value(), b.occupied_from.value()},
       {"max_class_log_odds",
        first.max_class_log_odds.value(),
        second.max_class_log_odds.value()}}};
  for (const ComparedOption& number : numbers) {
    if (number.first == number.second) continue;
    return fail(ErrorCode::kInvalidArgument,
                "must be that of the other map, " + number_text(number.first) + ", is " +
                    number_text(number.second),
                number.field);
  }
  return {};
}

/// The label as the other map calls what it names.
VoxelLabel translated(VoxelLabel label, const OctreeMergeOptions& options) {
  if (options.object_of && label.object != kNoObject) {
    label.object = options.object_of(label.object);
    if (label.object == kNoObject) label.object_votes = 0;
  }
  if (!options.class_of) return label;
  for (ClassWeight& kept : label.classes) {
    if (kept.class_id == ClassWeight::kNone) continue;
    kept.class_id = static_cast<std::uint16_t>(options.class_of(ClassId{kept.class_id}).value);
  }
  return label;
}

/// Whether it only says that space is free. Unknown voxels have log-odds 0.
bool only_frees(const Brick& brick) {
  return !brick.labels &&
         std::ranges::all_of(brick.log_odds, [](MilliLogOdds l) { return l <= 0; });
}

class OctreeSum {
 public:
  OctreeSum(SemanticOctree& sum, const OctreeMergeOptions& options)
      : model_(sum.sensor_model()),
        trace_(model_),
        limit_(to_milli(sum.options().max_class_log_odds)),
        options_(&options),
        bricks_(&BrickAccess::writable(sum)) {}

  void add(const BrickTable& added) {
    for (std::uint32_t i = 0; i < added.size(); ++i) {
      if (added.brick(i).known.any()) add(added.key(i), added.brick(i));
    }
    bricks_->commit();
  }

 private:
  void add(BrickKey key, const Brick& added) {
    const bool is_free = only_frees(added);
    const std::uint32_t position = is_free ? bricks_->prepare_to_free(key) : bricks_->prepare(key);
    if (is_free && bricks_->is_fully_free(position)) return;  // it cannot become any freer
    Brick& brick = bricks_->writable(position);
    added.known.for_each(
        [&](std::size_t cell) { add_occupancy(brick, cell, added.log_odds[cell]); });
    if (added.labels) add_labels(brick, added);
    bricks_->note_written(position, true);
    bricks_->share_if_fully_free(position);
  }

  void add_occupancy(Brick& brick, std::size_t cell, MilliLogOdds added) const {
    const bool is_replaced = options_->times == MergedTimes::kLater && trace_.was_clamped(added);
    const int before = is_replaced || !brick.known.test(cell) ? 0 : brick.log_odds[cell];
    const int sum = std::clamp<int>(before + added, model_.clamp_min, model_.clamp_max);
    brick.known.set(cell);
    brick.log_odds[cell] = static_cast<MilliLogOdds>(sum);
    if (sum >= model_.occupied_from) {
      brick.occupied.set(cell);
    } else {
      brick.occupied.reset(cell);
    }
  }

  void add_labels(Brick& brick, const Brick& added) const {
    if (!brick.labels) brick.labels = std::make_unique<LabelTable>();
    brick.labels->reserve_more(added.labels->size());
    added.labels->labelled().for_each([&](std::size_t cell) {
      VoxelLabel& label = brick.labels->at(cell);
      label = sum_of(label, translated(*added.label(cell), *options_), limit_);
    });
  }

  SensorModel model_;
  ClampTrace trace_;
  MilliLogOdds limit_;
  const OctreeMergeOptions* options_;
  BrickTable* bricks_;
};

}  // namespace

Result<SemanticOctree> merged(SemanticOctree octree,
                              const SemanticOctree& added,
                              const OctreeMergeOptions& options) {
  HYPERMAP_TRY(check_same_options(octree.options(), added.options()));
  try {
    OctreeSum(octree, options).add(BrickAccess::bricks(added));
    return octree;
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for the sum of two maps");
  }
}

}  // namespace hypermap
