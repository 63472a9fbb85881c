// SPDX-License-Identifier: BSD-3-Clause
#include "map_rescue.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"

#include <array>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string>
#include <system_error>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

/// What layers can be derived from again.
MapArchive without_layers(const MapArchive& archive) {
  return {.hypermap = {},
          .classes = archive.classes,
          .objects = archive.objects,
          .octree = archive.octree,
          .floor = archive.floor,
          .provenance = archive.provenance};
}

/// In how few parts, and how surely, a map is to be saved.
struct Content {
  const MapArchive& archive;
  const char* name;
  bool verify;
};

/// kIo: another place may do.
Result<void> save_content(const Content& content, const fs::path& path, SaveOptions options) try {
  HYPERMAP_TRY(check_target(path));
  options.verify = content.verify;
  return save_archive(content.archive, path, options);
} catch (const std::exception& exception) {
  return caught(exception, ErrorCode::kInvalidArgument, "the map");
}

/// In a folder of its own, so that nobody else can have put a file or a link there.
Result<fs::path> save_among_temporaries(const Content& content, const SaveOptions& options) {
  std::error_code failed;
  const fs::path all = fs::temp_directory_path(failed);
  std::string folder = (all / "hypermap-rescue-XXXXXX").string();
  if (failed || ::mkdtemp(folder.data()) == nullptr) {
    return fail(ErrorCode::kIo, "no folder for temporary files");
  }
  const fs::path path = fs::path(folder) / "map.hmap";
  auto saved = save_content(content, path, options);
  if (saved) return path;
  fs::remove(folder, failed);
  return Unexpected(std::move(saved).error());
}

/// Where it is now. Errors: those of the last place.
Result<fs::path> save_somewhere(const Content& content,
                                const fs::path& output,
                                const SaveOptions& options) {
  const fs::path beside = rescue_path(output);
  auto saved = save_content(content, beside, options);
  if (saved) return beside;
  if (saved.error().code != ErrorCode::kIo) return Unexpected(std::move(saved).error());
  std::error_code failed;
  const fs::path here = fs::current_path(failed) / beside.filename();
  if (!failed && !fs::exists(here, failed) && !failed) {
    saved = save_content(content, here, options);
    if (saved) return here;
  }
  return save_among_temporaries(content, options);
}

}  // namespace

Error with_rescue(Error error,
                  const MapArchive& archive,
                  const fs::path& output,
                  const SaveOptions& options) {
  const MapArchive essence = without_layers(archive);
  const std::array contents{
      Content{.archive = archive, .name = "the map is", .verify = true},
      Content{.archive = essence, .name = "its octree and objects are", .verify = true},
      // Without the memory that a second look takes.
      Content{.archive = essence, .name = "its octree and objects are", .verify = false}};
  for (const Content& content : contents) {
    const auto path = save_somewhere(content, output, options);
    if (!path) continue;
    error.what += std::string("; ") + content.name + " saved in " + printable(path->string(), 500);
    return error;
  }
  error.what += "; the map could be saved nowhere";
  return error;
}

}  // namespace hypermap
