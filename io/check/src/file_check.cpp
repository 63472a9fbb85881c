// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/check/file_check.hpp"

#include "file_checks.hpp"

#include <algorithm>
#include <new>
#include <utility>

namespace hypermap {
namespace {

/// Runs the check of one kind of file.
Result<FileSummary> check_by_kind(const std::filesystem::path& path,
                                  FileKind kind,
                                  const FileCheckOptions& options) {
  switch (kind) {
    case FileKind::kArchive:
      return check_archive(path, options);
    case FileKind::kOctree:
      return check_octree(path);
    case FileKind::kMap:
      return check_map(path, options);
    case FileKind::kSemantic:
      return check_semantic(path, options);
    case FileKind::kImage:
      return check_image(path, options.size);
    case FileKind::kDepth:
      return check_depth(path, options.size);
    case FileKind::kTrajectory:
      return check_trajectory(path);
    case FileKind::kIntrinsics:
      return check_intrinsics(path, options.size);
    case FileKind::kDetections:
      return check_detections(path);
    case FileKind::kConfig:
      return check_config(path, options.limits.reach);
    case FileKind::kDataset:
      return check_dataset(path, options);
    case FileKind::kTruth:
      return check_truth(path);
    case FileKind::kTile:
      return check_tile(path);
    case FileKind::kEmbedding:
      return check_embedding(path);
    case FileKind::kCloud:
      return check_cloud(path);
    case FileKind::kSequences:
      return check_sequences(path);
    case FileKind::kUpdate:
      return check_update(path, options);
    case FileKind::kZones:
      return check_zones(path);
    case FileKind::kVocabulary:
      return check_vocabulary(path);
    case FileKind::kPlaces:
      return check_places(path);
    case FileKind::kTileSet:
      return check_tile_set(path);
    default:
      break;
  }
  return fail(ErrorCode::kUnsupported,
              "files of kind " + std::string(name_of(kind)) + " are not checked by themselves");
}

Result<FileSummary> check_safely(const std::filesystem::path& path,
                                 FileKind kind,
                                 const FileCheckOptions& options) {
  try {
    return check_by_kind(path, kind, options);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "not enough memory to read it");
  }
}

Finding refusal(Error error, const std::filesystem::path& path) {
  if (error.file.empty()) error.file = path.string();
  return {Severity::kError, std::move(error)};
}

}  // namespace

bool FileCheckResult::is_refused() const {
  return std::any_of(findings.begin(), findings.end(), [](const Finding& finding) {
    return finding.severity == Severity::kError;
  });
}

int FileCheckResult::exit_code() const {
  if (findings.empty()) return 0;
  if (!is_refused()) return 1;
  const bool is_system = std::any_of(findings.begin(), findings.end(), [](const Finding& finding) {
    return finding.severity == Severity::kError &&
           (finding.error.code == ErrorCode::kIo || finding.error.code == ErrorCode::kOutOfMemory);
  });
  return is_system ? 3 : 2;
}

FileCheckResult check_file(const std::filesystem::path& path, const FileCheckOptions& options) {
  FileCheckResult out;
  const Result<FileKind> kind = options.as ? Result<FileKind>(*options.as) : find_file_kind(path);
  if (!kind) {
    out.findings.push_back(refusal(kind.error(), path));
    return out;
  }
  out.kind = *kind;
  auto checked = check_safely(path, *kind, options);
  if (!checked) {
    out.findings.push_back(refusal(std::move(checked).error(), path));
    return out;
  }
  out.summary = std::move(checked->summary);
  out.findings = std::move(checked->findings);
  for (Finding& finding : out.findings) {
    if (finding.error.file.empty()) finding.error.file = path.string();
    if (options.strict) finding.severity = Severity::kError;
  }
  return out;
}

}  // namespace hypermap
