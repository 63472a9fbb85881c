// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/file_reach.hpp"

#include "hypermap/core/base/utf8.hpp"

#include <algorithm>
#include <system_error>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

/// Absolute, without links and dots, as far as it is there.
Result<fs::path> resolved(const fs::path& path) {
  std::error_code error;
  fs::path place = fs::weakly_canonical(fs::absolute(path, error), error);
  if (!error) return place;
  return fail(ErrorCode::kIo, "cannot follow " + printable(path.string()) + ": " + error.message());
}

}  // namespace

Result<void> check_reach(FileReach reach, const fs::path& folder, const fs::path& name) {
  if (reach == FileReach::kAnywhere) return {};
  HYPERMAP_ASSIGN_OR_RETURN(const fs::path inside, resolved(folder.empty() ? "." : folder));
  HYPERMAP_ASSIGN_OR_RETURN(const fs::path place, resolved(inside / name));
  const auto [end_of_folder, rest] =
      std::mismatch(inside.begin(), inside.end(), place.begin(), place.end());
  if (end_of_folder == inside.end()) return {};
  return fail(ErrorCode::kMalformedFile,
              printable(name.string()) + " lies outside " + printable(inside.string()) +
                  ", and only files in there are to be read");
}

}  // namespace hypermap
