// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/combiner_job.hpp"

#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/segmentation/stacking.hpp"
#include "hypermap/core/segmentation/trained_combiner.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/combiner/combiner_file.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kHeldOutEvery = 5;

Result<void> check(const CombinerJob& job) {
  if (job.dataset.detections.empty()) {
    return fail(ErrorCode::kInvalidArgument, "must name the detectors' files", "detections");
  }
  if (job.min_overlap >= 0.1 && job.min_overlap <= 1.0) return check_target(job.output);
  return fail(ErrorCode::kInvalidArgument,
              "must be in 0.1 .. 1, is " + number_text(job.min_overlap),
              "min_overlap");
}

/// The same frames twice: with what detectors say, and with what is there.
struct LabelledFrames {
  ClassRegistry classes;
  std::size_t num_known = 0;  ///< Classes that detectors know; those behind are the labels' alone.
  std::unique_ptr<DatasetReader> words;
  std::unique_ptr<DatasetReader> labels;
};

Result<LabelledFrames> open_frames(const CombinerJob& job) {
  LabelledFrames frames;
  DatasetOptions options = job.dataset;
  options.read_color = false;
  HYPERMAP_ASSIGN_OR_RETURN(frames.words, open_dataset(job.input, options, frames.classes));
  frames.num_known = frames.classes.size();
  options.detections = {job.labels};
  options.detector_names = {};
  HYPERMAP_ASSIGN_OR_RETURN(frames.labels, open_dataset(job.input, options, frames.classes));
  return frames;
}

/// What is there, by the label that the box fits best.
std::optional<ClassId> truth_of(const PixelBox& box_px,
                                std::span<const Detection> labels,
                                double min_overlap) {
  const Detection* best = nullptr;
  double best_overlap = min_overlap;
  for (const Detection& label : labels) {
    const double overlap = intersection_over_union(box_px, label.box_px);
    if (overlap < best_overlap || (best != nullptr && overlap == best_overlap)) continue;
    best = &label;
    best_overlap = overlap;
  }
  if (best == nullptr) return std::nullopt;
  return best_class(best->class_scores)->id;
}

struct Examples {
  std::vector<CombinerExample> learnt;
  std::vector<CombinerExample> held_out;
};

void add_examples(const LabelledFrames& frames,
                  const RgbdFrame& words,
                  const RgbdFrame& labels,
                  double min_overlap,
                  Examples& examples,
                  CombinerJobReport& report) {
  const bool is_held_out = report.num_frames % kHeldOutEvery == kHeldOutEvery - 1;
  std::vector<CombinerExample>& into = is_held_out ? examples.held_out : examples.learnt;
  for (const auto& group : group_detections(words.detections, min_overlap)) {
    const auto truth = truth_of(group.front()->box_px, labels.detections, min_overlap);
    if (!truth || truth->value >= frames.num_known) {
      ++report.num_unlabelled;
      continue;
    }
    CombinerExample example{.likelihoods = {}, .detectors = {}, .truth = *truth};
    for (const Detection* detection : group) {
      example.likelihoods.push_back(detection->class_scores);
      example.detectors.push_back(detection->detector);
    }
    into.push_back(std::move(example));
  }
}

Result<Examples> collect_examples(const LabelledFrames& frames,
                                  const CombinerJob& job,
                                  CombinerJobReport& report,
                                  const JobProgress& progress) {
  Examples examples;
  for (std::size_t i = 0; i < frames.words->size(); ++i) {
    const auto words = frames.words->read(i);
    const auto labels = words ? frames.labels->read(i) : words;
    if (labels) {
      add_examples(frames, *words, *labels, job.min_overlap, examples, report);
      ++report.num_frames;
    } else {
      report.skipped.push_back(labels.error());
    }
    if (progress && !progress(i + 1, frames.words->size())) return interrupted();
  }
  report.num_examples = examples.learnt.size();
  report.num_held_out = examples.held_out.size();
  return examples;
}

void count_naming(NamingScore& score, std::span<const ClassEvidence> said, ClassId truth) {
  ++score.num_named;
  if (best_class(said)->id == truth) ++score.num_right;
}

/// Each detector alone, on what it speaks of.
std::vector<NamingScore> scores_alone(std::span<const CombinerExample> examples,
                                      const DetectorRegistry& detectors) {
  std::vector<NamingScore> scores;
  for (const std::string& name : detectors.names()) scores.push_back({.name = name});
  for (const CombinerExample& example : examples) {
    for (std::size_t i = 0; i < example.detectors.size(); ++i) {
      count_naming(scores[example.detectors[i].value], example.likelihoods[i], example.truth);
    }
  }
  return scores;
}

Result<NamingScore> score_of(std::string name,
                             std::span<const CombinerExample> examples,
                             const StackingOptions& options,
                             const StackingModel& model) {
  NamingScore score{.name = std::move(name)};
  for (const CombinerExample& example : examples) {
    HYPERMAP_ASSIGN_OR_RETURN(
        const auto combined,
        combine_class_scores(example.likelihoods, example.detectors, options, model));
    count_naming(score, combined, example.truth);
  }
  return score;
}

Result<void> compare_rules(const CombinerModel& model,
                           LabelledFrames& frames,
                           std::span<const CombinerExample> held_out,
                           CombinerJobReport& report) {
  const DetectorRegistry& detectors = frames.words->summary().detectors;
  report.scores = scores_alone(held_out, detectors);
  HYPERMAP_ASSIGN_OR_RETURN(const auto combiner,
                            TrainedCombiner::bind(model, detectors, frames.classes));
  const StackingModel trained{.weights = {}, .combiner = combiner};
  for (const auto& [name, rule] : {std::pair("sum", StackingRule::kSum),
                                   {"product", StackingRule::kProduct},
                                   {"trained", StackingRule::kTrained}}) {
    HYPERMAP_ASSIGN_OR_RETURN(NamingScore score, score_of(name, held_out, {.rule = rule}, trained));
    report.scores.push_back(std::move(score));
  }
  return {};
}

}  // namespace

Result<CombinerJobReport> train_combiner_job(const CombinerJob& job, const JobProgress& progress) {
  HYPERMAP_TRY(check(job));
  CombinerJobReport report;
  HYPERMAP_ASSIGN_OR_RETURN(LabelledFrames frames, open_frames(job));
  for (const DatasetReader* reader : {frames.words.get(), frames.labels.get()}) {
    const std::vector<Finding>& findings = reader->summary().findings;
    report.findings.insert(report.findings.end(), findings.begin(), findings.end());
  }
  HYPERMAP_ASSIGN_OR_RETURN(const Examples examples,
                            collect_examples(frames, job, report, progress));
  HYPERMAP_ASSIGN_OR_RETURN(
      const CombinerModel model,
      train_combiner(
          examples.learnt, frames.words->summary().detectors, frames.classes, job.training));
  for (const OneAgainstAll& rule : model.classes) report.classes.push_back(rule.class_name);
  HYPERMAP_TRY(compare_rules(model, frames, examples.held_out, report));
  HYPERMAP_TRY(write_file_atomically(job.output, write_combiner(model)));
  return report;
}

}  // namespace hypermap
