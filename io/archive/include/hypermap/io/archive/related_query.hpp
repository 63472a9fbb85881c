// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which objects are on, in, under, beside one of a class, or a part of it.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/places/relations.hpp"
#include "hypermap/io/archive/map_query.hpp"

#include <map>
#include <string>

namespace hypermap {

/// By kind: a class, in any spelling, or the id of a confirmed object.
using RelatedTo = std::map<RelationKind, std::string>;

/// The objects that fulfil the query and that are, for each kind, related to one that `related`
/// names. `graph` is that of the archive (`archive_relations`); the layer is that of the objects,
/// whatever `query.layer` says.
///
/// Boundary: an empty list is a normal answer.
/// Errors: those of query_map; kNotFound, naming the key of the kind ("part_of") as the field, when
/// there is no confirmed object of that class or with that id.
[[nodiscard]] Result<MapAnswers> query_related(const MapArchive& archive,
                                               const RelationGraph& graph,
                                               const RelatedTo& related,
                                               const MapQuery& query);

}  // namespace hypermap
