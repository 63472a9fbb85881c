// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/atomic_file.hpp"

#include "replacement.hpp"
#include "system_error.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <optional>

namespace hypermap {
namespace {

struct Target {
  std::filesystem::path path;      ///< No link.
  std::optional<struct stat> old;  ///< None when the file is new.
};

Result<Target> find_target(const std::filesystem::path& path) {
  Target target{follow_links(path), std::nullopt};
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) target.old = status;
  if (!target.old && errno != ENOENT)
    return system_error(path, "look at the file to replace", errno);
  if (!target.old || S_ISREG(status.st_mode)) return target;
  return tl::make_unexpected(Error{.code = ErrorCode::kIo,
                                   .what = "is not a regular file, nothing is written",
                                   .file = path.string()});
}

}  // namespace

Result<void> check_target(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const Target target, find_target(path));
  const TemporaryFolder folder(parent_of(target.path));
  if (folder.path.empty()) return system_error(path, "create a folder beside it", errno);
  const Descriptor probe(folder.path / "new", O_WRONLY | O_CREAT | O_EXCL, 0600);
  if (probe.number < 0 || !write_all(probe.number, "?"))
    return system_error(path, "write into its folder", errno);
  return {};
}

Result<void> write_file_atomically(const std::filesystem::path& path, std::string_view bytes) {
  HYPERMAP_ASSIGN_OR_RETURN(const Target target, find_target(path));
  const auto& old = target.old;
  const auto refused = [&](const char* action) { return system_error(path, action, errno); };

  const TemporaryFolder folder(parent_of(target.path));
  if (folder.path.empty()) return refused("create a temporary folder beside it");
  const std::filesystem::path temporary = folder.path / "new";
  Descriptor file(temporary, O_WRONLY | O_CREAT | O_EXCL, old ? 0600 : 0666);
  if (file.number < 0) return refused("create a temporary file beside it");
  if (!write_all(file.number, bytes)) return refused("write");
  // Without the right to give files away the new file is the saver's own, with the old mode.
  if (old && ::fchown(file.number, old->st_uid, old->st_gid) != 0 && errno != EPERM)
    return refused("set the owner");
  if (old && ::fchmod(file.number, old->st_mode & 0777U) != 0) return refused("set the mode");
  if (::fsync(file.number) != 0) return refused("sync");
  if (file.close() != 0 && errno != EINTR) return refused("close");  // after EINTR it is closed
  if (::rename(temporary.c_str(), target.path.c_str()) != 0) return refused("put it in place");
  return sync_parent(target.path);
}

}  // namespace hypermap
