// SPDX-License-Identifier: BSD-3-Clause
#include "replacement.hpp"

#include "system_error.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <new>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = ".hypermap-save-";
constexpr std::string_view kPattern = ".hypermap-save-XXXXXX";
constexpr int kMaxLinks = 40;  // as Linux follows them

int open_uninterrupted(const fs::path& path, int how, mode_t mode) {
  int number = -1;
  do {
    number = ::open(path.c_str(), how | O_CLOEXEC, mode);
  } while (number < 0 && errno == EINTR);
  return number;
}

/// Of this version, or a file of an earlier one.
bool is_temporary(std::string_view name) {
  return name.starts_with(kPrefix) && (name.size() == kPattern.size() || name.ends_with(".tmp"));
}

struct CloseFolder {
  void operator()(DIR* folder) const { ::closedir(folder); }
};

/// No name is used twice: what is locked here is what the name stands for. Not by
/// std::filesystem::directory_iterator, which ends the program where memory ends (libstdc++ 12).
void remove_abandoned(const fs::path& parent) {
  const std::unique_ptr<DIR, CloseFolder> folder(::opendir(parent.empty() ? "." : parent.c_str()));
  if (!folder) return;
  // NOLINTNEXTLINE(concurrency-mt-unsafe): of a folder that nobody else reads
  while (const dirent* entry = ::readdir(folder.get())) {
    if (!is_temporary(static_cast<const char*>(entry->d_name))) continue;
    const fs::path path = parent / static_cast<const char*>(entry->d_name);
    const Descriptor lock(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
    std::error_code stays;
    if (::flock(lock.number, LOCK_EX | LOCK_NB) == 0) fs::remove_all(path, stays);
  }
}

}  // namespace

Descriptor::Descriptor(const fs::path& path, int how, mode_t mode)
    : number(open_uninterrupted(path, how, mode)) {}

int Descriptor::close() {
  return number < 0 ? 0 : ::close(std::exchange(number, -1));
}

TemporaryFolder::TemporaryFolder(const fs::path& parent) {
  remove_abandoned(parent);
  while (path.empty()) {
    std::string name = parent / kPattern;
    if (::mkdtemp(name.data()) == nullptr) return;
    if (lock >= 0) ::close(lock);
    lock = open_uninterrupted(name, O_RDONLY | O_DIRECTORY, 0);
    if (lock < 0 && errno != ENOENT) {
      ::rmdir(name.c_str());  // errno stays that of open()
      return;
    }
    // Until it is locked, another may take it for abandoned. A file system without locks has none.
    const bool is_lost = ::flock(lock, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (!is_lost && ::access(name.c_str(), F_OK) == 0) path = name;
  }
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path.empty()) fs::remove_all(path, ignored);
  if (lock >= 0) ::close(lock);
}

fs::path follow_links(fs::path path) {
  std::error_code ignored;
  for (int links = 0; links < kMaxLinks && fs::is_symlink(path, ignored); ++links)
    path = path.parent_path() / fs::read_symlink(path, ignored);
  return path;
}

fs::path parent_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

bool write_all(int descriptor, std::string_view bytes) {
  rlimit limit{};
  const bool fits = ::getrlimit(RLIMIT_FSIZE, &limit) != 0 || bytes.size() <= limit.rlim_cur;
  if (!fits) errno = EFBIG;
  while (fits && !bytes.empty()) {
    const ssize_t done = ::write(descriptor, bytes.data(), bytes.size());
    if (done == 0) errno = ENOSPC;
    if (done > 0)
      bytes.remove_prefix(static_cast<std::size_t>(done));
    else if (errno != EINTR)
      return false;
  }
  return fits;
}

Result<void> sync_parent(const fs::path& target) try {
  const Descriptor parent(parent_of(target), O_RDONLY | O_DIRECTORY);
  const bool synced = parent.number >= 0 && (::fsync(parent.number) == 0 || errno == EINVAL);
  if (synced) return {};  // EINVAL: a file system without such a sync
  auto refused = system_error(target, "sync the folder", errno);
  refused.value().what.insert(0, "replaced, durability unconfirmed: ");
  return refused;
} catch (const std::bad_alloc&) {
  return fail(ErrorCode::kOutOfMemory, "replaced, durability unconfirmed: no memory to sync");
}

}  // namespace hypermap
