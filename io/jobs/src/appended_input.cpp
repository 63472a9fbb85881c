// SPDX-License-Identifier: BSD-3-Clause
#include "appended_input.hpp"

#include "hypermap/io/archive/map_sessions.hpp"
#include "input_fingerprint.hpp"

#include <algorithm>
#include <utility>

namespace hypermap {
namespace {

/// Half of what a run may say, so that there is room for its frames.
constexpr std::uint64_t kMaxFirstIndex = std::uint64_t{1} << 61U;

Unexpected refused(std::string what, std::string field) {
  return fail(ErrorCode::kInvalidArgument, std::move(what), std::move(field));
}

/// The newest run that `is_wanted` says yes to; null when there is none.
template <class Wanted>
const Provenance* newest_run(std::span<const Provenance> runs, const Wanted& is_wanted) {
  const auto found = std::find_if(runs.rbegin(), runs.rend(), is_wanted);
  return found == runs.rend() ? nullptr : &*found;
}

/// The run whose world the input shares by name; null when nothing says so.
const Provenance* run_of_world(const std::string& world, std::span<const Provenance> runs) {
  if (world.empty()) return nullptr;
  return newest_run(runs, [&](const Provenance& run) { return run.world == world; });
}

/// Requires: `runs` not empty.
const Provenance& run_to_share(const std::string& input, std::span<const Provenance> runs) {
  const auto* same = newest_run(runs, [&](const Provenance& run) { return run.input == input; });
  return same != nullptr ? *same : runs.back();
}

Unexpected unknown_world(const std::string& world, std::span<const Provenance> runs) {
  const std::string reason = world.empty()
                                 ? "the input's description names no \"world\""
                                 : "the map holds no run of world \"" + printable(world) + "\"";
  const std::string choice =
      runs.empty()
          ? "say where it lies in the map with --transform X,Y,Z,YAW (the map does not "
            "tell how it was aligned)"
          : "say --same-world if its poses are in the world of " + printable(runs.back().input) +
                ", or where that lies in the map with --transform X,Y,Z,YAW";
  return refused(reason + "; " + choice, "--append");
}

GravityAlignment aligned_as(const Provenance& run) {
  const std::string world = run.world.empty() ? "" : " (world " + printable(run.world) + ")";
  return {run.map_from_input, "as that of " + printable(run.input) + world + " in the map"};
}

Result<GravityAlignment> placed(const MappingJob& job, const DatasetReader& dataset) {
  HYPERMAP_ASSIGN_OR_RETURN(GravityAlignment up, align_to_gravity(dataset, job.up_axis));
  up.map_from_input = MapFromInput(isometry_of(*job.placement) * up.map_from_input.isometry());
  up.explanation += ", placed as asked for";
  return up;
}

/// One after the last frame that the map tells of, by its runs and by what its objects remember.
std::uint64_t next_index(const MapArchive& map) {
  std::uint64_t next = 0;
  for (const Provenance& run : map.provenance) next = std::max(next, run.next_frame_index);
  for (const Object& object : map.objects.objects()) {
    const ObservationLogState& log = object.observation_log.state();
    for (const ObservationLogEntry& entry : log.newest)
      next = std::max(next, entry.frame_index + 1);
    for (const auto& sum : log.summaries) next = std::max(next, sum.last_frame_index + 1);
  }
  return next;
}

Unexpected mapped_already(const Provenance& run, const std::string& which) {
  return refused(which + " in the map already, by the run of " + printable(run.input) +
                     "; --force maps them once more",
                 "--append");
}

}  // namespace

Result<GravityAlignment> align_to_map(const MappingJob& job,
                                      const DatasetReader& dataset,
                                      const std::string& input_name,
                                      std::span<const Provenance> runs) {
  if (job.placement) return placed(job, dataset);
  const std::string& world = dataset.summary().world;
  const Provenance* run = run_of_world(world, runs);
  if (run == nullptr && job.same_world && !runs.empty()) run = &run_to_share(input_name, runs);
  if (run == nullptr) return unknown_world(world, runs);
  if (!job.up_axis) return aligned_as(*run);
  return refused("is that of the map for an input that shares its world", "--up");
}

Result<void> refuse_first_frame(const RgbdFrame& frame, std::span<const Provenance> runs) {
  const std::string hash = recording_hash(frame);
  const auto* run =
      newest_run(runs, [&](const Provenance& known) { return known.first_frame_hash == hash; });
  if (run == nullptr) return {};
  return mapped_already(*run, printable(frame.name) + " and maybe those after it are");
}

Result<void> refuse_input_hash(const std::string& input_hash, std::span<const Provenance> runs) {
  const auto* run =
      newest_run(runs, [&](const Provenance& known) { return known.input_hash == input_hash; });
  if (run == nullptr) return {};
  return mapped_already(*run, "the same frames are");
}

Result<void> refuse_known_session(const std::string& name, std::span<const Provenance> runs) {
  const bool is_known =
      std::ranges::any_of(runs, [&](const Provenance& run) { return run.session == name; });
  if (!is_known) return {};
  return refused("the map has a session of that name; it has " + to_string(sessions_of(runs)),
                 "--session");
}

Result<std::uint64_t> index_offset(const MapArchive& map, std::uint64_t first) {
  const std::uint64_t next = next_index(map);
  if (next > kMaxFirstIndex) {
    return fail(ErrorCode::kLimit,
                "frames would count from " + std::to_string(next) + ", must be at most 2^61",
                "next_frame_index");
  }
  return next > first ? next - first : 0;
}

std::optional<Finding> find_dropped_prior(const PlacePriorOptions& prior,
                                          std::span<const Provenance> runs) {
  if (runs.empty() || prior.source != ClassPriorKind::kNone) return std::nullopt;
  const ValueTree* before = runs.back().options.find("prior.source");
  if (before == nullptr || before->text != "places") return std::nullopt;
  return Finding{Severity::kWarning,
                 {.code = ErrorCode::kInvalidArgument,
                  .what = "is none, was places in the run of " + printable(runs.back().input) +
                          ": what stands around an object no longer counts for its class; "
                          "--places FILE goes on so",
                  .field = "prior.source"}};
}

void add_run(std::vector<Provenance>& runs, Provenance run) {
  if (runs.size() >= kMaxRuns) runs.erase(runs.begin() + 1);
  runs.push_back(std::move(run));
}

Finding forgotten_run(std::span<const Provenance> runs) {
  return {.error = {.code = ErrorCode::kLimit,
                    .what = "the map keeps " + std::to_string(kMaxRuns) + " runs, that of " +
                            printable(runs[1].input) + " is forgotten",
                    .field = "provenance"}};
}

}  // namespace hypermap
