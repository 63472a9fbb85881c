// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a mapping job holds while it runs, and the map of it at any moment.
#pragma once

#include "best_views.hpp"
#include "frame_stream.hpp"
#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "hypermap/io/detector/onnx_detector.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"
#include "input_fingerprint.hpp"
#include "look_schedule.hpp"
#include "outlying_regions.hpp"
#include "run_checkpoint.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

/// What a run needs besides the job: everything is opened before the first frame is mapped.
struct MappingRun {
  std::string input_name;
  ClassRegistry classes;
  DetectorRegistry detectors;
  std::optional<MapArchive> previous;
  std::unique_ptr<DatasetReader> dataset;
  std::optional<OnnxDetector> detector;
  LookSchedule looks;               ///< Of the detector.
  std::vector<bool> earlier_looks;  ///< At frames before those of this process.
  std::optional<SemanticMapper> mapper;
  BestViews views;
  InputFingerprint fingerprint;
  std::uint64_t index_offset = 0;         ///< What the index of each frame grows by.
  std::uint64_t next_frame_index = 0;     ///< After the newest frame in the map.
  std::optional<Stamp> first_stamp;       ///< Of the frames in the map of this run, the earliest
  std::optional<Stamp> last_stamp;        ///< and the latest.
  std::size_t num_resumed_positions = 0;  ///< Frames of the input before those of this process.
  std::vector<FramePlace> places;         ///< Of the frames in the map, but those before.
  NotedFrame first;                       ///< That was mapped, if any was.
  NotedFrame last;                        ///< That was mapped, if any was.
  std::vector<std::size_t> skipped_positions;  ///< Ascending.
  ValueTree settings;                          ///< For checkpoints; else null.
  std::vector<ValueTree::Entry> companions;    ///< For the provenance.
  std::optional<std::string> checkpoint_of;    ///< The frame whose checkpoint is on disk.
  bool checkpoint_failed = false;              ///< Some checkpoint could not be saved; it was said.
};

/// Notes findings and the up axis in `report`. Errors: those of run_mapping that need no frame.
[[nodiscard]] Result<MappingRun> open_run(const MappingJob& job, MappingReport& report);

/// Whether the detector, if there is one, is to look at a frame of the input.
/// Requires: asked once for each frame that can be read, in their order.
[[nodiscard]] bool takes_look(MappingRun& run, std::size_t position, const RgbdFrame& frame);

/// The frame at a position, with what the detector sees in it if it looks, or looked when the frame
/// was mapped before this process. Uses the dataset, the detector and the schedule of the run
/// alone. Requires: ascending positions.
/// Errors: those of DatasetReader::read and OnnxDetector::detect.
[[nodiscard]] Result<PreparedFrame> prepare_frame(MappingRun& run, std::size_t position);

/// What the detector saw in a frame before those of this process, if it looked at it, is put to the
/// frame's detections. Errors: those of OnnxDetector::detect.
[[nodiscard]] Result<void> add_earlier_detections(MappingRun& run,
                                                  std::size_t position,
                                                  RgbdFrame& frame);

/// What the map is to say of the run. Requires: the dataset is open and aligned.
[[nodiscard]] Provenance provenance_of(const MappingRun& run, const MappingJob& job);

/// The places of all frames in the map: those that were mapped before this process are read again,
/// and left out when they cannot be. Cost: that of reading them.
[[nodiscard]] std::vector<FramePlace> all_places(const MappingRun& run);

/// The map as it is now, without layers of its own; those of a map that is gone on from are kept.
[[nodiscard]] MapArchive map_of(const MappingRun& run, const MappingJob& job);

}  // namespace hypermap
