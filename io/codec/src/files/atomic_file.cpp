// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/atomic_file.hpp"

#include "abandoned.hpp"
#include "file_calls.hpp"
#include "system_error.hpp"

#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <optional>
#include <string>
#include <utility>

namespace hypermap {
namespace {

constexpr std::string_view kTemporaryPrefix = ".hypermap-save-";
constexpr int kMaxLinks = 40;  // as Linux follows them
constexpr int kMaxTemporaryNames = 1000;
constexpr std::size_t kMaxWriteBytes = std::size_t{1} << 30;  // one write() takes at most 2 GiB

/// The file that is replaced: what the path leads to, and what is known of it.
struct Target {
  std::filesystem::path path;
  std::optional<struct stat> status = std::nullopt;  ///< None when the file is new.

  [[nodiscard]] std::filesystem::path folder() const {
    return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  }
};

/// Follows symbolic links by hand, since the last one may point to a file that is not there yet.
Result<Target> find_target(const std::filesystem::path& path) {
  Target target{.path = path};
  for (int links = 0; links <= kMaxLinks; ++links) {
    struct stat status {};
    if (::lstat(target.path.c_str(), &status) != 0) {
      if (errno == ENOENT) return target;
      return system_error(path, "look at the file to replace", errno);
    }
    if (S_ISREG(status.st_mode)) {
      target.status = status;
      return target;
    }
    if (!S_ISLNK(status.st_mode))
      return tl::make_unexpected(Error{.code = ErrorCode::kIo,
                                       .what = "is not a regular file, nothing is written",
                                       .file = path.string()});
    std::error_code reason;
    target.path = target.folder() / std::filesystem::read_symlink(target.path, reason);
    if (reason) return system_error(path, "follow the link", reason.value());
  }
  return system_error(path, "follow the link", ELOOP);
}

/// A file that is closed and removed unless it was renamed. Locked, which marks it as alive.
struct Temporary {
  explicit Temporary(const FileCalls& file_calls) : calls(file_calls) {}
  ~Temporary() {
    if (descriptor >= 0) calls.close(descriptor);
    if (!path.empty()) ::unlink(path.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  /// False: errno says why.
  [[nodiscard]] bool create(const std::filesystem::path& folder, mode_t mode) {
    const std::string start = std::string(kTemporaryPrefix) + std::to_string(::getpid()) + "-";
    constexpr int kHow = O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW;
    for (int n = 0; n < kMaxTemporaryNames; ++n) {
      std::filesystem::path name = folder / (start + std::to_string(n) + ".tmp");
      descriptor = calls.open(name.c_str(), kHow, mode);
      if (descriptor >= 0) {
        path = std::move(name);
        ::flock(descriptor, LOCK_EX | LOCK_NB);
        return true;
      }
      if (errno != EINTR && errno != EEXIST) return false;
    }
    return false;
  }

  const FileCalls& calls;
  std::filesystem::path path = {};
  int descriptor = -1;
};

/// Returns 0, or errno. Without SIGXFSZ in this thread: a limit on file sizes is an EFBIG and kills
/// nobody.
int write_all(const FileCalls& calls, int descriptor, std::string_view bytes) {
  sigset_t signal{};
  sigset_t before{};
  sigemptyset(&signal);
  sigaddset(&signal, SIGXFSZ);
  pthread_sigmask(SIG_BLOCK, &signal, &before);
  int reason = 0;
  while (!bytes.empty() && reason == 0) {
    const auto done = calls.write(descriptor, bytes.data(), std::min(bytes.size(), kMaxWriteBytes));
    if (done > 0) bytes.remove_prefix(static_cast<std::size_t>(done));
    if (done <= 0 && !(done < 0 && errno == EINTR)) reason = done < 0 ? errno : ENOSPC;
  }
  const timespec no_time{};
  while (sigismember(&before, SIGXFSZ) == 0 && sigtimedwait(&signal, nullptr, &no_time) > 0) {
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return reason;
}

/// Errors name the target: who saves knows of no temporary.
Result<void> replace(const Target& target, std::string_view bytes, const FileCalls& calls) {
  const auto refused = [&](const char* action, int reason) {
    return system_error(target.path, action, reason);
  };
  Temporary temporary(calls);
  if (!temporary.create(target.folder(), target.status ? 0600 : 0666))
    return refused("create a temporary file beside it", errno);
  if (const int reason = write_all(calls, temporary.descriptor, bytes); reason != 0)
    return refused("write", reason);
  if (const auto& old = target.status) {
    // Without the right to give files away the new file is the saver's own, with the old mode.
    if (calls.fchown(temporary.descriptor, old->st_uid, old->st_gid) != 0 && errno != EPERM)
      return refused("set the owner", errno);
    if (calls.fchmod(temporary.descriptor, old->st_mode & 0777U) != 0)
      return refused("set the mode", errno);
  }
  if (calls.fsync(temporary.descriptor) != 0) return refused("sync", errno);
  // After close() the descriptor is gone whatever it returned; a second close could hit another.
  if (calls.close(std::exchange(temporary.descriptor, -1)) != 0 && errno != EINTR)
    return refused("close", errno);
  if (calls.rename(temporary.path.c_str(), target.path.c_str()) != 0)
    return refused("rename the temporary to it", errno);
  temporary.path.clear();
  return {};
}

Result<void> sync_folder(const Target& target, const FileCalls& calls) {
  const int folder = calls.open(target.folder().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC, 0);
  const bool synced = folder >= 0 && (calls.fsync(folder) == 0 || errno == EINVAL);  // no such sync
  const int reason = errno;
  if (folder >= 0) calls.close(folder);
  if (synced) return {};
  auto refused = system_error(target.path, "sync the folder", reason);
  refused.value().what.insert(0, "replaced, durability unconfirmed: ");
  return refused;
}

}  // namespace

Result<void> check_target(const std::filesystem::path& path) {
  return check_target(path, FileCalls{});
}

Result<void> check_target(const std::filesystem::path& path, const FileCalls& calls) {
  HYPERMAP_ASSIGN_OR_RETURN(const Target target, find_target(path));
  Temporary probe(calls);
  if (!probe.create(target.folder(), 0600))
    return system_error(path, "create a file in its folder", errno);
  if (const int reason = write_all(calls, probe.descriptor, "?"); reason != 0)
    return system_error(path, "write into its folder", reason);
  return {};
}

Result<void> write_file_atomically(const std::filesystem::path& path, std::string_view bytes) {
  return write_file_atomically(path, bytes, FileCalls{});
}

Result<void> write_file_atomically(const std::filesystem::path& path,
                                   std::string_view bytes,
                                   const FileCalls& calls) {
  HYPERMAP_ASSIGN_OR_RETURN(const Target target, find_target(path));
  remove_abandoned(target.folder(), kTemporaryPrefix);
  HYPERMAP_TRY(replace(target, bytes, calls));
  return sync_folder(target, calls);
}

}  // namespace hypermap
