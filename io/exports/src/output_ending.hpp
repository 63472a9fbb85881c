// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How the names of outputs end.
#pragma once

#include "hypermap/io/exports/map_export.hpp"

#include <string_view>

namespace hypermap {

/// Whether the name of the output ends as files of its format do; `.ply`, `.glb` and `.gpkg` may be
/// left out. Formats that write folders, maps of map_server or tiles take any name.
/// Errors: kInvalidArgument, field "--output".
[[nodiscard]] Result<void> check_ending(const ExportRequest& request);

/// Whether the output's name ends so, in upper or lower case.
[[nodiscard]] bool has_ending(const ExportRequest& request, std::string_view ending);

}  // namespace hypermap
