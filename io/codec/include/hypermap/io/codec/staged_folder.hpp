// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A folder that appears whole or not at all.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace hypermap {

struct TemporaryFolder;

/// Collects files in a temporary folder beside the target; `commit` gives it the target's name.
/// A symbolic link is followed and stays. What was not committed is removed when this goes out of
/// scope, what dead processes left beside the target by `create`.
class StagedFolder {
 public:
  /// Makes the folders above the target. Errors: kIo when a folder cannot be made.
  [[nodiscard]] static Result<StagedFolder> create(const std::filesystem::path& target);
  StagedFolder(StagedFolder&& other) noexcept;
  StagedFolder& operator=(StagedFolder&&) = delete;
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;
  ~StagedFolder();

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

  /// Errors: kIo naming the file as it will be called.
  [[nodiscard]] Result<void> make_folder(std::string_view name) const;
  /// Threads: any number at once, each with files of its own.
  [[nodiscard]] Result<void> write(std::string_view name, std::string_view bytes) const;

  /// Syncs what was written and puts it in the target's place, in one step where the file system
  /// can exchange; what was there is removed once the new place is synced too.
  /// Errors: kIo; then the target is as it was, unless the message says "replaced": when only the
  /// last sync or the removal fails.
  [[nodiscard]] Result<void> commit();

 private:
  StagedFolder(std::filesystem::path target, std::unique_ptr<TemporaryFolder> temporary);
  [[nodiscard]] Result<void> commit_in_steps(bool replaces) const;

  std::filesystem::path target_;  ///< No link.
  std::unique_ptr<TemporaryFolder> temporary_;
  std::filesystem::path path_;
};

/// Whether a folder may be replaced as a whole: it is not there, or all that lies in it are files
/// that it may lose, by their names. Errors: kInvalidArgument naming what is none, "no <kind>";
/// kIo when it cannot be looked at.
[[nodiscard]] Result<void> require_replaceable(
    const std::filesystem::path& folder,
    std::string_view kind,
    const std::function<bool(const std::string&)>& is_replaceable);

}  // namespace hypermap
