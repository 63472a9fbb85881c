// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What stands on, in, under and beside what, and what is a part of what.
///
/// Ours: [smap] 3.5.1 relates objects to places alone. Derived from what objects were seen to be
/// (points, footprints, boxes), never stored, so that it is never older than the map.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/core/places/relation_options.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {

/// "subject is on object".
enum class RelationKind : std::uint8_t { kOn, kIn, kUnder, kBeside, kPartOf };

inline constexpr std::array<RelationKind, 5> kRelationKinds{RelationKind::kOn,
                                                            RelationKind::kIn,
                                                            RelationKind::kUnder,
                                                            RelationKind::kBeside,
                                                            RelationKind::kPartOf};
/// "on", "in", "under", "beside", "part of".
[[nodiscard]] std::string_view name_of(RelationKind kind) noexcept;
/// The same as a key of JSON: "part_of".
[[nodiscard]] std::string_view key_of(RelationKind kind) noexcept;

/// By what a relation was measured.
enum class RelationSource : std::uint8_t {
  kPoints,  ///< The points of both.
  kBoxes,   ///< Boxes, where one has no points there: the top of a box stands for its surface.
};

/// The numbers that a relation was decided by; absent where they mean nothing.
struct RelationEvidence {
  /// Of the subject's footprint: on, in, part of: over the object's; under: below its underside.
  std::optional<double> plan_share = std::nullopt;
  /// On: foot above the surface, negative below it. Under: free height. Beside: between footprints.
  std::optional<double> gap_m = std::nullopt;
  std::optional<double> contact_height_m = std::nullopt;  ///< On: of the surface, in the map.
  std::optional<double> inside_share = std::nullopt;      ///< In, part of: of the volume.
  /// On: of the surface around the foot, at its height. Part of: of the part's surface.
  std::optional<double> contact_share = std::nullopt;
  RelationSource source = RelationSource::kPoints;
  friend bool operator==(const RelationEvidence&, const RelationEvidence&) = default;
};

/// The numbers that there are, by their names ("gap_m"), in the order of the struct.
[[nodiscard]] std::vector<std::pair<std::string_view, double>> measures_of(
    const RelationEvidence& evidence);
/// "points", "boxes".
[[nodiscard]] std::string_view name_of(RelationSource source) noexcept;

struct Relation {
  RelationKind kind = RelationKind::kOn;
  ObjectId subject;
  ObjectId object;  ///< Beside is symmetric and stands once: subject < object.
  RelationEvidence evidence;
  friend bool operator==(const Relation&, const Relation&) = default;
};

/// What an object rests on.
enum class SupportKind : std::uint8_t {
  kObject,   ///< It is on another one.
  kHolder,   ///< It is in another one.
  kWhole,    ///< It is a part of another one.
  kFloor,    ///< Its foot is at the height of the floor.
  kUnknown,  ///< No object is below its foot: what is below has no class, or it hangs.
};

/// "object", "holder", "whole", "floor", "unknown".
[[nodiscard]] std::string_view name_of(SupportKind kind) noexcept;

struct ObjectSupport {
  ObjectId id;
  SupportKind kind = SupportKind::kUnknown;
  ObjectId by = kNoObject;  ///< Of kObject, kHolder, kWhole.
  friend bool operator==(const ObjectSupport&, const ObjectSupport&) = default;
};

/// Relations and supports of some objects. A value.
///
/// An object is on, in, under, and part of, at most one other; beside at most `max_beside` others.
/// Supports are a forest: nobody supports himself, over others either.
struct RelationGraph {
  std::vector<Relation> relations;      ///< Ascending by kind, subject, object.
  std::vector<ObjectSupport> supports;  ///< Of all objects, ascending by id.
  friend bool operator==(const RelationGraph&, const RelationGraph&) = default;
};

/// The relations of the objects `among`, each decided by its own rule:
///
/// * part of: the class pair is declared, the part lies in the whole (upright prisms over
///   footprints) and its surface is on that of the whole. A part has no other carrier.
/// * in: the class of the larger one holds; the smaller lies in it, up to the height that a tenth
///   of the holder's surface reaches. Of several holders the smallest.
/// * on: the foot is at the height of the other's top surface around it, seat and not back, and the
///   footprint over it. What others hide of the surface is not needed. Of several the highest. What
///   is in a holder can be on what is in it too.
/// * under: most of the plan lies below the other's underside, with free height between. Of several
///   the lowest.
/// * beside: footprints near each other by the smaller one's size, feet on one level, held by the
///   same, and none of the above. Kept where each is among the other's nearest.
///
/// The result does not depend on the order of `among`; ids in it twice count once.
/// Frame: Map, +z up. Requires: validate(options); `among` are ids of `objects`.
/// Boundary: objects without points are their boxes. A share of exactly the least one counts.
/// Cost: linear in the points, and a comparison for each pair whose boxes are near (R-tree).
[[nodiscard]] RelationGraph find_relations(const ObjectMap& objects,
                                           const ClassRegistry& classes,
                                           std::span<const ObjectId> among,
                                           const RelationOptions& options = {});

/// The relations that `id` has as a subject, beside from both sides, in the order of the graph.
[[nodiscard]] std::vector<Relation> relations_of(const RelationGraph& graph, ObjectId id);
/// The objects that are `kind` to `object` ("what is on it"), ascending.
[[nodiscard]] std::vector<ObjectId> subjects_of(const RelationGraph& graph,
                                                RelationKind kind,
                                                ObjectId object);
/// None when the graph does not know the object. Cost: O(log n).
[[nodiscard]] std::optional<ObjectSupport> support_of(const RelationGraph& graph, ObjectId id);

}  // namespace hypermap
