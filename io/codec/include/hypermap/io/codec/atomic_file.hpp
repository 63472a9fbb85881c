// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Replaces a file so that its name always stands for the whole old or the whole new content.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <filesystem>
#include <string_view>

namespace hypermap {

/// Whether a file could be replaced or made at `path`, to be asked before long work: a file of one
/// byte is made beside it and removed again.
/// Errors: kIo when its folder is not there or takes no file or no byte (a full disk), when its
/// name is too long, or when it is no regular file.
[[nodiscard]] Result<void> check_target(const std::filesystem::path& path);

/// Writes `bytes` beside the target, syncs, renames over the target and syncs the folder.
///
/// A symbolic link is followed and stays. Mode, and owner as far as the system allows, are those of
/// the file that is replaced. What dead processes left in the folder is removed first. Of two
/// savers to one path the last one wins, whole.
/// Errors: kIo naming path and errno. Then the old file is as it was and nothing is left beside it,
/// unless the message says "replaced, durability unconfirmed": when only the last sync fails. kIo
/// also when the target is no regular file (a device, a folder).
/// Threads: any number at once; a limit on file sizes (RLIMIT_FSIZE) gives an error, no signal.
[[nodiscard]] Result<void> write_file_atomically(const std::filesystem::path& path,
                                                 std::string_view bytes);

}  // namespace hypermap
