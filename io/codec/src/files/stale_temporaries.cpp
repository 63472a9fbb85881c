// SPDX-License-Identifier: BSD-3-Clause
#include "stale_temporaries.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <optional>
#include <string_view>

namespace hypermap {
namespace {

constexpr std::string_view kPrefix = ".hypermap-save-";
constexpr std::string_view kSuffix = ".tmp";

std::optional<pid_t> process_of(std::string_view name) {
  if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) return std::nullopt;
  name.remove_prefix(kPrefix.size());
  pid_t process = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), process);
  if (error != std::errc() || process <= 0 || end == name.data() + name.size() || *end != '-')
    return std::nullopt;
  return process;
}

bool is_locked(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return true;
  const bool locked = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0;
  ::close(descriptor);
  return locked;
}

}  // namespace

bool is_abandoned(pid_t process, const std::filesystem::path& path) {
  return ::kill(process, 0) != 0 && errno == ESRCH && !is_locked(path);
}

std::string temporary_name(pid_t process, int n) {
  return std::string(kPrefix) + std::to_string(process) + "-" + std::to_string(n) +
         std::string(kSuffix);
}

void remove_stale_temporaries(const std::filesystem::path& folder) {
  std::error_code ignored;
  std::filesystem::directory_iterator entry(folder, ignored);
  for (; !ignored && entry != std::filesystem::directory_iterator(); entry.increment(ignored)) {
    const auto process = process_of(entry->path().filename().string());
    if (process && is_abandoned(*process, entry->path())) ::unlink(entry->path().c_str());
  }
}

}  // namespace hypermap
