// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/png_image.hpp"
#include "hypermap/io/codec/staged_folder.hpp"
#include "hypermap/io/codec/text_file.hpp"
#include "hypermap/io/dataset/detections_file.hpp"
#include "hypermap/io/dataset/intrinsics_file.hpp"
#include "hypermap/io/dataset/trajectory_file.hpp"
#include "hypermap/io/simulator/simulation_truth.hpp"
#include "hypermap/io/simulator/simulator.hpp"
#include "seen_surfaces.hpp"
#include "true_changes.hpp"

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <new>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

constexpr double kDepthUnitsPerM = 5000.0;

/// What a frame leaves behind once its images are written.
struct FrameRecord {
  RgbdFrame frame;  ///< Without images.
  std::vector<VisibleObject> visible;
  std::vector<int> depth_pixels;
  std::vector<ObjectId> named_rightly;
  std::vector<SeenCell> seen_cells;
};

/// Lists of the dataset, growing frame by frame.
struct Lists {
  std::string color = "# colour pictures\n# timestamp filename\n";
  std::string depth =
      "# depth pictures, 5000 units a metre, 0 is no measurement\n# timestamp filename\n";
  std::string poses = "# map from camera (optical frame)\n# timestamp tx ty tz qx qy qz qw\n";
  std::string detections;
};

Image<std::uint16_t> depth_units(const DepthImage& depth_m) {
  Image<std::uint16_t> units(depth_m.width_px(), depth_m.height_px());
  std::ranges::transform(depth_m.pixels(), units.pixels().begin(), [](float depth) {
    return static_cast<std::uint16_t>(
        std::lround(std::clamp(kDepthUnitsPerM * static_cast<double>(depth), 0.0, 65534.0)));
  });
  return units;
}

std::string color_name(const RgbdFrame& frame) {
  return "rgb/" + frame.name + ".png";
}
std::string depth_name(const RgbdFrame& frame) {
  return "depth/" + frame.name + ".png";
}

/// Renders a frame and writes its images.
Result<FrameRecord> make_frame(const Simulator& simulator,
                               std::size_t index,
                               const SeenSurfaces& surfaces,
                               const StagedFolder& folder) {
  SimulatedFrame simulated = simulator.render(index);
  std::vector<SeenCell> seen = surfaces.seen_in(simulated);
  RgbdFrame& frame = simulated.frame;
  HYPERMAP_ASSIGN_OR_RETURN(const std::string color, encode_png(frame.color, PngEffort::kFast));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string depth,
                            encode_png(depth_units(frame.depth_m), PngEffort::kFast));
  HYPERMAP_TRY(folder.write(color_name(frame), color));
  HYPERMAP_TRY(folder.write(depth_name(frame), depth));
  frame.color = {};
  frame.depth_m = {};
  return FrameRecord{std::move(frame),
                     std::move(simulated.visible),
                     std::move(simulated.depth_pixels),
                     std::move(simulated.named_rightly),
                     std::move(seen)};
}

void add_to_lists(const RgbdFrame& frame, const ClassRegistry& classes, Lists& lists) {
  const std::string stamp = stamp_text(frame.stamp);
  lists.color += stamp + " " + color_name(frame) + "\n";
  lists.depth += stamp + " " + depth_name(frame) + "\n";
  lists.poses += to_tum_line(frame.stamp, InputFromCamera(frame.map_from_camera.isometry()));
  lists.detections += to_json_line(named(frame.detections,
                                         classes,
                                         color_name(frame),
                                         frame.stamp,
                                         frame.camera.width_px,
                                         frame.camera.height_px));
}

void add_to_report(const FrameRecord& record,
                   const SimulatedDetector& detector,
                   SimulationReport& report) {
  ++report.num_frames;
  report.num_detections += record.frame.detections.size();
  for (std::size_t i = 0; i < report.objects.size(); ++i)
    report.objects[i].most_depth_pixels =
        std::max(report.objects[i].most_depth_pixels, record.depth_pixels[i]);
  for (const VisibleObject& object : record.visible) {
    if (object.id.value > report.objects.size()) continue;  // not there at the end
    if (detector.is_visible(object)) ++report.objects[object.id.value - 1].num_frames_visible;
  }
  for (const ObjectId id : record.named_rightly) {
    if (id.value <= report.objects.size()) ++report.objects[id.value - 1].num_frames_named;
  }
}

/// What all frames together say about the objects.
struct WrittenFrames {
  SimulationReport report;
  TrueSurfaces surfaces;
};

/// All frames: rendered in parallel, taken over in their order.
class FramePipeline {
 public:
  FramePipeline(const Simulator& simulator, const StagedFolder& folder, const JobProgress& progress)
      : simulator_(simulator),
        folder_(folder),
        progress_(progress),
        surfaces_(simulator.objects(), nameable_objects(simulator)) {
    for (const PlacedObject& object : simulator.objects())
      report_.objects.push_back({object.name, object.class_name, 0, 0, ""});
  }

  Result<WrittenFrames> run(int num_threads) {
    const int most = tbb::this_task_arena::max_concurrency();
    tbb::task_arena arena(num_threads > 0 ? std::min(num_threads, most) : most);
    arena.execute([&] { run_stages(2 * static_cast<std::size_t>(arena.max_concurrency())); });
    if (error_) return tl::make_unexpected(*error_);
    for (SimulatedTruth& truth : report_.objects)
      truth.exclusion_reason = exclusion(truth, simulator_.detector());
    HYPERMAP_TRY(write_lists());
    return WrittenFrames{std::move(report_), surfaces_.surfaces()};
  }

 private:
  void run_stages(std::size_t max_frames_in_flight) {
    const auto next = [this](tbb::flow_control& control) {
      if (num_started_ == simulator_.size() || failed_) control.stop();
      return num_started_++;
    };
    const auto make = [this](std::size_t index) {
      return make_frame(simulator_, index, surfaces_, folder_);
    };
    const auto take = [this](const Result<FrameRecord>& record) { take_over(record); };
    tbb::parallel_pipeline(
        max_frames_in_flight,
        tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, next) &
            tbb::make_filter<std::size_t, Result<FrameRecord>>(tbb::filter_mode::parallel, make) &
            tbb::make_filter<Result<FrameRecord>, void>(tbb::filter_mode::serial_in_order, take));
  }

  void stop(Error error) {
    if (!failed_) error_ = std::move(error);
    failed_ = true;
  }

  void take_over(const Result<FrameRecord>& record) {
    if (!record) stop(record.error());
    if (failed_) return;
    add_to_lists(record->frame, simulator_.classes(), lists_);
    add_to_report(*record, simulator_.detector(), report_);
    surfaces_.add(record->seen_cells);
    if (progress_ && !progress_(report_.num_frames, simulator_.size())) stop(interrupted().value());
  }

  [[nodiscard]] Result<void> write_lists() const {
    HYPERMAP_TRY(folder_.write("rgb.txt", lists_.color));
    HYPERMAP_TRY(folder_.write("depth.txt", lists_.depth));
    HYPERMAP_TRY(folder_.write("groundtruth.txt", lists_.poses));
    return folder_.write("detections.jsonl", to_json_lines(lists_.detections));
  }

  const Simulator& simulator_;
  const StagedFolder& folder_;
  const JobProgress& progress_;
  std::size_t num_started_ = 0;
  std::atomic<bool> failed_ = false;
  std::optional<Error> error_;
  Lists lists_;
  SimulationReport report_;
  SeenSurfaces surfaces_;  ///< Frames read its cells while the last stage marks them.
};

constexpr std::uint64_t kMaxListBytes = std::uint64_t{64} << 20U;

/// What a simulation wrote, relative to its folder: the images are those that its lists name.
Result<std::set<std::string>> files_of_simulation(const fs::path& folder) {
  std::set<std::string> files{"depth",
                              "depth.txt",
                              "detections.jsonl",
                              "groundtruth.txt",
                              "intrinsics.json",
                              "rgb",
                              "rgb.txt",
                              "truth.hmap"};
  for (const char* list : {"rgb.txt", "depth.txt"}) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string text, read_file(folder / list, kMaxListBytes));
    for (const TextLine& line : split_lines(text)) {
      const auto words = split_words(line.text);
      if (words.size() == 2) files.emplace(words[1]);
    }
  }
  return files;
}

/// An entry below the folder that the simulation there did not write.
Result<std::optional<std::string>> foreign_entry(const fs::path& folder) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto ours, files_of_simulation(folder));
  std::error_code code;
  fs::recursive_directory_iterator entry(folder, code);
  for (; !code && entry != fs::recursive_directory_iterator(); entry.increment(code)) {
    const std::string name = entry->path().lexically_relative(folder).string();
    if (!ours.contains(name) || entry->is_symlink()) return name;
  }
  if (code) return Unexpected(Error{ErrorCode::kIo, code.message(), folder.string()});
  return std::nullopt;
}

/// A simulation may be written where nothing is, in an empty folder, or over another simulation
/// among whose files nothing else was put.
/// Errors: kInvalidArgument; kIo when it cannot be looked at.
Result<void> require_replaceable(const fs::path& output_dir) try {
  if (!fs::exists(output_dir)) return {};
  if (fs::is_directory(output_dir)) {
    if (fs::is_empty(output_dir)) return {};
    if (fs::exists(output_dir / "truth.hmap") && fs::exists(output_dir / "rgb.txt")) {
      HYPERMAP_ASSIGN_OR_RETURN(const auto foreign, foreign_entry(output_dir));
      if (!foreign) return {};
      return tl::make_unexpected(
          Error{ErrorCode::kInvalidArgument,
                "is a simulation, but '" + printable(*foreign) + "' in it is no part of one",
                output_dir.string()});
    }
  }
  return tl::make_unexpected(Error{ErrorCode::kInvalidArgument,
                                   "exists and is neither empty nor a simulation",
                                   output_dir.string()});
} catch (const fs::filesystem_error& error) {
  return Unexpected(Error{
      ErrorCode::kIo, "cannot be looked at: " + error.code().message(), error.path1().string()});
}

Result<SimulationReport> write_simulation(const Scene& scene,
                                          const SimulationOptions& options,
                                          const fs::path& output_dir,
                                          const JobProgress& progress) {
  HYPERMAP_ASSIGN_OR_RETURN(const Simulator simulator, Simulator::create(scene, options));
  HYPERMAP_TRY(require_replaceable(output_dir));
  HYPERMAP_ASSIGN_OR_RETURN(StagedFolder folder, StagedFolder::create(output_dir));
  HYPERMAP_TRY(folder.make_folder("rgb"));
  HYPERMAP_TRY(folder.make_folder("depth"));
  HYPERMAP_TRY(
      folder.write("intrinsics.json", to_intrinsics_json(image_camera(options), kDepthUnitsPerM)));
  HYPERMAP_ASSIGN_OR_RETURN(WrittenFrames written,
                            FramePipeline(simulator, folder, progress).run(options.num_threads));
  HYPERMAP_ASSIGN_OR_RETURN(
      MapArchive truth,
      make_truth(simulator, scene, written.report.objects, std::move(written.surfaces)));
  HYPERMAP_TRY(add_changes(simulator.changes(), truth));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string truth_bytes, write_archive(truth));
  HYPERMAP_TRY(folder.write("truth.hmap", truth_bytes));
  HYPERMAP_TRY(require_replaceable(output_dir));  // the rendering took a while
  HYPERMAP_TRY(folder.commit());
  return std::move(written.report);
}

}  // namespace

Result<SimulationReport> simulate(const Scene& scene,
                                  const SimulationOptions& options,
                                  const fs::path& output_dir,
                                  const JobProgress& progress) {
  try {
    return write_simulation(scene, options, output_dir, progress);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for the simulation");
  } catch (const std::exception& error) {
    return fail(ErrorCode::kIo, error.what());
  }
}

}  // namespace hypermap
