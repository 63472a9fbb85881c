// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How much of an object's outline was seen, and a guess of how large it is where that is little.
///
/// Ours. A chair that is tucked under a table shows its back alone: what is mapped is a slab. The
/// share says so, the guess says what such an object usually is. A guess is no evidence: nothing in
/// the map changes by it, and `evaluation` may not include this room.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/core/objects/object_map.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>

namespace hypermap {

/// From this share on an object counts as seen whole. Three sides of a rectangle that is at most
/// twice as long as wide have it, whichever the fourth is; two sides of a corner never do.
inline constexpr double kWholeSeenShare = 2.0 / 3.0;

/// The share of an object's outline from above that some detection faced: of the length of its
/// footprint's edges, or of the sides of its box where it has no footprint. An edge was faced when
/// the middle of a bearing bin with a detection lies within 60 degrees of its outward normal;
/// beyond that a surface shows itself too narrowly for depth to measure it.
///
/// Scope: the outline is that of what was seen. What something else hid (the seat below the table)
/// lies outside it and is not missed by the share, and a faced edge may have been hidden in part.
/// Nor does it tell about top and bottom.
/// Boundary: 0 without recorded detections, 1 when there are some from all around; a further
/// detection never lowers it while the outline stays.
/// Cost: that of `footprint`, and its edges times the bins.
[[nodiscard]] double seen_share(const Object& object);

/// How large objects of a class are. Unit: metre.
struct UsualSize {
  double longer_m = 0.0;   ///< Sides of the least rectangle around the footprint, so that turned
  double shorter_m = 0.0;  ///< objects count as others do.
  double height_m = 0.0;
  std::size_t num_objects = 0;  ///< That were seen whole.
  friend bool operator==(const UsualSize&, const UsualSize&) = default;
};

/// What a map itself says of the sizes of its classes.
struct UsualSizes {
  std::map<ClassId, UsualSize> of_class;
  double lowest_m = 0.0;  ///< The lowest bottom of an object: below it nothing is guessed.
  friend bool operator==(const UsualSizes&, const UsualSizes&) = default;
};

/// Medians of the `confirmed` objects that were seen whole, by their best class; of an even number
/// the mean of the middle two. A class that fewer than two of them have is not among them.
///
/// Requires: `confirmed` are ids of `objects`. Boundary: none of them, no sizes, lowest_m is 0.
[[nodiscard]] UsualSizes usual_sizes(const ObjectMap& objects, std::span<const ObjectId> confirmed);

/// Whether the map knows that the space at a point is free; false where it knows nothing.
using KnownFree = std::function<bool(const PointInMap&)>;

/// A guess of an object's true box: what was seen of it, and what its class usually has besides.
///
/// None when the object was seen whole, when its class has no usual size, and when nothing grows.
/// Along each side of its rectangle, and upwards, it lacks what the usual size has more, if that is
/// 5 cm or more, and of a side a third of it; of a longer seen side the usual one is that which is
/// nearer to it. What it lacks is added at one of the two ends and the other one stays: not where
/// more than 0.6 of the added part is known to be free, there the object would have been seen; else
/// where clearly less (by 0.1) is; else at the end that no detection faced, the bottom rather than
/// the top. Where that leaves both ends, that side is not guessed. Nothing is ever taken away, and
/// nothing added below `usual.lowest_m`.
///
/// Boundary: without knowledge of free space (`is_free` always false) faces that nobody faced move
/// away from the viewers. Cost: at most 48,000 calls of `is_free`, and a footprint.
[[nodiscard]] std::optional<Box> completed_box(const Object& object,
                                               const UsualSizes& usual,
                                               const KnownFree& is_free);

}  // namespace hypermap
