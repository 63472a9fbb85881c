// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What `query` says on stderr where it found nothing.
#pragma once

#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/map_query.hpp"
#include "query_arguments.hpp"

namespace hypermap::app {

/// Says, when nothing of the map has a name that the text asks for, that it may be misspelt;
/// whether it did. The states of space are no names of objects. Requires: query.text.
bool print_hint(const MapArchive& archive, const MapQuery& query);

/// Nothing is related as it was asked.
void print_no_relation(const QueryArguments& arguments);

/// From when to when the map's frames are.
void print_times_hint(const MapArchive& archive, const AskedTime& asked);

}  // namespace hypermap::app
