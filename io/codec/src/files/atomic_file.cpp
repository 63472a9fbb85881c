// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/atomic_file.hpp"

#include "stale_temporaries.hpp"
#include "system_error.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <optional>
#include <string>
#include <utility>

namespace hypermap {

int FileCalls::open(const char* path, int flags, mode_t mode) {
  return ::open(path, flags, mode);
}
ssize_t FileCalls::write(int descriptor, const char* bytes, std::size_t num_bytes) {
  return ::write(descriptor, bytes, num_bytes);
}
int FileCalls::fchmod(int descriptor, mode_t mode) {
  return ::fchmod(descriptor, mode);
}
int FileCalls::fchown(int descriptor, uid_t owner, gid_t group) {
  return ::fchown(descriptor, owner, group);
}
int FileCalls::fsync(int descriptor) {
  return ::fsync(descriptor);
}
int FileCalls::close(int descriptor) {
  return ::close(descriptor);
}
int FileCalls::rename(const char* from, const char* to) {
  return ::rename(from, to);
}
int FileCalls::unlink(const char* path) {
  return ::unlink(path);
}

namespace {

constexpr int kMaxLinks = 40;  // as Linux follows them
constexpr int kMaxTemporaryNames = 1000;
constexpr std::size_t kMaxWriteBytes = std::size_t{1} << 30;  // one write() takes at most 2 GiB

/// Holds back SIGXFSZ in this thread, so that a limit on file sizes is an EFBIG and kills nobody.
class FileSizeSignalHold {
 public:
  FileSizeSignalHold() {
    sigemptyset(&signal_);
    sigaddset(&signal_, SIGXFSZ);
    pthread_sigmask(SIG_BLOCK, &signal_, &before_);
  }
  ~FileSizeSignalHold() {
    if (sigismember(&before_, SIGXFSZ) == 0) {
      const timespec no_time{};
      while (sigtimedwait(&signal_, nullptr, &no_time) > 0) {
      }
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  FileSizeSignalHold(const FileSizeSignalHold&) = delete;
  FileSizeSignalHold& operator=(const FileSizeSignalHold&) = delete;
  FileSizeSignalHold(FileSizeSignalHold&&) = delete;
  FileSizeSignalHold& operator=(FileSizeSignalHold&&) = delete;

 private:
  sigset_t signal_{};
  sigset_t before_{};
};

/// The file that is replaced: what the path leads to, and what is known of it.
struct Target {
  std::filesystem::path path;
  std::optional<struct stat> status;  // none when the file is new

  [[nodiscard]] std::filesystem::path folder() const {
    return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  }
};

/// Follows symbolic links by hand, since the last one may point to a file that is not there yet.
Result<Target> find_target(const std::filesystem::path& path) {
  Target target{.path = path, .status = std::nullopt};
  for (int links = 0; links <= kMaxLinks; ++links) {
    struct stat status {};
    if (::lstat(target.path.c_str(), &status) != 0) {
      if (errno == ENOENT) return target;
      return tl::make_unexpected(system_error(path, "look at the file to replace", errno));
    }
    if (S_ISLNK(status.st_mode)) {
      std::error_code reason;
      const auto next = std::filesystem::read_symlink(target.path, reason);
      if (reason) return tl::make_unexpected(system_error(path, "follow the link", reason.value()));
      target.path = next.is_absolute() ? next : target.folder() / next;
      continue;
    }
    if (!S_ISREG(status.st_mode))
      return tl::make_unexpected(Error{.code = ErrorCode::kIo,
                                       .what = "is not a regular file, nothing is written",
                                       .file = path.string()});
    target.status = status;
    return target;
  }
  return tl::make_unexpected(system_error(path, "follow the link", ELOOP));
}

/// A temporary file that is closed and removed unless it was renamed.
class Temporary {
 public:
  Temporary(FileCalls& calls, const Target& target) : calls_(calls), target_(target) {}
  ~Temporary() {
    if (descriptor_ >= 0) calls_.close(descriptor_);
    if (!path_.empty()) calls_.unlink(path_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  Temporary(Temporary&&) = delete;
  Temporary& operator=(Temporary&&) = delete;

  Result<void> create() {
    const mode_t mode = target_.status ? 0600 : 0666;
    for (int n = 0; n < kMaxTemporaryNames; ++n) {
      const auto path = target_.folder() / temporary_name(::getpid(), n);
      descriptor_ =
          calls_.open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, mode);
      if (descriptor_ >= 0) {
        path_ = path;
        ::flock(descriptor_, LOCK_EX | LOCK_NB);  // marks it as alive; see stale_temporaries.hpp
        return {};
      }
      if (errno == EINTR) continue;
      if (errno != EEXIST) return refused("create a temporary file beside it", errno);
    }
    return refused("create a temporary file beside it", EEXIST);
  }

  Result<void> write(std::string_view bytes) {
    const FileSizeSignalHold hold;
    while (!bytes.empty()) {
      const ssize_t done =
          calls_.write(descriptor_, bytes.data(), std::min(bytes.size(), kMaxWriteBytes));
      if (done < 0 && errno == EINTR) continue;
      if (done < 0) return refused("write", errno);
      if (done == 0) return refused("write", ENOSPC);
      bytes.remove_prefix(static_cast<std::size_t>(done));
    }
    return {};
  }

  /// Without the right to give files away the new file is the saver's own, with the old mode.
  Result<void> take_mode_and_owner() {
    if (!target_.status) return {};
    const struct stat& old = *target_.status;
    if (calls_.fchown(descriptor_, old.st_uid, old.st_gid) != 0 && errno != EPERM)
      return refused("set the owner", errno);
    if (calls_.fchmod(descriptor_, old.st_mode & 0777U) != 0) return refused("set the mode", errno);
    return {};
  }

  Result<void> sync_and_close() {
    if (calls_.fsync(descriptor_) != 0) return refused("sync", errno);
    // After close() the descriptor is gone whatever it returned; a second close could hit another.
    if (calls_.close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR)
      return refused("close", errno);
    return {};
  }

  Result<void> rename() {
    if (calls_.rename(path_.c_str(), target_.path.c_str()) != 0)
      return refused("rename the temporary " + path_.filename().string() + " to it", errno);
    path_.clear();
    return {};
  }

 private:
  /// Names the target: who saves knows of no temporary.
  [[nodiscard]] Unexpected refused(const std::string& action, int reason) const {
    return tl::make_unexpected(system_error(target_.path, action, reason));
  }

  FileCalls& calls_;
  const Target& target_;
  std::filesystem::path path_;
  int descriptor_ = -1;
};

Result<void> sync_folder(const Target& target, FileCalls& calls) {
  const auto unconfirmed = [&](int reason) {
    Error error = system_error(target.path, "sync the folder", reason);
    error.what = "replaced, durability unconfirmed: " + error.what;
    return tl::make_unexpected(std::move(error));
  };
  const int folder = calls.open(target.folder().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC, 0);
  if (folder < 0) return unconfirmed(errno);
  const bool synced = calls.fsync(folder) == 0 || errno == EINVAL;  // EINVAL: folders have no sync
  const int reason = errno;
  calls.close(folder);
  if (!synced) return unconfirmed(reason);
  return {};
}

}  // namespace

Result<void> check_target(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const Target target, find_target(path));
  const auto folder = target.folder();
  std::error_code failed;
  if (!std::filesystem::is_directory(folder, failed)) {
    const int reason = failed ? failed.value() : ENOTDIR;
    return tl::make_unexpected(system_error(path, "write into its folder", reason));
  }
  if (::access(folder.c_str(), W_OK) != 0) {
    return tl::make_unexpected(system_error(path, "write into its folder", errno));
  }
  return {};
}

Result<void> write_file_atomically(const std::filesystem::path& path, std::string_view bytes) {
  FileCalls calls;
  return write_file_atomically(path, bytes, calls);
}

Result<void> write_file_atomically(const std::filesystem::path& path,
                                   std::string_view bytes,
                                   FileCalls& calls) {
  HYPERMAP_ASSIGN_OR_RETURN(const Target target, find_target(path));
  remove_stale_temporaries(target.folder());
  Temporary temporary(calls, target);
  HYPERMAP_TRY(temporary.create());
  HYPERMAP_TRY(temporary.write(bytes));
  HYPERMAP_TRY(temporary.take_mode_and_owner());
  HYPERMAP_TRY(temporary.sync_and_close());
  HYPERMAP_TRY(temporary.rename());
  return sync_folder(target, calls);
}

}  // namespace hypermap
