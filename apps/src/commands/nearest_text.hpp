// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What `query --nearest --free-space` says.
#pragma once

#include "hypermap/io/archive/nearest_routes.hpp"

namespace hypermap::app {

/// To standard output: the objects and the ways to them, as a table and a line for each, or as one
/// JSON document. `options` are those that the ways were found by.
void print_nearest_routes(const ReachedObjects& reached, const ApproachOptions& options, bool json);

}  // namespace hypermap::app
