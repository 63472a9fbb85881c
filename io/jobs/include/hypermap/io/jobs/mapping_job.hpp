// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The main job: a dataset becomes an archive.
#pragma once

#include "hypermap/core/base/job_progress.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/base/series_sample.hpp"
#include "hypermap/core/geometry/map_floor.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "hypermap/io/detector/onnx_detector.hpp"
#include "hypermap/io/jobs/look_options.hpp"
#include "hypermap/io/jobs/world_placement.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

struct MappingJob {
  std::filesystem::path input = {};
  std::filesystem::path output = {};
  DatasetOptions dataset = {};
  /// A network that looks at each colour image, besides any detections on file.
  std::optional<std::filesystem::path> model = std::nullopt;
  OnnxDetectorOptions detector = {};
  /// At which frames the network looks. One that it does not look at, where no other detector is
  /// asked for, brings surfaces and free space alone: no object counts as missed in it. Each run
  /// begins anew, with the first frame that it can read.
  LookOptions looks = {};
  /// What combines detectors by stacking rule `trained`, as train_combiner_job writes it: needed by
  /// that rule, refused with another.
  std::optional<std::filesystem::path> combiner = std::nullopt;
  SemanticMapperOptions mapper = {};
  /// What belongs where, for `mapper.prior.source` places; without it that is refused.
  std::optional<PlaceRules> place_rules = std::nullopt;
  /// What they are called, for the map's provenance: a file, without its folder.
  std::string place_rules_name = {};
  /// What names of classes mean, kept in the map; none: what the map that it goes on from keeps.
  /// Options and rules that name classes are understood by it; the map keeps detectors' own names.
  std::optional<ClassVocabulary> vocabulary = std::nullopt;
  LayerOptions layers = {};
  /// Which axis of the dataset's world points up ("z", "-y", ...), "floor" to find the floor plane;
  /// none: what the dataset's description says, else z for TUM RGB-D, else "floor".
  std::optional<std::string> up_axis = std::nullopt;
  /// More skipped frames than this share make the whole job fail. 0 .. 1
  double max_skipped_share = 0.05;
  /// Corrected poses of the dataset's frames, as a loop closure leaves them: the map is built anew
  /// with them. See with_corrected_poses.
  std::optional<std::filesystem::path> poses = std::nullopt;
  /// Go on from the archive at `output`. Frames of the input count on after those of the map. Its
  /// world is that of an earlier run whose `world` it names; else one of the next two is needed.
  bool append = false;
  /// The poses are in the world of the newest run of an input of that name, else of the newest run:
  /// they are aligned as that one was.
  bool same_world = false;
  std::optional<WorldPlacement> placement = std::nullopt;
  /// What people call the run (`check_session_name`); none: it goes by its number. No other run of
  /// the map has that name.
  std::optional<std::string> session = std::nullopt;
  /// What is found before the first frame ends the run as an error.
  bool strict = false;
  /// Frames that are in the map already are mapped once more.
  bool force = false;
  /// The best colour view of each object is kept in the map (object_views.hpp).
  bool keep_views = false;
  /// After so many mapped frames each time the map is saved to `checkpoint_path(output)`, an
  /// archive that `resume` or a later run goes on from. It goes when the map is saved. 0: never.
  std::size_t checkpoint_every = 0;
  /// Go on from `checkpoint_path(output)` where a run of the same job ended early, with the frames
  /// after the last one in it: the map is, byte for byte, that of a run that was not interrupted.
  /// Threads, limits, `checkpoint_every`, `max_skipped_share` and `strict` may be others.
  bool resume = false;
  /// Of that archive, and of what is written in its place.
  ArchiveLimits limits = {};
  /// Ends the loading of that archive with kInterrupted.
  StopCheck stop = {};
};

/// `<output>.checkpoint`: the map as it was some frames ago, while it is made.
[[nodiscard]] std::filesystem::path checkpoint_path(const std::filesystem::path& output);
/// `<output>.rescue`: the map that could not be saved to `output`.
[[nodiscard]] std::filesystem::path rescue_path(const std::filesystem::path& output);

/// Wall clock by stage, in seconds.
struct MappingSeconds {
  double read = 0.0;    ///< Of frames in the map; beside the work on others with several threads,
  double detect = 0.0;  ///< as is this.
  double wait = 0.0;    ///< For the next frame: what of these two was not beside other work.
  double smooth = 0.0;
  double refine = 0.0;  ///< Smoothing what poses are refined by included.
  double segment = 0.0;
  double integrate = 0.0;
  double associate = 0.0;
  double visibility = 0.0;
  double project = 0.0;
  double write = 0.0;
  double wall = 0.0;
};

/// A part of the work on a frame, as MappingSeconds has them; the last one is all that the run
/// does for a frame, waiting for it included.
enum class FrameStage : std::uint8_t {
  kRead,
  kDetect,
  kWait,
  kSmooth,
  kRefine,
  kSegment,
  kIntegrate,
  kAssociate,
  kVisibility,
  kFrame,
};
inline constexpr std::array<FrameStage, 10> kFrameStages{FrameStage::kRead,
                                                         FrameStage::kDetect,
                                                         FrameStage::kWait,
                                                         FrameStage::kSmooth,
                                                         FrameStage::kRefine,
                                                         FrameStage::kSegment,
                                                         FrameStage::kIntegrate,
                                                         FrameStage::kAssociate,
                                                         FrameStage::kVisibility,
                                                         FrameStage::kFrame};

/// One word each, for output: "read" ...
[[nodiscard]] std::string_view name_of(FrameStage stage);

/// Wall clock of single frames by stage, in seconds: of frames that are in the map since the run
/// began or was resumed; reading and detecting also of those that were skipped after it.
/// Source: [smap] 5.1 (what its figure of callbacks shows).
struct FrameTimes {
  std::array<SeriesSample, kFrameStages.size()> samples = {};

  [[nodiscard]] const SeriesSample& of(FrameStage stage) const {
    return samples[static_cast<std::size_t>(stage)];
  }
  void add(FrameStage stage, double seconds) {
    samples[static_cast<std::size_t>(stage)].add(seconds);
  }
};

/// What became of the given poses, when they are refined; all 0 otherwise.
struct PoseCounts {
  std::size_t num_refined = 0;
  std::size_t num_too_few_points = 0;  ///< Of these four the given poses were used.
  std::size_t num_ambiguous = 0;
  std::size_t num_too_large = 0;
  std::size_t num_no_better = 0;
  double mean_translation_m = 0.0;  ///< Of the refined ones, as are the next three.
  double max_translation_m = 0.0;
  double mean_rotation_rad = 0.0;
  double max_rotation_rad = 0.0;
};

struct MappingReport {
  std::size_t num_frames = 0;     ///< In the map, those before a checkpoint included.
  std::size_t num_resumed = 0;    ///< Of these, those that the checkpoint had; not in `seconds`.
  std::vector<Error> skipped;     ///< Frames that could not be used, with the reason.
  std::vector<Finding> findings;  ///< Of the dataset, of class names, of layers, of checkpoints.
  std::size_t num_looks = 0;      ///< Of these, at which the network looked, if there is one.
  std::size_t num_detections = 0;
  std::size_t num_filtered = 0;  ///< Detections of a class that is transient or not wanted.
  std::size_t num_segments = 0;
  std::size_t num_visibility_skipped = 0;  ///< Frames without evaluation of visibility.
  PoseCounts poses;                        ///< Of all frames in the map of this run.
  IntegrationReport points;                ///< Summed over the frames.
  std::size_t num_objects = 0;             ///< Confirmed.
  std::size_t num_tentative = 0;           ///< Not confirmed.
  LeafCount leaves;
  std::string up;       ///< How the world was aligned to gravity, in words.
  MapFloor floor = {};  ///< Over which the heights of the layers are.
  /// Of a colour camera that the images told; empty: depth is registered as it is.
  std::string registration;
  NetworkForm network_form = NetworkForm::kAuto;  ///< Of the network, if there is one.
  std::size_t peak_rss_bytes = 0;
  int num_threads = 1;
  MappingSeconds seconds;
  FrameTimes frame_times;
};

/// A few frames are compared first: depth and poses that another reading explains much better, and
/// an up axis that no camera holds upright, are findings (reading_check.hpp).
/// With more than one thread the next frame is read, decoded and looked at by the network while one
/// is worked on; the map is the same.
///
/// What can be told before the first frame is told then: options, and whether files can be made
/// where the map and its checkpoints are to be. Grids cover the largest region of the map; what
/// lies outside and what layer could not be made are findings (see derive_layers), as is a
/// checkpoint that could not be saved, as are frames to append that show nothing of the map or
/// another place. Errors: kInvalidArgument when the mapper has a deadline, when a map is to be gone
/// on from with corrected poses (what it holds has the old ones), when nothing says where the world
/// of what is to be appended lies, when a run of the map has the session's name, and, unless
/// forced, when its first frame was the first of a run of the map (told before the work) or all its
/// frames are those of one (told after it); with `strict` the first finding that there is before
/// the first frame; those of check_target, open_dataset, with_corrected_poses, OnnxDetector::load,
/// SemanticMapper::create and save_archive; with `resume` kNotFound when there is no checkpoint and
/// kInvalidArgument, naming it, when its run had another version, input, settings or options, or
/// was appended to another map; as soon as more frames were skipped than allowed kLimit, naming the
/// first, or kIo, naming one that is there and that the system did not give; kInterrupted. `output`
/// is not written on an error. When the map cannot be saved or memory ends after a frame, the map
/// is at `rescue_path(output)`, else in the working folder or that for temporary files, and the
/// error says where: without layers when it cannot be saved with them. Checkpoints stay and are
/// named.
[[nodiscard]] Result<MappingReport> run_mapping(const MappingJob& job,
                                                const JobProgress& progress = {});

/// The JSON document of `map --stats`; see docs/CLI.md.
[[nodiscard]] std::string to_json(const MappingReport& report);

}  // namespace hypermap
