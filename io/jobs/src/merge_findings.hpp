// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the runs of maps tell that does not keep them from being merged.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/provenance.hpp"
#include "hypermap/io/options/options_file.hpp"

#include <filesystem>
#include <optional>
#include <span>

namespace hypermap {

/// That the newest run associated by other rules than `options`: the first such option, with both
/// values. None where the run does not say.
[[nodiscard]] std::optional<Finding> other_association(std::span<const Provenance> runs,
                                                       const MapOptions& options);

/// That runs of this map and of the one at `other` may be of one recording, whose frames would
/// count twice: inputs of one name and of other hashes, whose times overlap.
[[nodiscard]] std::optional<Finding> shared_recording(std::span<const Provenance> runs,
                                                      std::span<const Provenance> runs_of_other,
                                                      const std::filesystem::path& other);

}  // namespace hypermap
