// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Objects of one map in the numbering of another: classes, detectors and frames.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/objects/object_map.hpp"

#include <cstdint>
#include <vector>

namespace hypermap {

/// What the ids of one map are in another one.
struct IdTranslation {
  std::vector<ClassId> classes = {};       ///< By the id in the one map; each only once.
  std::vector<DetectorId> detectors = {};  ///< The same of detectors.
  std::uint64_t frame_offset = 0;          ///< What the index of each frame grows by.
};

/// The same objects by the ids of the other map: beliefs, priors and observation logs.
///
/// Errors: kInvalidArgument, naming the object, for an id that the translation does not know, two
/// ids that become one, and frames beyond 2^64 - 1. Cost: linear in what the objects hold.
[[nodiscard]] Result<ObjectMap> translated(const ObjectMap& objects,
                                           const IdTranslation& translation);

}  // namespace hypermap
