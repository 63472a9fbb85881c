// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which objects are on, in, under, beside one of a class, or a part of it.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/places/relations.hpp"
#include "hypermap/io/archive/map_query.hpp"

#include <map>
#include <string>
#include <string_view>

namespace hypermap {

/// In any spelling, of kOn: what rests on the floor (SupportKind::kFloor), which is no object.
inline constexpr std::string_view kFloorName = "floor";

/// By kind: a class, in any spelling, or the id of a confirmed object; of kOn also `kFloorName`.
using RelatedTo = std::map<RelationKind, std::string>;

/// The objects that fulfil the query and that are, for each kind, related to one that `related`
/// names. `graph` is that of the archive (`archive_relations`); the layer is that of the objects,
/// whatever `query.layer` says.
///
/// Boundary: an empty list is a normal answer.
/// Errors: those of query_map; kNotFound, naming the key of the kind ("part_of") as the field, when
/// there is no confirmed object of that class, which names those that there are, or with that id;
/// when the map has no confirmed object at all, as one of 2D layers alone.
[[nodiscard]] Result<MapAnswers> query_related(const MapArchive& archive,
                                               const RelationGraph& graph,
                                               const RelatedTo& related,
                                               const MapQuery& query);

}  // namespace hypermap
