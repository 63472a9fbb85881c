// SPDX-License-Identifier: BSD-3-Clause
#include "abandoned.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <string>
#include <vector>

namespace hypermap {
namespace {

/// The process of which a name with that prefix tells, or 0.
pid_t process_of(std::string_view name, std::string_view prefix) {
  if (!name.starts_with(prefix)) return 0;
  name.remove_prefix(prefix.size());
  pid_t process = 0;
  const char* end = std::from_chars(name.data(), name.data() + name.size(), process).ptr;
  name.remove_prefix(static_cast<std::size_t>(end - name.data()));
  const bool is_ours = name.empty() || (name.starts_with('-') && name.ends_with(".tmp"));
  return is_ours && process > 0 ? process : 0;
}

bool is_locked(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return true;
  const bool locked = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0;
  ::close(descriptor);
  return locked;
}

}  // namespace

void remove_abandoned(const std::filesystem::path& folder, std::string_view prefix) {
  std::vector<std::filesystem::path> abandoned;
  std::error_code ignored;
  std::filesystem::directory_iterator entry(folder, ignored);
  for (; !ignored && entry != std::filesystem::directory_iterator(); entry.increment(ignored)) {
    const pid_t process = process_of(entry->path().filename().string(), prefix);
    const bool is_dead = process > 0 && ::kill(process, 0) != 0 && errno == ESRCH;
    if (is_dead && !is_locked(entry->path())) abandoned.push_back(entry->path());
  }
  for (const auto& path : abandoned) std::filesystem::remove_all(path, ignored);
}

}  // namespace hypermap
