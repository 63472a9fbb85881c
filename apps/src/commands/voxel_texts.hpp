// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What evaluations say of voxel labels, whatever they are held against.
#pragma once

#include "hypermap/core/evaluation/voxel_evaluation.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace hypermap::app {

/// The columns of a table of classes.
[[nodiscard]] std::vector<std::string> voxel_headings();
/// The row of a class, and that of all.
[[nodiscard]] std::vector<std::string> voxel_row(const std::string& name,
                                                 const ClassVoxelCounts& counts);
[[nodiscard]] std::vector<std::string> voxel_row(const VoxelLabelCounts& all);

/// The counts with what follows from them.
[[nodiscard]] nlohmann::ordered_json voxel_json(const ClassVoxelCounts& counts);
[[nodiscard]] nlohmann::ordered_json voxel_json(const VoxelLabelCounts& all);

}  // namespace hypermap::app
