// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What `map-many` says of its sequences and their map.
#pragma once

#include "hypermap/io/jobs/map_many_job.hpp"

namespace hypermap::app {

/// To standard output: a line for each sequence, then the merged map.
void print_map_many(const MapManyReport& report, const MapManyJob& job);
/// The same as one JSON document.
void print_map_many_json(const MapManyReport& report, const MapManyJob& job);

}  // namespace hypermap::app
