// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/staged_folder.hpp"

#include "abandoned.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

Unexpected io_error(const std::error_code& code, const char* what, const fs::path& path) {
  return tl::make_unexpected(
      Error{ErrorCode::kIo, std::string(what) + ": " + code.message(), path.string()});
}

/// The target without a trailing slash, so that it has a name and a parent.
fs::path plain(const fs::path& target) {
  return target.has_filename() ? target : target.parent_path();
}

/// Hidden, beside the target: of the same file system.
std::string staging_prefix(const fs::path& target) {
  return "." + target.filename().string() + ".partial-";
}

fs::path folder_of(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

fs::path staging_for(const fs::path& target) {
  return target.parent_path() / (staging_prefix(target) + std::to_string(::getpid()));
}

}  // namespace

StagedFolder::StagedFolder(fs::path target, fs::path staging)
    : target_(std::move(target)), staging_(std::move(staging)) {}

StagedFolder::StagedFolder(StagedFolder&& other) noexcept
    : target_(std::move(other.target_)),
      staging_(std::exchange(other.staging_, {})),
      lock_(std::exchange(other.lock_, -1)) {}

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  if (!staging_.empty()) fs::remove_all(staging_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

Result<StagedFolder> StagedFolder::create(const fs::path& target) {
  const fs::path final_name = plain(target);
  remove_abandoned(folder_of(final_name), staging_prefix(final_name));
  StagedFolder folder(final_name, staging_for(final_name));
  std::error_code code;
  fs::remove_all(folder.staging_, code);  // of a dead process with the same number
  fs::create_directories(folder.staging_, code);
  if (code) return io_error(code, "cannot make a folder", final_name);
  folder.lock_ = ::open(folder.staging_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder.lock_ >= 0) ::flock(folder.lock_, LOCK_EX | LOCK_NB);  // marks it as alive
  return folder;
}

Result<void> StagedFolder::make_folder(std::string_view name) const {
  std::error_code code;
  fs::create_directory(staging_ / name, code);
  if (code) return io_error(code, "cannot make a folder", target_ / name);
  return {};
}

Result<void> StagedFolder::write(std::string_view name, std::string_view bytes) const {
  errno = 0;
  std::ofstream file(staging_ / name, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (file) return {};
  return io_error(
      std::error_code(errno, std::generic_category()), "cannot be written", target_ / name);
}

Result<void> StagedFolder::commit() {
  std::error_code code;
  const bool replaces = fs::exists(target_, code);
  // In one step, so that the target's name always stands for one of both.
  const unsigned how = replaces ? RENAME_EXCHANGE : RENAME_NOREPLACE;
  if (::renameat2(AT_FDCWD, staging_.c_str(), AT_FDCWD, target_.c_str(), how) != 0) {
    if (errno != EINVAL && errno != ENOSYS) {
      return io_error({errno, std::generic_category()}, "cannot be put in place", target_);
    }
    HYPERMAP_TRY(commit_in_steps(replaces));
  }
  const fs::path old = std::exchange(staging_, {});
  if (replaces) fs::remove_all(old, code);
  if (code) return io_error(code, "is in place, but the old one cannot be removed", old);
  return {};
}

/// For file systems that cannot exchange: the target is absent for a moment.
Result<void> StagedFolder::commit_in_steps(bool replaces) const {
  std::error_code code;
  fs::path aside = staging_;
  aside += ".old";
  if (replaces) fs::rename(target_, aside, code);
  if (code) return io_error(code, "cannot be replaced", target_);
  fs::rename(staging_, target_, code);
  const std::error_code reason = code;
  if (replaces) fs::rename(aside, reason ? target_ : staging_, code);
  if (reason) return io_error(reason, "cannot be put in place", target_);
  return {};
}

}  // namespace hypermap
