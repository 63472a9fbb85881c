// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the replacements of a file and of a folder share. Where a call says so, errno tells why.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <sys/types.h>

#include <filesystem>
#include <string_view>

namespace hypermap {

/// Closes itself; -1 and errno when it cannot be opened.
struct Descriptor {
  Descriptor(const std::filesystem::path& path, int how, mode_t mode = 0);
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int close();  ///< As its namesake; a second time it does nothing.

  int number;
};

/// A hidden folder in which the new content grows; it goes with all that is in it. Its lock alone
/// says that it is in use: process numbers repeat, and are others in another container.
struct TemporaryFolder {
  /// In `parent`, where those that nobody holds are removed first. No path and errno: not made.
  explicit TemporaryFolder(const std::filesystem::path& parent);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path path = {};
  int lock = -1;
};

/// Where symbolic links lead to, also when nothing is there yet.
[[nodiscard]] std::filesystem::path follow_links(std::filesystem::path path);
[[nodiscard]] std::filesystem::path parent_of(const std::filesystem::path& path);

/// False and errno. A limit on file sizes is EFBIG and no signal. Requires: an empty file.
[[nodiscard]] bool write_all(int descriptor, std::string_view bytes);

/// To be called after the rename. Errors: kIo or kOutOfMemory, "replaced, durability
/// unconfirmed".
[[nodiscard]] Result<void> sync_parent(const std::filesystem::path& target);

}  // namespace hypermap
