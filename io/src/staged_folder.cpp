// SPDX-License-Identifier: BSD-3-Clause
#include "staged_folder.hpp"

#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <string>
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

fs::path sibling(const fs::path& target, const char* kind) {
  return target.parent_path() /
         ("." + target.filename().string() + "." + kind + "-" + std::to_string(::getpid()));
}

}  // namespace

StagedFolder::StagedFolder(fs::path target, fs::path staging)
    : target_(std::move(target)), staging_(std::move(staging)) {}

StagedFolder::StagedFolder(StagedFolder&& other) noexcept
    : target_(std::move(other.target_)), staging_(std::exchange(other.staging_, {})) {}

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  if (!staging_.empty()) fs::remove_all(staging_, ignored);
}

Result<StagedFolder> StagedFolder::create(const fs::path& target) {
  const fs::path final_name = plain(target);
  StagedFolder folder(final_name, sibling(final_name, "partial"));
  std::error_code code;
  fs::remove_all(folder.staging_, code);  // of a dead process with the same number
  fs::create_directories(folder.staging_, code);
  if (code) return io_error(code, "cannot make a folder", final_name);
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
  const fs::path aside = sibling(target_, "old");
  std::error_code code;
  const bool replaces = fs::exists(target_, code);
  if (replaces) fs::rename(target_, aside, code);
  if (code) return io_error(code, "cannot be replaced", target_);
  fs::rename(staging_, target_, code);
  if (code) {
    const std::error_code reason = code;
    if (replaces) fs::rename(aside, target_, code);
    return io_error(reason, "cannot be put in place", target_);
  }
  staging_.clear();
  if (replaces) fs::remove_all(aside, code);
  if (code) return io_error(code, "is in place, but the old one cannot be removed", aside);
  return {};
}

}  // namespace hypermap
