// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/listed_evaluation_job.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/evaluation/instance_sightings.hpp"
#include "hypermap/io/archive/listed_instances_file.hpp"
#include "hypermap/io/archive/map_sessions.hpp"
#include "listed_evaluation.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace hypermap {
namespace {

/// Where the sequence lies in the map.
Result<MapFromInput> place_of_sequence(const MapArchive& map,
                                       const ListedEvaluationJob& job,
                                       ListedEvaluation& outcome) {
  const std::string& sequence = outcome.listed.sequence;
  std::vector<Provenance> runs = map.provenance;
  std::erase_if(runs, is_import);
  const auto run = std::find_if(
      runs.rbegin(), runs.rend(), [&](const Provenance& one) { return one.input == sequence; });
  if (run != runs.rend()) return run->map_from_input;
  Error error{.code = ErrorCode::kNotFound,
              .what = "no run of the map is of the sequence " + printable(sequence),
              .file = job.map.string(),
              .entry = "provenance.yaml"};
  if (runs.size() != 1) {
    error.what += runs.empty() ? ": it has no provenance" : ", and it has several";
    return Unexpected(std::move(error));
  }
  error.what += ", taken is the only one, of " + printable(runs.front().input);
  outcome.findings.push_back({Severity::kWarning, std::move(error)});
  return runs.front().map_from_input;
}

Result<void> take_objects(const EvaluatedArchive& map,
                          const ListedEvaluationJob& job,
                          ListedEvaluation& outcome) {
  outcome.objects.reserve(map.objects.size());
  outcome.object_ids.reserve(map.objects.size());
  for (std::size_t i = 0; i < map.objects.size(); ++i) {
    const auto& box = map.objects[i].box;
    if (!box || !(box->extent().minCoeff() > 0.0) ||
        map.ids[i] > std::numeric_limits<std::uint32_t>::max()) {
      return Unexpected(Error{
          .code = ErrorCode::kUnsupported,
          .what = "object " + std::to_string(map.ids[i]) + " must have a box with positive sides",
          .file = job.map.string(),
          .field = job.layer});
    }
    outcome.objects.push_back({map.objects[i].class_name, *box});
    outcome.object_ids.push_back(ObjectId{static_cast<std::uint32_t>(map.ids[i])});
  }
  return {};
}

/// The list with every name that means a class of it.
ListedInstances with_aliases(ListedInstances listed, const ClassVocabulary& vocabulary) {
  for (ListedInstance& instance : listed.instances) {
    std::vector<std::string> aliases;
    for (const std::string& name : instance.class_names) {
      for (std::string& one : vocabulary.same_names(name)) aliases.push_back(std::move(one));
    }
    instance.class_names.insert(instance.class_names.end(), aliases.begin(), aliases.end());
  }
  return listed;
}

Result<void> count_frames_named(const ListedEvaluationJob& job,
                                const ListedInstances& understood,
                                ListedEvaluation& outcome) {
  ClassRegistry classes;
  DatasetOptions options = job.frames->dataset;
  options.read_color = false;
  HYPERMAP_ASSIGN_OR_RETURN(const auto dataset, open_dataset(job.frames->input, options, classes));
  if (dataset->summary().num_detections == 0) {
    return Unexpected(Error{.code = ErrorCode::kMalformedFile,
                            .what = "must have detections, to count the frames that name a thing",
                            .file = job.frames->input.string()});
  }
  InstanceSightings sightings(understood);
  for (std::size_t i = 0; i < dataset->size(); ++i) {
    if (job.stop && job.stop())
      return fail(ErrorCode::kInterrupted, "interrupted while frames were counted");
    const auto frame = dataset->read(i);
    if (frame) {
      sightings.add(*frame, classes);
      ++outcome.num_frames;
    } else {
      outcome.findings.push_back({Severity::kWarning, frame.error()});
    }
  }
  outcome.frames_named = sightings.frames_named();
  return {};
}

InstanceStanding standing_of(std::size_t t,
                             const ListedInstances& understood,
                             const ListedEvaluation& outcome,
                             const ClassRegistry& known) {
  const ListedInstance& instance = understood.instances[t];
  const bool has_word = std::any_of(
      instance.class_names.begin(), instance.class_names.end(), [&](const std::string& name) {
        return known.find(name).has_value();
      });
  if (!has_word) return InstanceStanding::kNoWord;
  if (instance.has_no_depth) return InstanceStanding::kNoDepth;
  if (instance.is_never_whole) return InstanceStanding::kNeverWhole;
  if (instance.is_far) return InstanceStanding::kFar;
  const bool is_rare = !outcome.frames_named.empty() && outcome.frames_named[t] < kMinFramesNamed;
  return is_rare ? InstanceStanding::kRarelySeen : InstanceStanding::kCounts;
}

}  // namespace

Result<ListedEvaluation> evaluate_listed(const EvaluatedArchive& map,
                                         const ListedInstances& listed,
                                         const ListedEvaluationJob& job) {
  ListedEvaluation outcome{.listed = listed};
  HYPERMAP_ASSIGN_OR_RETURN(outcome.map_from_input, place_of_sequence(map.archive, job, outcome));
  HYPERMAP_TRY(take_objects(map, job, outcome));
  const ListedInstances understood =
      with_aliases(outcome.listed, job.vocabulary.value_or(map.archive.vocabulary));
  if (job.frames) HYPERMAP_TRY(count_frames_named(job, understood, outcome));
  outcome.instances.reserve(outcome.listed.instances.size());
  for (std::size_t t = 0; t < outcome.listed.instances.size(); ++t) {
    const ListedInstance& instance = understood.instances[t];
    outcome.instances.push_back(
        {.class_names = instance.class_names,
         .box = box_in_map(instance, outcome.listed.up_in_input, outcome.map_from_input),
         .standing = standing_of(t, understood, outcome, map.archive.classes)});
  }
  outcome.comparison = compare_instances(outcome.objects, outcome.instances, job.options);
  return outcome;
}

Result<ListedEvaluation> run_listed_evaluation(const ListedEvaluationJob& job) {
  HYPERMAP_TRY(validate(job.options));
  HYPERMAP_ASSIGN_OR_RETURN(const ListedInstances listed, load_listed_instances(job.truth));
  HYPERMAP_ASSIGN_OR_RETURN(
      const auto map,
      load_evaluated(job.map, {.layer = job.layer, .limits = job.limits, .stop = job.stop}));
  return evaluate_listed(map, listed, job);
}

}  // namespace hypermap
