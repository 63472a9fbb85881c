// SPDX-License-Identifier: BSD-3-Clause
#include "merge_plan.hpp"

#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/archive/class_stack.hpp"
#include "hypermap/io/archive/grid_stack_layer.hpp"
#include "hypermap/io/archive/map_sessions.hpp"
#include "merge_findings.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <utility>

namespace hypermap {
namespace {

/// Two alignments of one world that differ by less are one.
constexpr double kSameShiftM = 1e-6;
constexpr double kSameTurnRad = 1e-6;
/// Cosine of a tilt that is refused (transformed_map.hpp).
constexpr double kLeastUpright = 1.0 - 5e-13;

/// A map with what its archive says without voxels and objects.
struct LookedThrough {
  PlannedMap plan;
  double resolution_m = 0.0;
  std::vector<Provenance> runs;
};

Unexpected refused(const MergedFile& file,
                   ErrorCode code,
                   std::string what,
                   std::string field = {}) {
  return about_map(file, {.code = code, .what = std::move(what), .field = std::move(field)});
}

template <class Choose>
std::optional<Stamp> stamp_of(const std::optional<Stamp>& a,
                              const std::optional<Stamp>& b,
                              const Choose& choose) {
  if (!a || !b) return a ? a : b;
  return choose(*a, *b);
}

Result<LookedThrough> look_through(const MergedFile& file, const MergeJob& job) {
  auto loaded = load_archive_parts(file.path,
                                   {.octrees = false, .objects = false, .class_grids = false},
                                   job.limits,
                                   archive_layer_types(),
                                   job.stop);
  if (!loaded) return about_map(file, loaded.error());
  MapArchive& map = loaded->value.map;
  if (map.checkpoint.kind != ValueKind::kNull) {
    return refused(
        file, ErrorCode::kUnsupported, "is a checkpoint: map --resume ends its run first");
  }
  if (!loaded->value.octree_resolution_m) {
    return refused(file,
                   ErrorCode::kUnsupported,
                   "has no semantic octree: import makes one archive of maps without one");
  }
  LookedThrough out{.plan = {.file = &file, .num_sessions = sessions_of(map.provenance).size()},
                    .resolution_m = *loaded->value.octree_resolution_m,
                    .runs = std::move(map.provenance)};
  out.plan.has_stack = map.hypermap.find_as<GridStackLayer>(kStackLayer) != nullptr;
  for (const Provenance& run : out.runs) {
    out.plan.first =
        stamp_of(out.plan.first, run.first_stamp, [](Stamp a, Stamp b) { return std::min(a, b); });
    out.plan.last =
        stamp_of(out.plan.last, run.last_stamp, [](Stamp a, Stamp b) { return std::max(a, b); });
  }
  return out;
}

/// Evidence of one frame must not count as that of two.
Result<void> refuse_same_runs(std::span<const LookedThrough> maps) {
  std::map<std::string, const MergedFile*> file_of_run;
  for (const LookedThrough& map : maps) {
    for (const Provenance& run : map.runs) {
      if (run.input_hash.empty() || is_import(run)) continue;
      const auto [known, is_new] = file_of_run.try_emplace(run.input_hash, map.plan.file);
      if (is_new || known->second == map.plan.file) continue;
      return refused(*map.plan.file,
                     ErrorCode::kInvalidArgument,
                     "has the run of " + printable(run.input) + " that " +
                         printable(known->second->path.string()) +
                         " has, whose frames would count twice");
    }
  }
  return {};
}

Result<void> refuse_other_voxels(std::span<const LookedThrough> maps) {
  const LookedThrough& first = maps.front();
  for (const LookedThrough& map : maps) {
    if (map.resolution_m == first.resolution_m) continue;
    return refused(*map.plan.file,
                   ErrorCode::kInvalidArgument,
                   "must be that of " + printable(first.plan.file->path.string()) + ", " +
                       number_text(first.resolution_m) + " m, is " + number_text(map.resolution_m) +
                       " m: map one of both anew",
                   "resolution_m");
  }
  return {};
}

/// Whether the poses of both are in one world: as both say, else by the name of their input.
bool share_world(const Provenance& a, const Provenance& b) {
  if (!a.world.empty() || !b.world.empty()) return a.world == b.world;
  return !a.input.empty() && a.input == b.input;
}

bool is_identity(const Eigen::Isometry3d& motion) {
  return motion.translation().norm() <= kSameShiftM &&
         Eigen::AngleAxisd(motion.linear()).angle() <= kSameTurnRad;
}

/// Where the map lies in the first one, when their newest runs of one world were set upright in
/// different ways.
std::optional<MapFromOldMap> placed_by_world(const LookedThrough& map, const LookedThrough& first) {
  for (auto run = map.runs.rbegin(); run != map.runs.rend(); ++run) {
    for (auto known = first.runs.rbegin(); known != first.runs.rend(); ++known) {
      if (!share_world(*run, *known)) continue;
      const Eigen::Isometry3d motion =
          known->map_from_input.isometry() * run->map_from_input.isometry().inverse();
      return is_identity(motion) ? std::nullopt : std::optional(MapFromOldMap(motion));
    }
  }
  return std::nullopt;
}

void place(std::vector<LookedThrough>& maps, const MergeJob& job) {
  for (LookedThrough& map : maps) {
    if (map.plan.file->placement) {
      map.plan.sum_from_map = MapFromOldMap(isometry_of(*map.plan.file->placement));
    } else if (!job.registers) {
      map.plan.sum_from_map = placed_by_world(map, maps.front());
    }
  }
}

void remark(std::vector<LookedThrough>& maps, const MergeJob& job) {
  for (std::size_t i = 0; i < maps.size(); ++i) {
    std::vector<Finding>& findings = maps[i].plan.findings;
    if (auto found = other_association(maps[i].runs, job.options)) findings.push_back(*found);
    for (std::size_t k = 0; k < i; ++k) {
      auto found = shared_recording(maps[i].runs, maps[k].runs, maps[k].plan.file->path);
      if (found) findings.push_back(*found);
    }
  }
}

/// By what does not depend on the order in which they were given, as far as maps differ in it.
void sort_by_time(std::vector<LookedThrough>& maps) {
  std::ranges::stable_sort(maps, {}, [](const LookedThrough& map) {
    const std::string hash = map.runs.empty() ? std::string() : map.runs.back().input_hash;
    return std::tuple(map.plan.first, map.plan.last, hash);
  });
}

}  // namespace

Unexpected about_map(const MergedFile& file, Error error) {
  if (error.file.empty()) error.file = file.path.string();
  return Unexpected(std::move(error));
}

std::optional<MapFromOldMap> place_in_oldest(std::span<PlannedMap> plan) {
  std::optional<MapFromOldMap> result_from_oldest = plan.front().sum_from_map;
  const bool is_tilted = std::ranges::any_of(plan, [](const PlannedMap& map) {
    return map.sum_from_map && map.sum_from_map->isometry().linear()(2, 2) < kLeastUpright;
  });
  if (!result_from_oldest || is_tilted) return std::nullopt;
  const Eigen::Isometry3d oldest_from_result = result_from_oldest->isometry().inverse();
  for (PlannedMap& map : plan) {
    const Eigen::Isometry3d motion =
        map.sum_from_map ? oldest_from_result * map.sum_from_map->isometry() : oldest_from_result;
    map.sum_from_map = is_identity(motion) ? std::nullopt : std::optional(MapFromOldMap(motion));
  }
  return result_from_oldest;
}

Result<std::vector<PlannedMap>> plan_merge(const MergeJob& job) {
  if (job.files.size() < 2) {
    return fail(ErrorCode::kInvalidArgument,
                "must be two or more, are " + std::to_string(job.files.size()),
                "files");
  }
  std::vector<LookedThrough> maps;
  maps.reserve(job.files.size());
  for (const MergedFile& file : job.files) {
    HYPERMAP_ASSIGN_OR_RETURN(LookedThrough map, look_through(file, job));
    maps.push_back(std::move(map));
  }
  HYPERMAP_TRY(refuse_same_runs(maps));
  HYPERMAP_TRY(refuse_other_voxels(maps));
  remark(maps, job);
  place(maps, job);
  if (!job.in_order) sort_by_time(maps);
  std::vector<PlannedMap> plan;
  plan.reserve(maps.size());
  for (LookedThrough& map : maps) plan.push_back(std::move(map.plan));
  return plan;
}

}  // namespace hypermap
