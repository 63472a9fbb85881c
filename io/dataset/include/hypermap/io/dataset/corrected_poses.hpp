// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A recorded sequence with other poses: those that a loop closure found afterwards.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"

#include <filesystem>
#include <memory>

namespace hypermap {

/// The same frames, posed by a trajectory file in the dataset's world: lines of TUM's form, each
/// for the frame whose stamp is nearest within the dataset's tolerance, or Open3D's log (`.log`),
/// by the frame's index. A frame without a pose cannot be read (kNotFound); one whose own pose is
/// missing cannot either.
///
/// Errors: those of read_tum_trajectory and read_log_trajectory. Their findings are appended to the
/// summary's. Requires: `dataset` is not null, and not turned yet (set_map_from_input).
[[nodiscard]] Result<std::unique_ptr<DatasetReader>> with_corrected_poses(
    std::unique_ptr<DatasetReader> dataset, const std::filesystem::path& poses);

}  // namespace hypermap
