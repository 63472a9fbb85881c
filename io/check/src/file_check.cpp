// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/check/file_check.hpp"

#include "file_judges.hpp"

#include <algorithm>
#include <new>
#include <utility>

namespace hypermap {
namespace {

/// What the judge of a kind says.
Result<Verdict> judge(const std::filesystem::path& path,
                      FileKind kind,
                      const FileCheckOptions& options) {
  switch (kind) {
    case FileKind::kArchive:
      return judge_archive(path);
    case FileKind::kOctree:
      return judge_octree(path);
    case FileKind::kMap:
      return judge_map(path);
    case FileKind::kSemantic:
      return judge_semantic(path);
    case FileKind::kImage:
      return judge_image(path, options.size);
    case FileKind::kDepth:
      return judge_depth(path, options.size);
    case FileKind::kTrajectory:
      return judge_trajectory(path);
    case FileKind::kIntrinsics:
      return judge_intrinsics(path, options.size);
    case FileKind::kDetections:
      return judge_detections(path);
    case FileKind::kConfig:
      return judge_config(path);
    case FileKind::kDataset:
      return judge_dataset(path);
    default:
      break;
  }
  return fail(ErrorCode::kUnsupported,
              "files of kind " + std::string(name_of(kind)) + " are not judged by themselves");
}

Result<Verdict> judge_safely(const std::filesystem::path& path,
                             FileKind kind,
                             const FileCheckOptions& options) {
  try {
    return judge(path, kind, options);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "not enough memory to read it");
  }
}

Finding refusal(Error error, const std::filesystem::path& path) {
  if (error.file.empty()) error.file = path.string();
  return {Severity::kError, std::move(error)};
}

}  // namespace

bool FileJudgement::is_refused() const {
  return std::any_of(findings.begin(), findings.end(), [](const Finding& finding) {
    return finding.severity == Severity::kError;
  });
}

int FileJudgement::exit_code() const {
  if (findings.empty()) return 0;
  if (!is_refused()) return 1;
  const bool is_system = std::any_of(findings.begin(), findings.end(), [](const Finding& finding) {
    return finding.severity == Severity::kError &&
           (finding.error.code == ErrorCode::kIo || finding.error.code == ErrorCode::kOutOfMemory);
  });
  return is_system ? 3 : 2;
}

FileJudgement check_file(const std::filesystem::path& path, const FileCheckOptions& options) {
  FileJudgement out;
  const Result<FileKind> kind = options.as ? Result<FileKind>(*options.as) : find_file_kind(path);
  if (!kind) {
    out.findings.push_back(refusal(kind.error(), path));
    return out;
  }
  out.kind = *kind;
  auto verdict = judge_safely(path, *kind, options);
  if (!verdict) {
    out.findings.push_back(refusal(std::move(verdict).error(), path));
    return out;
  }
  out.summary = std::move(verdict->summary);
  out.findings = std::move(verdict->findings);
  for (Finding& finding : out.findings) {
    if (finding.error.file.empty()) finding.error.file = path.string();
    if (options.strict) finding.severity = Severity::kError;
  }
  return out;
}

}  // namespace hypermap
