// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/merge_job.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/archive/map_sessions.hpp"
#include "hypermap/io/archive/transformed_map.hpp"
#include "map_registration.hpp"
#include "merge_plan.hpp"
#include "merged_archives.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <string>
#include <utility>

namespace hypermap {
namespace {

/// What was said of a file's map, with its name.
void note(std::vector<Finding>& findings, std::vector<Finding> of_file, const MergedFile& file) {
  for (Finding& finding : of_file) {
    if (finding.error.file.empty()) finding.error.file = file.path.string();
  }
  std::ranges::move(of_file, std::back_inserter(findings));
}

/// What cannot be moved to where its world lies, nobody had asked to move.
Error explained(Error error, const PlannedMap& map) {
  if (map.file->placement || map.found) return error;
  error.field.clear();
  error.what = "its world was set upright in another way than in the first map: " + error.what +
               "; give both runs one --up, or find where it lies with --register";
  return error;
}

/// The map in the frame in which maps are added.
Result<Loaded<MapArchive>> load_placed(const PlannedMap& map, const MergeJob& job) {
  auto loaded = load_archive(map.file->path, job.limits, archive_layer_types(), job.stop);
  if (!loaded) return about_map(*map.file, loaded.error());
  if (!map.sum_from_map) return loaded;
  auto moved = transformed(loaded->value, *map.sum_from_map);
  if (!moved) return about_map(*map.file, explained(moved.error(), map));
  loaded->value = std::move(*moved);
  return loaded;
}

Result<void> check_frame(const MapArchive& map, const MapArchive& sum, const MergedFile& file) {
  if (shown_frame_id(map) == shown_frame_id(sum)) return {};
  return about_map(
      file,
      {.code = ErrorCode::kUnsupported,
       .what = "lies in frame " + shown_frame_id(map) + ", the others in " + shown_frame_id(sum)});
}

/// A map as it lies in its file, of which its voxels alone are asked for.
Result<MapArchive> load_voxels(const MergedFile& file, const MergeJob& job) {
  auto loaded = load_archive_parts(file.path,
                                   {.octrees = true, .objects = false, .class_grids = false},
                                   job.limits,
                                   archive_layer_types(),
                                   job.stop);
  if (!loaded) return about_map(file, loaded.error());
  return std::move(loaded->value.map);
}

/// Finds where maps without a placement lie in the first one.
Result<void> register_all(std::vector<PlannedMap>& plan, const MergeJob& job) {
  const MergedFile& first = job.files.front();
  HYPERMAP_ASSIGN_OR_RETURN(const MapArchive fixed, load_voxels(first, job));
  for (PlannedMap& map : plan) {
    if (map.file == &first || map.file->placement) continue;
    HYPERMAP_ASSIGN_OR_RETURN(const MapArchive moving, load_voxels(*map.file, job));
    auto found = register_maps(moving, fixed, job.options.layers);
    if (!found) {
      Error error = found.error();
      error.what = "where it lies in " + printable(first.path.string()) +
                   " is not sure: " + error.what + "; --transform says it";
      return about_map(*map.file, std::move(error));
    }
    map.sum_from_map = MapFromOldMap(isometry_of(found->placement));
    map.found = *found;
  }
  return {};
}

/// Maps that were added, and what was said of them.
struct Sum {
  MapArchive map;
  std::optional<Stamp> last = std::nullopt;  ///< Stamp of their latest frame; none: not known.
  std::size_t num_forgotten_runs = 0;
  MergeReport report;
};

bool is_later(const PlannedMap& map, const Sum& sum, const MergeJob& job) {
  return job.in_order || (map.first && sum.last && *sum.last < *map.first);
}

Result<void> add_map(Sum& sum, const PlannedMap& map, const MergeJob& job) {
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, load_placed(map, job));
  note(sum.report.findings, map.findings, *map.file);
  note(sum.report.findings, std::move(loaded.findings), *map.file);
  MergedMap merged_map{.path = map.file->path,
                       .num_sessions = map.num_sessions,
                       .found = map.found,
                       .leaves = loaded.value.octree->num_leaves()};
  if (sum.report.maps.empty()) {
    merged_map.num_new = loaded.value.objects.size();
    sum.map = std::move(loaded.value);
    sum.last = map.last;
  } else {
    HYPERMAP_TRY(check_frame(loaded.value, sum.map, *map.file));
    merged_map.is_later = is_later(map, sum, job);
    auto both = merged(std::move(sum.map),
                       std::move(loaded.value),
                       {.association = job.options.mapper.objects.association,
                        .is_later = merged_map.is_later,
                        .is_floor_stated = job.options.layers.floor_m.has_value(),
                        .name = map.file->path.stem().string()});
    if (!both) return about_map(*map.file, both.error());
    note(sum.report.findings, std::move(both->findings), *map.file);
    sum.num_forgotten_runs += both->num_forgotten_runs;
    merged_map.num_joined = both->num_joined;
    merged_map.num_new = both->num_new;
    merged_map.num_gone = both->num_gone;
    sum.map = std::move(both->map);
    // Of a map without stamps nobody knows whether another one came after it.
    sum.last = sum.last && map.last ? std::optional(std::max(*sum.last, *map.last)) : std::nullopt;
  }
  sum.report.maps.push_back(std::move(merged_map));
  return {};
}

Finding forgotten_runs(std::size_t count) {
  return {.error = {.code = ErrorCode::kLimit,
                    .what = "a map keeps " + std::to_string(kMaxRuns) + " runs, " +
                            std::to_string(count) +
                            " are forgotten: all but the first and the "
                            "newest",
                    .field = "provenance"}};
}

/// Of sessions that can no longer be told apart by name.
std::vector<Finding> shared_names(const MapArchive& map) {
  std::vector<Finding> findings;
  for (const std::string& name : names_of_several(sessions_of(map.provenance))) {
    findings.push_back(
        {.error = {.code = ErrorCode::kInvalidArgument,
                   .what = "several sessions are called '" + printable(name) +
                           "': by that name the newest is found, the others by nothing",
                   .field = "session"}});
  }
  return findings;
}

Result<MergeResult> finished(Sum sum, LayerOptions layers, const MergeJob& job) {
  HYPERMAP_ASSIGN_OR_RETURN(const DerivedLayers derived,
                            derive_layers(sum.map, job.options.mapper.objects, layers));
  MergeReport& report = sum.report;
  report.findings.insert(report.findings.end(), derived.left_out.begin(), derived.left_out.end());
  if (sum.num_forgotten_runs > 0) report.findings.push_back(forgotten_runs(sum.num_forgotten_runs));
  const std::vector<Finding> shared = shared_names(sum.map);
  report.findings.insert(report.findings.end(), shared.begin(), shared.end());
  report.leaves = sum.map.octree->num_leaves();
  report.num_objects =
      confirmed_objects(sum.map.objects, job.options.mapper.objects.confirmation).size();
  report.num_tentative = sum.map.objects.size() - report.num_objects;
  report.num_sessions = sessions_of(sum.map.provenance).size();
  return MergeResult{.map = std::move(sum.map), .report = std::move(sum.report)};
}

Result<MergeResult> merge_or_throw(const MergeJob& job, const JobProgress& progress) {
  HYPERMAP_TRY(validate(job.options));
  HYPERMAP_ASSIGN_OR_RETURN(std::vector<PlannedMap> plan, plan_merge(job));
  if (job.registers) HYPERMAP_TRY(register_all(plan, job));
  std::vector<PlannedMap> in_oldest = plan;
  const auto result_from_oldest = place_in_oldest(in_oldest);
  if (!result_from_oldest) return merge_planned(plan, job, progress);
  auto result = merge_planned(in_oldest, job, progress, result_from_oldest);
  const bool cannot_be_moved = !result && result.error().code == ErrorCode::kUnsupported;
  return cannot_be_moved ? merge_planned(plan, job, progress) : std::move(result);
}

}  // namespace

Result<MergeResult> merge_planned(std::span<const PlannedMap> plan,
                                  const MergeJob& job,
                                  const JobProgress& progress,
                                  const std::optional<MapFromOldMap>& result_from_sum) {
  LayerOptions layers = job.options.layers;
  Sum sum{.map = {.hypermap = {}}, .report = {}};
  for (const PlannedMap& map : plan) {
    layers.class_stack = layers.class_stack || map.has_stack;
    HYPERMAP_TRY(add_map(sum, map, job));
    if (progress && !progress(sum.report.maps.size(), plan.size())) return interrupted();
  }
  if (result_from_sum) {
    auto moved = transformed(sum.map, *result_from_sum);
    if (!moved) return about_map(job.files.front(), moved.error());
    sum.map = std::move(*moved);
  }
  return finished(std::move(sum), layers, job);
}

Result<MergeResult> run_merge(const MergeJob& job, const JobProgress& progress) {
  return guarded(ErrorCode::kUnavailable, "the map", [&] { return merge_or_throw(job, progress); });
}

}  // namespace hypermap
