// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Temporaries that a crash left behind.
#pragma once

#include <filesystem>
#include <string_view>

namespace hypermap {

/// Removes what stands in `folder` as `<prefix><process>` or `<prefix><process>-<...>.tmp`, when
/// the process is dead and nobody holds an flock on it. Both are asked: a process of another
/// container has no number here, and the lock is taken a moment after the creation. What cannot be
/// removed stays.
void remove_abandoned(const std::filesystem::path& folder, std::string_view prefix);

}  // namespace hypermap
