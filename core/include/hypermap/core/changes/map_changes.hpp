// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What changed in a place between two maps of it.
///
/// Ours: [smap] figure 3.24 tells absent objects from hidden ones in a frame; this does so of maps,
/// by what each knows of the space where the other has an object. Not having an object is no
/// evidence that it is gone: the other map may never have looked there.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/geometry/frames.hpp"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

struct OptionTable;

/// What a map knows of a point.
enum class SpaceState : std::uint8_t { kUnknown, kFree, kOccupied };
using SpaceQuery = std::function<SpaceState(const PointInMap&)>;

/// An object of one of the maps. Frame: Map, the same for both.
struct ObjectInPlace {
  ObjectId id = {};
  std::string class_name = {};  ///< Equal names are equal classes.
  Box box = {};
  Eigen::Vector3d centroid_in_map = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> points_in_map = {};  ///< Of its surface; empty: its box's.
  /// False in a map that goes on from the other one and did not look at the object since.
  bool was_looked_at = true;
  /// The other map goes on from this one, and saw itself that the object is not there any more.
  bool was_seen_gone = false;
};

/// Requires: objects have ids of their own; `space` may be called until the comparison ends.
struct MapOfPlace {
  std::vector<ObjectInPlace> objects = {};
  SpaceQuery space = {};
};

enum class ChangeKind : std::uint8_t {
  kSame,         ///< In both, where it was.
  kMoved,        ///< From a place that is free now to one that was free.
  kReclassed,    ///< In both, where it was, by another class.
  kGone,         ///< Its place was looked at and is free.
  kNotFound,     ///< Its place was looked at and is filled; nothing there has a name.
  kNotLookedAt,  ///< Most of its place is unknown to the later map.
  kAdded,        ///< Where it is was free.
  kNewlyNamed,   ///< Where it is was filled; nothing there had a name.
  kFirstSeen,    ///< Most of where it is was unknown to the earlier map.
};

inline constexpr std::array<ChangeKind, 9> kChangeKinds{ChangeKind::kMoved,
                                                        ChangeKind::kReclassed,
                                                        ChangeKind::kGone,
                                                        ChangeKind::kAdded,
                                                        ChangeKind::kNotFound,
                                                        ChangeKind::kNewlyNamed,
                                                        ChangeKind::kNotLookedAt,
                                                        ChangeKind::kFirstSeen,
                                                        ChangeKind::kSame};
/// "same", "moved", "re-classed", "gone", "not found", "not looked at", "added", "newly named",
/// "first seen".
[[nodiscard]] std::string_view name_of(ChangeKind kind) noexcept;
/// The same as a key of JSON: "not_looked_at".
[[nodiscard]] std::string_view key_of(ChangeKind kind) noexcept;
/// Whether something in the place changed, not only what is known of it: moved, re-classed, gone,
/// added.
[[nodiscard]] bool is_change(ChangeKind kind) noexcept;

/// Shares of an object's points in what the other map knows; they sum to 1.
struct SpaceShares {
  double free = 0.0;
  double occupied = 0.0;
  double unknown = 0.0;
  friend bool operator==(const SpaceShares&, const SpaceShares&) = default;
};

/// One object of a map, or a pair of both maps, and what became of it.
struct ObjectChange {
  ChangeKind kind = ChangeKind::kSame;
  std::optional<ObjectId> before = {};
  std::optional<ObjectId> after = {};
  std::optional<double> distance_m = {};      ///< Of a pair: between the centroids.
  std::optional<SpaceShares> old_place = {};  ///< Of `before`, in the later map.
  std::optional<SpaceShares> new_place = {};  ///< Of `after`, in the earlier map.
  friend bool operator==(const ObjectChange&, const ObjectChange&) = default;
};

struct ChangeOptions {
  /// Objects of a class whose centroids are nearer than this, or than half of the larger one's
  /// longest horizontal side, may be one that stayed.
  double same_place_m = 0.25;
  double min_overlap_share = 0.3;  ///< Of boxes, over their union: one thing under two classes.
  double min_known_share = 0.5;    ///< Less of the points is known: not looked at.
  double min_free_share = 0.5;     ///< At least so much of the known points is free: nothing there.
  double max_move_m = 5.0;         ///< Farther: one is gone, another one was added.
  double min_size_ratio = 0.5;     ///< Of the boxes' diagonals of a thing that moved.
  friend bool operator==(const ChangeOptions&, const ChangeOptions&) = default;
};
/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const ChangeOptions& options);
[[nodiscard]] const OptionTable& option_table(const ChangeOptions& options);

/// Every object of both maps, once: by kind in the order of `kChangeKinds`, then by the ids of
/// `before` and `after`.
///
/// Objects of a class are paired in place at the least sum of distances. A pair whose old place is
/// free and whose new place was not filled has moved. Of what is left, boxes of two classes that
/// overlap are one thing, unless its old place is free; the others are judged by the space that the
/// other map knows there; what is gone and what was added, of one class and about one size, moved.
/// Boundary: at most 1,024 points of an object are asked for, spread evenly. What is in place and
/// whose surface is free in the earlier map, too, as that of glass, has not moved.
/// Requires: validate(options). Cost: a question for each such point, a look at each pair of
/// objects, and that of `assign` for those that are near each other.
[[nodiscard]] std::vector<ObjectChange> find_changes(const MapOfPlace& before,
                                                     const MapOfPlace& after,
                                                     const ChangeOptions& options = {});

}  // namespace hypermap
