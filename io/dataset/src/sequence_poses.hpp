// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which pose belongs to each frame of a dataset.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/dataset/dataset_description.hpp"
#include "sequence_index.hpp"

#include <filesystem>

namespace hypermap {

/// Gives each entry its pose or the file of it, or the reason why there is none; counts the poses
/// and notes what is odd. Errors: those of lists and trajectories.
[[nodiscard]] Result<void> attach_poses(const std::filesystem::path& folder,
                                        const DatasetDescription& description,
                                        SequenceIndex& index);

}  // namespace hypermap
