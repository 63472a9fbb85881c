// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The objects of two maps of one place as those of one map.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/objects/association.hpp"
#include "hypermap/core/objects/object_map.hpp"

#include <cstddef>
#include <map>

namespace hypermap {

/// The objects of both, and what they are called now.
struct ObjectMapMerge {
  ObjectMap objects = {};
  std::map<ObjectId, ObjectId> id_of_added = {};  ///< All of the added map's.
  /// Of the first map's those that became part of another one; all else keep their ids.
  std::map<ObjectId, ObjectId> id_of_absorbed = {};
  std::size_t num_joined = 0;  ///< Of the added map's, those that were in the other map, too.
  std::size_t num_new = 0;     ///< And those that were not.
};

/// Associates the objects of a map with those of another as observations of a frame are with
/// objects: by the overlap of their points, boxes and classes, one to one, at the largest sum of
/// affinities. Two that are one are merged (`merged` of two objects), the others are added with new
/// ids; what two objects then claim goes to the one that more observations give it to.
///
/// What a pair became may show that it and a third object are one thing, of which one of the maps
/// saw parts: they are merged as after a frame, unless frames showed them beside each other. The
/// policy is ours (`AssociationPolicy::kAssignment`)
/// whatever the options say: the others need a frame or its sensor.
/// Frame: Map, the same for both. Requires: validate(options); ids of classes and detectors mean
/// the same in both, see `translated`.
/// Errors: kInvalidArgument, with the object as the entry, for one whose belief, histogram or votes
/// were made with other options than that which it shall be merged with has; those of
/// EmbeddingDimensions::add. Cost: as `associate`, a frame of as many observations.
[[nodiscard]] Result<ObjectMapMerge> merged(const ObjectMap& objects,
                                            const ObjectMap& added,
                                            const AssociationOptions& options);

}  // namespace hypermap
