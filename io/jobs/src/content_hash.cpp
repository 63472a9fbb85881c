// SPDX-License-Identifier: BSD-3-Clause
#include "content_hash.hpp"

#include "hypermap/core/base/job_progress.hpp"
#include "hypermap/io/archive/provenance.hpp"
#include "hypermap/io/codec/byte_source.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <system_error>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kHashedPieceBytes = std::uint64_t{1} << 20U;

Unexpected unreadable_folder(const fs::path& folder, const std::error_code& reason) {
  return Unexpected(Error{.code = ErrorCode::kIo,
                          .what = "cannot be looked through: " + reason.message(),
                          .file = folder.string()});
}

/// What lies in a folder, in the order of the names.
Result<std::vector<fs::path>> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    entries.push_back(entry->path());
  }
  if (failed) return unreadable_folder(folder, failed);
  std::ranges::sort(entries, {}, [](const fs::path& path) { return path.native(); });
  return entries;
}

/// A walk through a folder: its hash so far, and where it is.
struct FolderWalk {
  std::vector<fs::path> left_out;  ///< Without links.
  StopCheck stop;
  InputHash hash;
  std::vector<fs::path> open_folders;  ///< Without links, from the outermost on.
};

// NOLINTNEXTLINE(misc-no-recursion) the depth of folders, each of which is open once
Result<void> add_folder(FolderWalk& walk, const fs::path& folder, const std::string& name) {
  std::error_code failed;
  const fs::path here = fs::canonical(folder, failed);
  if (failed) return unreadable_folder(folder, failed);
  if (std::ranges::find(walk.open_folders, here) != walk.open_folders.end()) return {};
  walk.open_folders.push_back(here);
  HYPERMAP_ASSIGN_OR_RETURN(const auto entries, entries_of(folder));
  for (const fs::path& entry : entries) {
    const fs::file_status status = fs::status(entry, failed);
    const std::string entry_name = name + "/" + entry.filename().string();
    const bool counts = fs::is_directory(status) || fs::is_regular_file(status);
    if (!counts ||
        std::ranges::find(walk.left_out, fs::canonical(entry, failed)) != walk.left_out.end()) {
      continue;
    }
    if (fs::is_directory(status)) {
      HYPERMAP_TRY(add_folder(walk, entry, entry_name));
    } else {
      HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, content_hash(entry, walk.stop));
      walk.hash.add(entry_name);
      walk.hash.add(bytes);
    }
  }
  walk.open_folders.pop_back();
  return {};
}

}  // namespace

Result<std::string> content_hash(const fs::path& path, const StopCheck& stop) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto file,
                            open_file(path, std::numeric_limits<std::uint64_t>::max()));
  InputHash hash;
  for (std::uint64_t at = 0; at < file->size(); at += kHashedPieceBytes) {
    if (stop && stop()) return interrupted();
    const auto num_bytes = static_cast<std::size_t>(std::min(kHashedPieceBytes, file->size() - at));
    HYPERMAP_ASSIGN_OR_RETURN(const std::string piece, file->read_at(at, num_bytes));
    hash.add(piece);
  }
  return hash.text();
}

Result<std::string> folder_hash(const fs::path& folder,
                                std::span<const fs::path> left_out,
                                const StopCheck& stop) {
  FolderWalk walk{.left_out = {}, .stop = stop, .hash = {}, .open_folders = {}};
  for (const fs::path& path : left_out) {
    std::error_code absent;
    const fs::path whole = fs::canonical(path, absent);
    if (!absent) walk.left_out.push_back(whole);
  }
  HYPERMAP_TRY(add_folder(walk, folder, ""));
  return walk.hash.text();
}

}  // namespace hypermap
