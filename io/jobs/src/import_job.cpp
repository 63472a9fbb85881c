// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/import_job.hpp"

#include "imported_file.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace hypermap {
namespace {

/// A file with what came of it.
struct Part {
  const ImportedFile* file = nullptr;
  MapArchive archive;
};

Finding left_out(const Part& part, const std::string& what) {
  return {Severity::kWarning,
          {.code = ErrorCode::kUnsupported, .what = what, .file = part.file->path.string()}};
}

Result<void> add_frames(Hypermap& hypermap, const Part& part) {
  for (const FrameTransform& transform : part.archive.hypermap.frames().transforms()) {
    const auto& there = hypermap.frames().transforms();
    if (std::ranges::find(there, transform) != there.end()) continue;
    if (const auto added = hypermap.frames().add(transform); !added) {
      return about_file(*part.file, added.error());
    }
  }
  return {};
}

Result<void> check_new_layer(const MapArchive& whole, const Part& part, const std::string& name) {
  const auto is_octomap = [&](const OctomapExtension& one) { return one.entry.name == name; };
  if (whole.hypermap.find(name) == nullptr && std::ranges::none_of(whole.octomaps, is_octomap)) {
    return {};
  }
  return about_file(*part.file,
                    {.code = ErrorCode::kInvalidArgument,
                     .what = "has a layer " + printable(name) +
                             ", as another file has: NAME=FILE gives it a name of its own"});
}

Result<void> add_layers(MapArchive& whole, const Part& part) {
  for (const Layer& layer : part.archive.hypermap.layers()) {
    HYPERMAP_TRY(check_new_layer(whole, part, layer.info.name));
    Layer added = layer;
    added.info.file = std::nullopt;  // as the name, which nobody else has
    if (auto done = whole.hypermap.add_layer(std::move(added)); !done) {
      return about_file(*part.file, done.error());
    }
  }
  for (const OctomapExtension& octomap : part.archive.octomaps) {
    HYPERMAP_TRY(check_new_layer(whole, part, octomap.entry.name));
    whole.octomaps.push_back(octomap);
  }
  return add_frames(whole.hypermap, part);
}

/// What a part without 3D brings. The findings tell what of it is left out.
Result<std::vector<Finding>> add_part(MapArchive& whole, const Part& part) {
  HYPERMAP_TRY(add_layers(whole, part));
  for (const std::string& name : part.archive.classes.names()) {
    if (const auto added = whole.classes.add(name); !added) {
      return about_file(*part.file, added.error());
    }
  }
  whole.class_grids.insert(
      whole.class_grids.end(), part.archive.class_grids.begin(), part.archive.class_grids.end());
  // Runs that put frames into the map stay the newest ones: it goes on from them.
  whole.provenance.insert(
      whole.provenance.begin(), part.archive.provenance.begin(), part.archive.provenance.end());
  std::vector<Finding> findings;
  if (whole.vocabulary.empty()) {
    whole.vocabulary = part.archive.vocabulary;
  } else if (!part.archive.vocabulary.empty() && part.archive.vocabulary != whole.vocabulary) {
    findings.push_back(left_out(part, "its names of classes are left out: another file has some"));
  }
  if (!part.archive.opaque_files.empty() || !part.archive.foreign_extensions.empty()) {
    findings.push_back(left_out(part, "members that nobody knows are left out"));
  }
  return findings;
}

/// Files whose frame was given and that nothing connects with any other frame of the map: points of
/// one are nowhere in the other.
std::vector<Finding> unconnected(const ImportJob& job, const MapArchive& whole) {
  std::set<std::string> frames;
  for (const Layer& layer : whole.hypermap.layers()) frames.insert(layer.info.frame_id);
  for (const OctomapExtension& octomap : whole.octomaps) frames.insert(octomap.entry.frame_id);
  std::vector<Finding> findings;
  for (const ImportedFile& file : job.files) {
    const bool stands_alone = std::ranges::none_of(frames, [&](const std::string& frame) {
      return frame != file.frame_id && whole.hypermap.frames().to_from(frame, file.frame_id);
    });
    const bool is_asked = file.frame_id != ImportedFile{}.frame_id;
    if (!is_asked || !stands_alone || frames.size() < 2) continue;
    findings.push_back({.error = {.code = ErrorCode::kNotFound,
                                  .what = "lies in frame " + printable(file.frame_id) +
                                          ", which no transform connects with another one",
                                  .file = file.path.string()}});
  }
  return findings;
}

/// The part with objects or voxels, or an empty one.
Result<std::optional<std::size_t>> whole_part(const std::vector<Part>& parts) {
  std::optional<std::size_t> whole;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!has_3d(parts[i].archive)) continue;
    if (whole) {
      return about_file(*parts[i].file,
                        {.code = ErrorCode::kUnsupported,
                         .what = "has objects or voxels, as " + parts[*whole].file->path.string() +
                                 " has: only one map can bring them"});
    }
    whole = i;
  }
  return whole;
}

}  // namespace

Result<Loaded<MapArchive>> run_import(const ImportJob& job) {
  if (job.files.empty()) return fail(ErrorCode::kInvalidArgument, "no files", "files");
  std::vector<Part> parts;
  std::vector<Finding> findings;
  const LoadBudget budget(job.limits.sums, job.stop);
  for (const ImportedFile& file : job.files) {
    auto imported = import_file(file, job, budget);
    if (!imported) return about_file(file, imported.error());
    std::ranges::move(imported->findings, std::back_inserter(findings));
    parts.push_back({.file = &file, .archive = std::move(imported->value)});
  }
  HYPERMAP_ASSIGN_OR_RETURN(const auto first, whole_part(parts));
  MapArchive whole = first ? std::move(parts[*first].archive) : MapArchive{};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i == first) continue;
    HYPERMAP_ASSIGN_OR_RETURN(auto left, add_part(whole, parts[i]));
    std::ranges::move(left, std::back_inserter(findings));
  }
  for (const FrameTransform& transform : job.transforms) {
    HYPERMAP_TRY(whole.hypermap.frames().add(transform));
  }
  std::ranges::move(unconnected(job, whole), std::back_inserter(findings));
  return Loaded<MapArchive>{.value = std::move(whole), .findings = std::move(findings)};
}

}  // namespace hypermap
