// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A folder that appears whole or not at all.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <filesystem>
#include <string_view>

namespace hypermap {

/// Collects files in a temporary folder beside the target; `commit` gives it the target's name.
/// What was not committed is removed when this goes out of scope, what a dead process left of the
/// same target by `create`. Not synced: the same command makes it again.
class StagedFolder {
 public:
  /// Errors: kIo when the temporary cannot be made.
  [[nodiscard]] static Result<StagedFolder> create(const std::filesystem::path& target);
  StagedFolder(StagedFolder&& other) noexcept;
  StagedFolder& operator=(StagedFolder&&) = delete;
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;
  ~StagedFolder();

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return staging_; }

  /// Errors: kIo naming the file as it will be called.
  [[nodiscard]] Result<void> make_folder(std::string_view name) const;
  [[nodiscard]] Result<void> write(std::string_view name, std::string_view bytes) const;

  /// Puts the folder in the target's place, in one step where the file system can exchange; what
  /// is there already is removed afterwards.
  /// Errors: kIo; then the target is as it was.
  [[nodiscard]] Result<void> commit();

 private:
  StagedFolder(std::filesystem::path target, std::filesystem::path staging);
  [[nodiscard]] Result<void> commit_in_steps(bool replaces) const;

  std::filesystem::path target_;
  std::filesystem::path staging_;  ///< Empty when there is nothing to remove.
  int lock_ = -1;                  ///< Descriptor that holds the lock; none: -1.
};

}  // namespace hypermap
