// SPDX-License-Identifier: BSD-3-Clause
#include "many_parts.hpp"

#include "content_hash.hpp"
#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/base/stop_watch.hpp"
#include "hypermap/io/archive/provenance.hpp"
#include "hypermap/io/options/options_file.hpp"
#include "peak_memory.hpp"
#include "run_settings.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <system_error>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPartSuffix = ".hmap";
constexpr const char* kRecordSuffix = ".yaml";

std::string program_text() {
  return std::string("hypermap ") + HYPERMAP_VERSION;
}

/// Ends a job where it counts its progress.
JobProgress stopped_by(const StopCheck& stop) {
  if (!stop) return {};
  return [&stop](std::size_t, std::size_t) { return !stop(); };
}

void add_options_to(InputHash& hash, const MapOptions& options) {
  for (const OptionDescription& option : describe_options(options)) {
    hash.add(option.name);
    hash.add(option.value);
  }
}

std::string motion_text(const std::optional<MapFromOldMap>& motion) {
  if (!motion) return "none";
  std::string text;
  const Eigen::Matrix4d matrix = motion->isometry().matrix();
  for (const double number : matrix.reshaped()) text.append(number_text(number)).append(" ");
  return text;
}

std::vector<std::string> texts_of(const MappingReport& report) {
  std::vector<std::string> texts;
  for (const Error& skipped : report.skipped) texts.push_back(to_string(skipped));
  for (const Finding& finding : report.findings) texts.push_back(to_string(finding.error));
  return kept_findings(std::move(texts));
}

std::vector<std::string> texts_of(const MergeReport& report) {
  std::vector<std::string> texts;
  for (const Finding& finding : report.findings) texts.push_back(to_string(finding.error));
  return kept_findings(std::move(texts));
}

PartCounts counts_of(const MappingReport& report) {
  return {.frames = report.num_frames,
          .skipped = report.skipped.size(),
          .objects = report.num_objects,
          .tentative = report.num_tentative,
          .sessions = 1,
          .leaves = report.leaves};
}

/// Frames are counted where they were mapped.
PartCounts counts_of(const MergeReport& report) {
  return {.objects = report.num_objects,
          .tentative = report.num_tentative,
          .sessions = report.num_sessions,
          .leaves = report.leaves};
}

/// One half of a merge: a map that was planned, or the map of another node.
struct MergeHalf {
  MergedFile file = {};
  PlannedMap map = {};
};

template <class Choose>
std::optional<Stamp> stamp_of_all(std::span<const PlannedMap> maps,
                                  std::optional<Stamp> PlannedMap::*stamp,
                                  const Choose& choose) {
  std::optional<Stamp> chosen = maps.front().*stamp;
  for (const PlannedMap& map : maps) {
    if (!chosen || !(map.*stamp)) return std::nullopt;
    chosen = choose(*chosen, *(map.*stamp));
  }
  return chosen;
}

/// The map of a node as it will be added: it lies in the frame of the whole.
PlannedMap planned_node(std::span<const PlannedMap> maps) {
  PlannedMap whole;
  const auto min = [](Stamp a, Stamp b) { return std::min(a, b); };
  const auto max = [](Stamp a, Stamp b) { return std::max(a, b); };
  whole.first = stamp_of_all(maps, &PlannedMap::first, min);
  whole.last = stamp_of_all(maps, &PlannedMap::last, max);
  for (const PlannedMap& map : maps) {
    whole.num_sessions += map.num_sessions;
    whole.has_stack = whole.has_stack || map.has_stack;
  }
  return whole;
}

}  // namespace

PartFiles ManyParts::part_files(std::size_t sequence) const {
  const std::string& name = job_.sequences[sequence].name;
  return {.part = job_.parts / (name + kPartSuffix), .record = job_.parts / (name + kRecordSuffix)};
}

PartFiles ManyParts::node_files(const MergeNode& node) const {
  const std::string name = std::to_string(node.begin) + "-" + std::to_string(node.end);
  return {.part = merging_folder() / (name + kPartSuffix),
          .record = merging_folder() / (name + kRecordSuffix)};
}

MappingJob ManyParts::mapping_job_of(std::size_t sequence) const {
  const ListedSequence& listed = job_.sequences[sequence];
  MappingJob job = job_.mapping;
  job.input = listed.input;
  job.output = part_files(sequence).part;
  job.dataset.description = listed.description;
  job.dataset.detections = listed.detections;
  job.dataset.detector_names = listed.detector_names;
  job.poses = listed.poses;
  if (listed.up_axis) job.up_axis = listed.up_axis;
  job.session = listed.is_named ? std::optional(listed.name) : std::nullopt;
  job.append = false;
  job.same_world = false;
  job.placement.reset();
  job.checkpoint_every = 0;
  job.resume = false;
  return job;
}

MapOptions ManyParts::map_options() const {
  return {.mapper = job_.mapping.mapper, .layers = job_.mapping.layers};
}

Result<PartRecipe> ManyParts::recipe_of_part(std::size_t sequence) const {
  const MappingJob job = mapping_job_of(sequence);
  const std::array left_out{job_.output, job_.parts};
  PartRecipe recipe{.program = program_text(), .input = {}, .settings = {}};
  HYPERMAP_ASSIGN_OR_RETURN(recipe.input, folder_hash(job.input, left_out, job.stop));
  HYPERMAP_ASSIGN_OR_RETURN(const ValueTree settings, asked_settings(job));
  InputHash hash;
  for (const auto& [name, value] : settings.entries) {
    hash.add(name);
    hash.add(value.text);
  }
  hash.add(number_text(job.max_skipped_share));
  hash.add(job.strict ? "strict" : "");
  add_options_to(hash, map_options());
  recipe.settings = hash.text();
  return recipe;
}

std::string ManyParts::settings_text() const {
  InputHash hash;
  hash.add(program_text());
  hash.add(job_.in_order ? "in order" : "");
  add_options_to(hash, map_options());
  return hash.text();
}

PartRecipe ManyParts::recipe_of_node(const ManyPlan& plan, const MergeNode& node) const {
  InputHash input;
  for (std::size_t i = node.begin; i < node.end; ++i) {
    input.add(plan.contents[i]);
    input.add(motion_text(plan.maps[i].sum_from_map));
  }
  return {.program = program_text(), .input = input.text(), .settings = settings_text()};
}

Result<std::string> ManyParts::make_part(std::size_t sequence) const {
  const PartFiles files = part_files(sequence);
  HYPERMAP_ASSIGN_OR_RETURN(const PartRecipe recipe, recipe_of_part(sequence));
  const auto reason = job_.force ? std::optional<std::string>("") : reason_to_make(files, recipe);
  if (!reason) return "kept";
  const MappingJob job = mapping_job_of(sequence);
  HYPERMAP_ASSIGN_OR_RETURN(const MappingReport report, run_mapping(job, stopped_by(job.stop)));
  HYPERMAP_TRY(save_part_record(files,
                                {.recipe = recipe,
                                 .content = {},
                                 .counts = counts_of(report),
                                 .findings = texts_of(report)}));
  std::error_code still_there;
  fs::remove(rescue_path(files.part), still_there);  // of an earlier run, superseded
  return reason->empty() ? "made" : "made anew: " + *reason;
}

Result<std::unique_ptr<ManyPlan>> ManyParts::new_plan() const {
  auto plan = std::make_unique<ManyPlan>();
  plan->job = {.files = {},
               .in_order = job_.in_order,
               .options = map_options(),
               .limits = job_.mapping.limits,
               .stop = job_.mapping.stop};
  std::vector<std::string> contents;
  for (std::size_t i = 0; i < job_.sequences.size(); ++i) {
    const PartFiles files = part_files(i);
    plan->job.files.push_back({.path = files.part, .placement = job_.sequences[i].placement});
    HYPERMAP_ASSIGN_OR_RETURN(PartRecord record, read_part_record(files.record));
    contents.push_back(std::move(record.content));
  }
  HYPERMAP_ASSIGN_OR_RETURN(plan->maps, plan_merge(plan->job));
  for (const PlannedMap& map : plan->maps) {
    plan->contents.push_back(contents[static_cast<std::size_t>(map.file - plan->job.files.data())]);
  }
  plan->nodes = merge_tree(plan->maps.size());
  return plan;
}

Result<const ManyPlan*> ManyParts::plan() {
  const std::scoped_lock lock(mutex_);
  if (!plan_) {
    HYPERMAP_ASSIGN_OR_RETURN(plan_, new_plan());
  }
  return plan_.get();
}

bool ManyParts::must_make(const ManyPlan& plan, const MergeNode& node) const {
  return job_.force || reason_to_make(node_files(node), recipe_of_node(plan, node)).has_value();
}

bool ManyParts::is_in_place(const ManyPlan& plan) const {
  const MergeNode& whole = plan.nodes.back();
  const PartFiles files{.part = job_.output, .record = node_files(whole).record};
  return !job_.force && !reason_to_make(files, recipe_of_node(plan, whole)).has_value();
}

void ManyParts::remove_node_files(const ManyPlan& plan,
                                  const std::optional<std::size_t>& node) const {
  if (!node) return;
  const PartFiles files = node_files(plan.nodes[*node]);
  std::error_code still_there;  // is cleared away with the rest, or told then
  fs::remove(files.part, still_there);
  fs::remove(files.record, still_there);
}

Result<std::string> ManyParts::make_node(std::size_t index) {
  HYPERMAP_ASSIGN_OR_RETURN(const ManyPlan* plan, this->plan());
  const MergeNode& node = plan->nodes[index];
  const auto half =
      [&](std::size_t begin, std::size_t end, const std::optional<std::size_t>& made) {
        const std::span maps = std::span(plan->maps).subspan(begin, end - begin);
        if (!made) return MergeHalf{.file = *maps.front().file, .map = maps.front()};
        return MergeHalf{.file = {.path = node_files(plan->nodes[*made]).part},
                         .map = planned_node(maps)};
      };
  const MergeHalf left = half(node.begin, node.middle, node.left);
  const MergeHalf right = half(node.middle, node.end, node.right);
  std::array halves{left.map, right.map};
  halves[0].file = &left.file;
  halves[1].file = &right.file;
  HYPERMAP_ASSIGN_OR_RETURN(const MergeResult merged,
                            merge_planned(halves, plan->job, stopped_by(plan->job.stop)));
  const PartFiles files = node_files(node);
  HYPERMAP_TRY(
      save_archive(merged.map,
                   files.part,
                   {.limits = plan->job.limits, .num_threads = job_.mapping.mapper.num_threads}));
  HYPERMAP_TRY(save_part_record(files,
                                {.recipe = recipe_of_node(*plan, node),
                                 .content = {},
                                 .counts = counts_of(merged.report),
                                 .findings = texts_of(merged.report)}));
  remove_node_files(*plan, node.left);
  remove_node_files(*plan, node.right);
  return "made";
}

TaskOutcome ManyParts::do_task(std::size_t number) {
  StopWatch watch;
  const std::size_t num_sequences = job_.sequences.size();
  const auto made = guarded(ErrorCode::kUnavailable, "the map", [&] {
    return number < num_sequences ? make_part(number) : make_node(number - num_sequences);
  });
  TaskOutcome outcome{.number = number};
  if (made) outcome.note = *made;
  if (!made) outcome.error = made.error();
  outcome.wall_s = watch.elapsed_s();
  outcome.peak_rss_bytes = peak_rss_bytes();
  return outcome;
}

}  // namespace hypermap
