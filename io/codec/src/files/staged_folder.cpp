// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/staged_folder.hpp"

#include "replacement.hpp"
#include "system_error.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

}  // namespace

StagedFolder::StagedFolder(fs::path target, std::unique_ptr<TemporaryFolder> temporary)
    : target_(std::move(target)),
      temporary_(std::move(temporary)),
      path_(temporary_->path / "new") {}

StagedFolder::StagedFolder(StagedFolder&& other) noexcept = default;
StagedFolder::~StagedFolder() = default;

Result<StagedFolder> StagedFolder::create(const fs::path& target) {
  // A trailing slash would hide a link, and leave no name to rename to.
  const fs::path place = follow_links(target.has_filename() ? target : target.parent_path());
  std::error_code code;
  fs::create_directories(parent_of(place), code);
  if (code) return system_error(place, "make the folder for it", code.value());
  auto temporary = std::make_unique<TemporaryFolder>(parent_of(place));
  if (temporary->path.empty())
    return system_error(place, "create a temporary folder beside it", errno);
  StagedFolder folder(place, std::move(temporary));
  fs::create_directory(folder.path_, code);
  if (code) return system_error(place, "make a folder", code.value());
  return folder;
}

Result<void> StagedFolder::make_folder(std::string_view name) const {
  std::error_code code;
  fs::create_directory(path_ / name, code);
  if (code) return system_error(target_ / name, "make a folder", code.value());
  return {};
}

Result<void> StagedFolder::write(std::string_view name, std::string_view bytes) const {
  Descriptor file(path_ / name, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (file.number < 0) return system_error(target_ / name, "create", errno);
  if (!write_all(file.number, bytes)) return system_error(target_ / name, "write", errno);
  if (file.close() != 0) return system_error(target_ / name, "close", errno);
  return {};
}

Result<void> StagedFolder::commit() {
  // All files at once: a sync of each would cost as many commits of the file system's journal.
  if (::syncfs(temporary_->lock) != 0) return system_error(target_, "sync", errno);
  std::error_code code;
  const bool replaces = fs::exists(target_, code);
  if (code) return system_error(target_, "look at", code.value());
  // In one step, so that the target's name always stands for one of both.
  const unsigned how = replaces ? RENAME_EXCHANGE : RENAME_NOREPLACE;
  if (::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target_.c_str(), how) != 0) {
    if (errno != EINVAL && errno != ENOSYS) return system_error(target_, "put it in place", errno);
    HYPERMAP_TRY(commit_in_steps(replaces));
  }
  const fs::path old = std::exchange(temporary_->path, {});  // stays until its successor is safe
  HYPERMAP_TRY(sync_parent(target_));
  fs::remove_all(old, code);
  if (!code) return {};
  auto refused = system_error(old, "remove the old folder", code.value());
  refused.value().what.insert(0, "replaced, but ");
  return refused;
}

/// For file systems that cannot exchange: the target is absent for a moment. Until the new one is
/// there the old one has a name that nobody sweeps.
Result<void> StagedFolder::commit_in_steps(bool replaces) const {
  std::error_code code;
  fs::path aside = temporary_->path;
  aside += ".old";
  if (replaces) fs::rename(target_, aside, code);
  if (code) return system_error(target_, "move the old folder aside", code.value());
  fs::rename(path_, target_, code);
  const std::error_code reason = code;
  if (replaces) fs::rename(aside, reason ? target_ : path_, code);
  if (reason) return system_error(target_, "put it in place", reason.value());
  return {};
}

Result<void> require_replaceable(
    const std::filesystem::path& folder,
    std::string_view kind,
    const std::function<bool(const std::string&)>& is_replaceable) try {
  namespace fs = std::filesystem;
  if (!fs::exists(folder)) return {};
  const auto refused = [&](std::string what) -> Result<void> {
    return Unexpected(Error{ErrorCode::kInvalidArgument, std::move(what), folder.string()});
  };
  if (!fs::is_directory(folder)) return refused("is no folder");
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && is_replaceable(name)) continue;
    return refused("would be replaced, but '" + printable(name) + "' in it is no " +
                   std::string(kind));
  }
  return {};
} catch (const std::filesystem::filesystem_error& error) {
  return Unexpected(
      Error{ErrorCode::kIo, "cannot be looked at: " + error.code().message(), folder.string()});
}

}  // namespace hypermap
