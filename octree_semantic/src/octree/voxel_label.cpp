// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/voxel_label.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

namespace hypermap {
namespace {

constexpr std::uint16_t kMaxVotes = 10;

bool in_order(const ClassWeight& a, const ClassWeight& b) {
  if (b.class_id == ClassWeight::kNone) return true;
  if (a.class_id == ClassWeight::kNone) return false;
  return a.log_odds > b.log_odds || (a.log_odds == b.log_odds && a.class_id < b.class_id);
}

bool exceeds(MilliLogOdds value, MilliLogOdds limit) {
  return value < -limit || value > limit;
}

}  // namespace

void VoxelLabel::vote(ObjectId id) noexcept {
  if (id == kNoObject) return;
  if (object_votes == 0) {
    object = id;
    object_votes = 1;
  } else if (object == id) {
    object_votes = std::min<std::uint16_t>(static_cast<std::uint16_t>(object_votes + 1), kMaxVotes);
  } else {
    object_votes = static_cast<std::uint16_t>(object_votes - 1);
  }
}

Result<void> validate(const VoxelLabel& label, MilliLogOdds limit) {
  for (std::size_t i = 0; i < label.classes.size(); ++i) {
    const ClassWeight& weight = label.classes[i];
    if (exceeds(weight.log_odds, limit)) {
      return fail(
          ErrorCode::kInvalidArgument,
          "must lie within +-" + std::to_string(limit) + ", is " + std::to_string(weight.log_odds),
          "classes");
    }
    for (std::size_t j = i + 1; j < label.classes.size(); ++j) {
      const bool duplicate =
          weight.class_id != ClassWeight::kNone && weight.class_id == label.classes[j].class_id;
      if (duplicate || !in_order(weight, label.classes[j])) {
        return fail(ErrorCode::kInvalidArgument,
                    "must be sorted, best first, no class twice, class " +
                        std::to_string(label.classes[j].class_id) + " is not",
                    "classes");
      }
    }
  }
  if (exceeds(label.rest, limit)) {
    return fail(ErrorCode::kInvalidArgument,
                "must lie within +-" + std::to_string(limit) + ", is " + std::to_string(label.rest),
                "rest");
  }
  if (label.object_votes > kMaxVotes || (label.object == kNoObject && label.object_votes != 0)) {
    return fail(
        ErrorCode::kInvalidArgument,
        "must be 0 to 10, and 0 without an object, is " + std::to_string(label.object_votes),
        "object_votes");
  }
  return {};
}

}  // namespace hypermap
