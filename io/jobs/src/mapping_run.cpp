// SPDX-License-Identifier: BSD-3-Clause
#include "mapping_run.hpp"

#include "appended_input.hpp"
#include "hypermap/core/base/stop_watch.hpp"
#include "hypermap/io/dataset/corrected_poses.hpp"
#include "hypermap/io/dataset/gravity_alignment.hpp"
#include "hypermap/io/dataset/reading_check.hpp"
#include "hypermap/io/options/options_file.hpp"
#include "known_detectors.hpp"
#include "map_agreement.hpp"
#include "mapping_job_checks.hpp"
#include "resumed_run.hpp"
#include "run_settings.hpp"
#include "run_vocabulary.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

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

Result<std::optional<OnnxDetector>> load_detector(const MappingJob& job,
                                                  ClassRegistry& classes,
                                                  DetectorRegistry& detectors) {
  if (!job.model) return std::optional<OnnxDetector>();
  OnnxDetectorOptions options = job.detector;
  options.num_threads = job.mapper.num_threads;
  HYPERMAP_ASSIGN_OR_RETURN(OnnxDetector detector,
                            OnnxDetector::load(*job.model, options, classes));
  HYPERMAP_ASSIGN_OR_RETURN(const DetectorId id,
                            detectors.add(described_network(*job.model, options, detector.form())));
  detector.set_id(id);
  return std::optional<OnnxDetector>(std::move(detector));
}

Result<SemanticMapper> make_mapper(const SemanticMapperOptions& options,
                                   const ClassRegistry& classes,
                                   const MapArchive* map) {
  if (map == nullptr) return SemanticMapper::create(options, classes);
  if (!map->octree) {
    return fail(ErrorCode::kUnsupported, "has no semantic octree to go on from", "--append");
  }
  return SemanticMapper::resume(options, *map->octree, map->objects, classes, map->topological_map);
}

/// The mapper of a run that begins, or of one that goes on where `saved` ended. The options name
/// classes as they are called.
Result<SemanticMapper> open_mapper(MappingRun& run,
                                   const MappingJob& job,
                                   const SemanticMapperOptions& options,
                                   const std::optional<SavedRun>& saved,
                                   MappingReport& report) {
  HYPERMAP_TRY(add_named_classes(options, run.classes));
  if (!saved) return make_mapper(options, run.classes, run.previous ? &*run.previous : nullptr);
  HYPERMAP_TRY(refuse_other_run(run, job, *saved));
  take_over(run, *saved, report);
  return make_mapper(options, run.classes, &saved->map);
}

/// With a network at work, detections beside the data are read only when they were asked for.
DatasetOptions dataset_options(const MappingJob& job) {
  DatasetOptions options = job.dataset;
  options.read_color = options.read_color && (job.model.has_value() || job.keep_views);
  if (job.model) options.find_detections = false;
  return options;
}

/// Every option by name, as an options file would say it, and what the map is made with besides.
ValueTree options_tree(const MapOptions& options, std::span<const ValueTree::Entry> companions) {
  std::vector<ValueTree::Entry> entries;
  for (const OptionDescription& option : describe_options(options)) {
    entries.emplace_back(option.name, make_text(option.value));
  }
  entries.insert(entries.end(), companions.begin(), companions.end());
  return make_map(std::move(entries));
}

Result<GravityAlignment> align(const MappingRun& run, const MappingJob& job) {
  if (!run.previous) return align_to_gravity(*run.dataset, job.up_axis);
  return align_to_map(job, *run.dataset, run.input_name, run.previous->provenance);
}

void note(std::optional<Finding> finding, const MappingJob& job, MappingReport& report) {
  if (!finding) return;
  finding->error.file = job.input.string();
  report.findings.push_back(std::move(*finding));
}

/// Why the input could not be aligned, with what is behind it.
Error explained(Error error,
                const std::optional<Finding>& misreading,
                const DatasetReader& dataset) {
  if (misreading) {
    error.what += "; " + to_string(misreading->error);
  } else if (const auto first = dataset.read(0); !first) {
    error.what += "; " + to_string(first.error());
  }
  return error;
}

/// Aligns the input's world, and says what speaks against how the input is read.
Result<void> settle_alignment(MappingRun& run, const MappingJob& job, MappingReport& report) {
  const std::vector<FramePair> pairs = moving_pairs(*run.dataset);
  const auto misreading = find_misreading(pairs, reading_of(run.dataset->summary()));
  auto up = align(run, job);
  if (!up) return Unexpected(explained(std::move(up).error(), misreading, *run.dataset));
  note(misreading ? misreading : find_wrong_up(pairs, up->map_from_input), job, report);
  run.dataset->set_map_from_input(up->map_from_input);
  report.up = up->explanation;
  report.registration = run.dataset->summary().registration;
  return {};
}

/// Whether frames begin where the sensor was last, within an edge: nobody knows a longer way.
bool goes_on(const TopologicalMap& map, const std::vector<RgbdFrame>& frames) {
  if (!map.walk() || frames.empty()) return false;
  const Eigen::Vector3d first = frames.front().map_from_camera.origin().xyz;
  return (first - map.walk()->position_in_map).norm() <= map.max_edge_m();
}

/// Compares what is to be appended with the map; what is strange about it becomes findings.
Result<void> prepare_to_append(MappingRun& run, const MappingJob& job, MappingReport& report) {
  MapArchive& map = *run.previous;
  HYPERMAP_ASSIGN_OR_RETURN(run.index_offset, index_offset(map, job.dataset.first));
  const std::vector<RgbdFrame> frames = spread_frames(*run.dataset, kNumComparedFrames);
  if (!job.force && !frames.empty()) {
    HYPERMAP_TRY(refuse_first_frame(frames.front(), map.provenance));
  }
  if (map.topological_map && !goes_on(*map.topological_map, frames)) {
    map.topological_map->interrupt();
  }
  note(find_dropped_prior(job.mapper.prior, map.provenance), job, report);
  if (map.octree) note(compare(frames, *map.octree), job, report);
  if (map.provenance.size() == kMaxRuns) report.findings.push_back(forgotten_run(map.provenance));
  return {};
}

/// What the detector sees in the frame is put to its detections.
Result<void> add_detections(RgbdFrame& frame, OnnxDetector& detector) {
  HYPERMAP_ASSIGN_OR_RETURN(auto found, detector.detect(frame.color));
  frame.detections.insert(frame.detections.end(),
                          std::make_move_iterator(found.begin()),
                          std::make_move_iterator(found.end()));
  return {};
}

}  // namespace

Result<MappingRun> open_run(const MappingJob& job, MappingReport& report) {
  HYPERMAP_TRY(check_job(job));
  std::optional<SavedRun> saved;
  if (job.resume) {
    HYPERMAP_ASSIGN_OR_RETURN(saved, load_saved_run(job));
  }
  MappingRun run;
  // Now, as the working folder may be gone when the map is saved.
  run.input_name =
      printable(std::filesystem::absolute(job.input).lexically_normal().filename().string());
  if (job.append) {
    HYPERMAP_ASSIGN_OR_RETURN(
        auto loaded, load_archive(job.output, job.limits, archive_layer_types(), job.stop));
    if (job.session) HYPERMAP_TRY(refuse_known_session(*job.session, loaded.value.provenance));
    run.classes = loaded.value.classes;
    HYPERMAP_ASSIGN_OR_RETURN(run.detectors, known_detectors(loaded.value));
    run.previous = std::move(loaded.value);
    run.views = BestViews(run.previous->views);
  }
  HYPERMAP_ASSIGN_OR_RETURN(run.detector, load_detector(job, run.classes, run.detectors));
  if (run.detector) report.network_form = run.detector->form();
  run.looks = LookSchedule(job.looks);
  DatasetOptions reading = dataset_options(job);
  reading.detectors = run.detectors;
  if (run.previous) {
    HYPERMAP_ASSIGN_OR_RETURN(reading.detection_reading.embeddings,
                              embedding_dimensions(run.previous->objects));
  }
  HYPERMAP_ASSIGN_OR_RETURN(run.dataset, open_dataset(job.input, reading, run.classes));
  run.detectors = run.dataset->summary().detectors;
  if (job.poses) {
    HYPERMAP_ASSIGN_OR_RETURN(run.dataset,
                              with_corrected_poses(std::move(run.dataset), *job.poses));
  }
  report.findings = run.dataset->summary().findings;
  HYPERMAP_TRY(settle_alignment(run, job, report));
  if (run.previous) HYPERMAP_TRY(prepare_to_append(run, job, report));
  HYPERMAP_ASSIGN_OR_RETURN(SemanticMapperOptions options, understood_options(run, job, report));
  options.refinement.rule = PoseRefinementRule::kNone;  // frames come to it at their refined poses
  if (job.resume || job.checkpoint_every > 0) {
    HYPERMAP_ASSIGN_OR_RETURN(run.settings, settings_of(job, *run.dataset));
  }
  HYPERMAP_ASSIGN_OR_RETURN(run.companions, companion_settings(job));
  HYPERMAP_ASSIGN_OR_RETURN(
      auto stacking,
      model_of_stacking(job.mapper.objects.stacking, job.combiner, run.detectors, run.classes));
  append(report.findings, std::move(stacking.findings));
  HYPERMAP_ASSIGN_OR_RETURN(auto mapper, open_mapper(run, job, options, saved, report));
  HYPERMAP_TRY(set_prior_source(run, job, mapper));
  run.mapper.emplace(std::move(mapper));
  run.mapper->set_stacking_model(std::move(stacking.value));
  if (job.strict && !report.findings.empty()) return Unexpected(report.findings.front().error);
  return run;
}

bool takes_look(MappingRun& run, std::size_t position, const RgbdFrame& frame) {
  if (!run.detector || frame.color.empty()) return false;
  return run.looks.take(position, frame.map_from_camera);
}

Result<PreparedFrame> prepare_frame(MappingRun& run, std::size_t position) {
  StopWatch watch;
  HYPERMAP_ASSIGN_OR_RETURN(RgbdFrame frame, run.dataset->read(position));
  PreparedFrame prepared;
  prepared.frame = std::move(frame);
  prepared.read_s = watch.lap();
  if (position < run.num_resumed_positions) {
    HYPERMAP_TRY(add_earlier_detections(run, position, prepared.frame));
    return prepared;
  }
  prepared.is_looked_at = takes_look(run, position, prepared.frame);
  if (!prepared.is_looked_at) return prepared;
  HYPERMAP_TRY(add_detections(prepared.frame, *run.detector));
  prepared.detect_s = watch.lap();
  return prepared;
}

Result<void> add_earlier_detections(MappingRun& run, std::size_t position, RgbdFrame& frame) {
  if (!run.detector || frame.color.empty() || !run.earlier_looks[position]) return {};
  return add_detections(frame, *run.detector);
}

Provenance provenance_of(const MappingRun& run, const MappingJob& job) {
  return {.tool = std::string("hypermap ") + HYPERMAP_VERSION,
          .input = run.input_name,
          .input_hash = run.fingerprint.text(),
          .options = options_tree({job.mapper, job.layers}, run.companions),
          .map_from_input = run.dataset->map_from_input(),
          .world = run.dataset->summary().world,
          .first_frame_hash = run.fingerprint.first_frame(),
          .next_frame_index = run.next_frame_index,
          .session = job.session.value_or(""),
          .first_stamp = run.first_stamp,
          .last_stamp = run.last_stamp};
}

std::vector<FramePlace> all_places(const MappingRun& run) {
  std::vector<FramePlace> places;
  places.reserve(run.num_resumed_positions + run.places.size());
  for (std::size_t i = 0; i < run.num_resumed_positions; ++i) {
    if (std::ranges::binary_search(run.skipped_positions, i)) continue;
    const auto frame = run.dataset->read(i);
    if (frame) places.push_back({i, frame->map_from_camera.origin().xyz});
  }
  places.insert(places.end(), run.places.begin(), run.places.end());
  return places;
}

MapArchive map_of(const MappingRun& run, const MappingJob& job) {
  MapArchive archive;
  if (run.previous) archive = *run.previous;
  archive.checkpoint = {};
  archive.classes = run.classes;
  archive.detectors = run.detectors;
  archive.vocabulary = vocabulary_of(run, job);
  archive.octree = run.mapper->octree();
  archive.objects = run.mapper->objects();
  archive.views = run.views.views();
  archive.topological_map = run.mapper->topological_map();
  add_run(archive.provenance, provenance_of(run, job));
  return archive;
}

}  // namespace hypermap
