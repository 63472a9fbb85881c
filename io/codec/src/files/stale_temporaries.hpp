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

/// Whether the process is dead and nobody holds the lock of its temporary. Both are asked, since a
/// process of another container has no number here and the lock is taken a moment after the
/// creation.
[[nodiscard]] bool is_abandoned(pid_t process, const std::filesystem::path& path);

/// Removes abandoned temporaries. What cannot be removed stays: the save itself will say what is
/// wrong with the folder.
void remove_stale_temporaries(const std::filesystem::path& folder);

}  // namespace hypermap
