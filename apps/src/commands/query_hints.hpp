// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What `query` says on stderr where it found nothing.
#pragma once

#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/map_query.hpp"
#include "query_arguments.hpp"

#include <optional>
#include <string>

namespace hypermap::app {

/// That the text may be misspelt, when nothing of the map has a name that it asks for. The states
/// of space are no names of objects. Requires: query.text.
[[nodiscard]] std::optional<std::string> name_hint(const MapArchive& archive,
                                                   const MapQuery& query);

/// Says it; whether there was anything to say. Requires: query.text.
bool print_hint(const MapArchive& archive, const MapQuery& query);

/// Nothing is related as it was asked.
void print_no_relation(const QueryArguments& arguments);

/// From when to when the map's frames are.
void print_times_hint(const MapArchive& archive, const AskedTime& asked);

}  // namespace hypermap::app
