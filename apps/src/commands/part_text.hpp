// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What commands say of parts of a map.
#pragma once

#include "command.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace hypermap::app {

/// Occupied and free ones.
[[nodiscard]] std::size_t num_voxels(const MapArchive& archive);

/// Says on stderr what could not be divided. Returns kFindings when there is any, else kDone.
ExitCode warn_of_left_out(const std::string& command, const std::vector<std::string>& names);

}  // namespace hypermap::app
