// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Temporaries of saves: their names, and the removal of those that a crash left behind.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace hypermap {

/// `.hypermap-save-<process>-<n>.tmp`. The saver also holds an flock on it while it writes.
[[nodiscard]] std::string temporary_name(pid_t process, int n);

/// Removes temporaries whose process is dead and whose lock nobody holds. Both are asked, since a
/// process of another container has no number here and the lock is taken a moment after the
/// creation. What cannot be removed stays: the save itself will say what is wrong with the folder.
void remove_stale_temporaries(const std::filesystem::path& folder);

}  // namespace hypermap
