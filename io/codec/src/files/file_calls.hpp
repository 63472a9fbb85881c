// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The system calls of a save, for tests to let any one of them fail.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <string_view>

namespace hypermap {

/// Each behaves as its namesake: a negative result, errno set.
struct FileCalls {
  std::function<int(const char*, int, mode_t)> open = ::open;
  std::function<ssize_t(int, const void*, std::size_t)> write = ::write;
  std::function<int(int, mode_t)> fchmod = ::fchmod;
  std::function<int(int, uid_t, gid_t)> fchown = ::fchown;
  std::function<int(int)> fsync = ::fsync;
  std::function<int(int)> close = ::close;
  std::function<int(const char*, const char*)> rename = ::rename;
};

[[nodiscard]] Result<void> check_target(const std::filesystem::path& path, const FileCalls& calls);
[[nodiscard]] Result<void> write_file_atomically(const std::filesystem::path& path,
                                                 std::string_view bytes,
                                                 const FileCalls& calls);

}  // namespace hypermap
