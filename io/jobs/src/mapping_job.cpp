// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/mapping_job.hpp"

#include "frame_stream.hpp"
#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/base/stop_watch.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/dataset/corrected_poses.hpp"
#include "hypermap/io/dataset/gravity_alignment.hpp"
#include "hypermap/io/options/options_file.hpp"
#include "input_fingerprint.hpp"

#include <sys/resource.h>

#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

std::size_t peak_rss_bytes() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024U;
}

/// What a run needs besides the job: everything is opened before the first frame is mapped.
struct Run {
  ClassRegistry classes;
  std::optional<MapArchive> previous;
  std::unique_ptr<DatasetReader> dataset;
  std::optional<OnnxDetector> detector;
  std::optional<SemanticMapper> mapper;
  InputFingerprint fingerprint;
};

/// Names of no class that the input speaks of: they may be misspelt.
std::vector<Finding> unknown_names(std::span<const std::string> names,
                                   const char* option,
                                   const ClassRegistry& classes) {
  std::vector<Finding> findings;
  for (const std::string& name : names) {
    if (classes.find(name)) continue;
    findings.push_back({.error = {.code = ErrorCode::kNotFound,
                                  .what = "no class of the input is called \"" + printable(name) +
                                          "\"" + did_you_mean(name, classes.names()),
                                  .field = option}});
  }
  return findings;
}

void append(std::vector<Finding>& findings, std::vector<Finding> more) {
  std::move(more.begin(), more.end(), std::back_inserter(findings));
}

/// Classes that the options name are known even when no detection is ever of them.
Result<void> add_named_classes(const SemanticMapperOptions& options, ClassRegistry& classes) {
  for (const std::string& name : options.objects.transient_class_names) {
    HYPERMAP_TRY(classes.add(name));
  }
  for (const std::string& name : options.wanted_class_names) HYPERMAP_TRY(classes.add(name));
  return {};
}

Result<std::optional<OnnxDetector>> load_detector(const MappingJob& job, ClassRegistry& classes) {
  if (!job.model) return std::optional<OnnxDetector>();
  OnnxDetectorOptions options = job.detector;
  options.detector = DetectorId{static_cast<std::uint32_t>(job.dataset.detections.size()) + 1};
  HYPERMAP_ASSIGN_OR_RETURN(OnnxDetector detector,
                            OnnxDetector::load(*job.model, options, classes));
  return std::optional<OnnxDetector>(std::move(detector));
}

Result<SemanticMapper> make_mapper(const MappingJob& job,
                                   ClassRegistry& classes,
                                   const std::optional<MapArchive>& previous) {
  HYPERMAP_TRY(add_named_classes(job.mapper, classes));
  if (!previous) return SemanticMapper::create(job.mapper, classes);
  if (!previous->octree) {
    return fail(ErrorCode::kUnsupported, "has no semantic octree to go on from", "--append");
  }
  return SemanticMapper::resume(job.mapper, *previous->octree, previous->objects, classes);
}

/// With a network at work, detections beside the data are read only when they were asked for.
DatasetOptions dataset_options(const MappingJob& job) {
  DatasetOptions options = job.dataset;
  options.read_color = options.read_color && job.model.has_value();
  if (job.model) options.find_detections = false;
  return options;
}

/// A map does not depend on the clock.
Result<void> refuse_deadline(const DeadlineOptions& options) {
  if (options.rule == DeadlineRule::kNone) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be none: what is mapped from a dataset may not depend on the clock",
              "deadline.rule");
}

Result<void> refuse_mixed_poses(const MappingJob& job) {
  if (!job.poses || !job.append) return {};
  return fail(ErrorCode::kInvalidArgument,
              "a map is built anew with corrected poses, what it holds has the old ones",
              "append");
}

Result<Run> open(const MappingJob& job, MappingReport& report) {
  HYPERMAP_TRY(refuse_deadline(job.mapper.deadline));
  HYPERMAP_TRY(refuse_mixed_poses(job));
  Run run;
  if (job.append) {
    HYPERMAP_ASSIGN_OR_RETURN(auto loaded, load_archive(job.output));
    run.classes = loaded.value.classes;
    run.previous = std::move(loaded.value);
  }
  HYPERMAP_ASSIGN_OR_RETURN(run.detector, load_detector(job, run.classes));
  HYPERMAP_ASSIGN_OR_RETURN(run.dataset,
                            open_dataset(job.input, dataset_options(job), run.classes));
  if (job.poses) {
    HYPERMAP_ASSIGN_OR_RETURN(run.dataset,
                              with_corrected_poses(std::move(run.dataset), *job.poses));
  }
  report.findings = run.dataset->summary().findings;
  HYPERMAP_ASSIGN_OR_RETURN(const GravityAlignment up, align_to_gravity(*run.dataset, job.up_axis));
  run.dataset->set_map_from_input(up.map_from_input);
  report.up = up.explanation;
  append(report.findings,
         unknown_names(job.mapper.objects.transient_class_names, "transient_classes", run.classes));
  append(report.findings,
         unknown_names(job.mapper.wanted_class_names, "wanted_classes", run.classes));
  HYPERMAP_ASSIGN_OR_RETURN(auto mapper, make_mapper(job, run.classes, run.previous));
  run.mapper.emplace(std::move(mapper));
  return run;
}

void count(const FrameReport& frame, MappingReport& report) {
  ++report.num_frames;
  report.num_detections += frame.num_detections;
  report.num_segments += frame.num_segments;
  report.num_visibility_skipped += frame.visibility_evaluated ? 0U : 1U;
  report.points.num_hits += frame.integration.num_hits;
  report.points.num_beyond_range += frame.integration.num_beyond_range;
  report.points.num_not_measured += frame.integration.num_not_measured;
  report.points.num_not_finite += frame.integration.num_not_finite;
  report.points.num_outside_volume += frame.integration.num_outside_volume;
  report.seconds.segment += frame.seconds.segment;
  report.seconds.associate += frame.seconds.associate;
  report.seconds.integrate += frame.seconds.integrate;
  report.seconds.visibility += frame.seconds.visibility;
}

/// What is wrong with one frame, named; what is wrong with the machine ends the job.
bool spares_other_frames(const Error& error) {
  return error.code != ErrorCode::kOutOfMemory && error.code != ErrorCode::kUnavailable;
}

Error about(Error error, const std::string& frame_name) {
  if (error.file.empty()) error.file = frame_name;
  return error;
}

Result<void> add_detections(RgbdFrame& frame, std::optional<OnnxDetector>& detector) {
  if (!detector || frame.color.empty()) return {};
  HYPERMAP_ASSIGN_OR_RETURN(auto found, detector->detect(frame.color));
  frame.detections.insert(frame.detections.end(),
                          std::make_move_iterator(found.begin()),
                          std::make_move_iterator(found.end()));
  return {};
}

Result<FrameReport> map_frame(Run& run, Result<RgbdFrame> frame, MappingReport& report) {
  if (!frame) return Unexpected(std::move(frame).error());
  StopWatch watch;
  HYPERMAP_TRY(add_detections(*frame, run.detector));
  report.seconds.detect += watch.lap();
  HYPERMAP_ASSIGN_OR_RETURN(FrameReport done, run.mapper->integrate(*frame));
  run.fingerprint.add(*frame);
  return done;
}

Result<void> map_frames(Run& run,
                        const MappingJob& job,
                        MappingReport& report,
                        const JobProgress& progress) {
  FrameStream stream(*run.dataset, job.mapper.num_threads > 1);
  const std::size_t total = run.dataset->size();
  for (std::size_t i = 0; i < total; ++i) {
    StopWatch watch;
    auto frame = stream.next();
    report.seconds.read += watch.lap();
    const auto done = map_frame(run, std::move(frame), report);
    if (done) {
      count(*done, report);
    } else if (spares_other_frames(done.error())) {
      report.skipped.push_back(about(done.error(), std::string(run.dataset->frame_name(i))));
    } else {
      return Unexpected(done.error());
    }
    if (progress && !progress(i + 1, total)) return interrupted();
  }
  return {};
}

Result<void> check_losses(const MappingReport& report, const MappingJob& job) {
  const std::size_t total = report.num_frames + report.skipped.size();
  const auto allowed = job.max_skipped_share * static_cast<double>(total);
  if (report.num_frames > 0 && static_cast<double>(report.skipped.size()) <= allowed) return {};
  Error error{.code = ErrorCode::kLimit,
              .what = std::to_string(report.skipped.size()) + " of " + std::to_string(total) +
                      " frames could not be used, more than the share of " +
                      std::to_string(job.max_skipped_share) + " that is allowed",
              .file = job.input.string()};
  if (!report.skipped.empty()) error.what += "; the first: " + to_string(report.skipped.front());
  return Unexpected(std::move(error));
}

/// Every option by name, as an options file would say it.
ValueTree options_tree(const MapOptions& options) {
  std::vector<ValueTree::Entry> entries;
  for (const OptionDescription& option : describe_options(options)) {
    entries.emplace_back(option.name, make_text(option.value));
  }
  return make_map(std::move(entries));
}

Provenance provenance(const Run& run, const MappingJob& job) {
  return {.tool = std::string("hypermap ") + HYPERMAP_VERSION,
          .input = printable(
              std::filesystem::absolute(job.input).lexically_normal().filename().string()),
          .input_hash = run.fingerprint.text(),
          .options = options_tree({job.mapper, job.layers}),
          .map_from_input = run.dataset->map_from_input()};
}

Result<MapArchive> make_archive(Run& run, const MappingJob& job) {
  MapArchive archive = run.previous ? std::move(*run.previous) : MapArchive{};
  archive.classes = run.classes;
  archive.octree = run.mapper->octree();
  archive.objects = run.mapper->objects();
  archive.provenance = provenance(run, job);
  HYPERMAP_TRY(derive_layers(archive, job.mapper.objects, job.layers));
  return archive;
}

void describe(const MapArchive& archive, const MappingJob& job, MappingReport& report) {
  const auto confirmed = confirmed_objects(archive.objects, job.mapper.objects.confirmation);
  report.num_objects = confirmed.size();
  report.num_tentative = archive.objects.size() - confirmed.size();
  report.leaves = archive.octree->num_leaves();
  report.num_threads = job.mapper.num_threads;
  report.peak_rss_bytes = peak_rss_bytes();
}

}  // namespace

Result<MappingReport> run_mapping(const MappingJob& job, const JobProgress& progress) {
  MappingReport report;
  StopWatch whole;
  HYPERMAP_TRY(check_target(job.output));
  HYPERMAP_ASSIGN_OR_RETURN(Run run, open(job, report));
  HYPERMAP_TRY(map_frames(run, job, report, progress));
  HYPERMAP_TRY(check_losses(report, job));
  StopWatch watch;
  HYPERMAP_ASSIGN_OR_RETURN(const MapArchive archive, make_archive(run, job));
  report.seconds.project = watch.lap();
  HYPERMAP_TRY(save_archive(archive, job.output));
  report.seconds.write = watch.lap();
  describe(archive, job, report);
  report.seconds.wall = whole.lap();
  return report;
}

}  // namespace hypermap
