// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/detection_job.hpp"

#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/dataset/class_names.hpp"
#include "hypermap/io/dataset/detections_file.hpp"
#include "known_detectors.hpp"
#include "named_classes.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// Frames must be read without the detections that lie beside them: the detector's are wanted.
DatasetOptions images_only(DatasetOptions options) {
  options.detections.clear();
  options.find_detections = false;
  options.read_color = true;
  return options;
}

/// The classes of these names that are known.
std::vector<ClassId> known_ids(std::span<const std::string> names, const ClassRegistry& classes) {
  std::vector<ClassId> ids;
  ids.reserve(names.size());
  for (const std::string& name : names) {
    if (const auto id = classes.find(name)) ids.push_back(*id);
  }
  return ids;
}

bool is_of_one(const Detection& detection, const std::vector<ClassId>& ids) {
  const auto best = best_class(detection.class_scores);
  return best && std::find(ids.begin(), ids.end(), best->id) != ids.end();
}

Result<std::string> as_text(std::span<const FrameDetections> frames,
                            const DetectionJob& job,
                            NetworkForm form) {
  if (job.output.extension() != ".jsonl") {
    const auto names =
        job.detector.class_names.empty() ? coco_class_names() : job.detector.class_names;
    return to_coco_results(frames, names);
  }
  std::string lines;
  for (const FrameDetections& frame : frames) lines += to_json_line(frame);
  return to_json_lines(lines, described_network(job.model, job.detector, form));
}

}  // namespace

Result<DetectionJobReport> run_detection(const DetectionJob& job, const JobProgress& progress) {
  HYPERMAP_TRY(check_target(job.output));
  ClassRegistry classes;
  HYPERMAP_ASSIGN_OR_RETURN(OnnxDetector detector,
                            OnnxDetector::load(job.model, job.detector, classes));
  HYPERMAP_ASSIGN_OR_RETURN(const auto dataset,
                            open_dataset(job.input, images_only(job.dataset), classes));
  HYPERMAP_ASSIGN_OR_RETURN(auto to_keep,
                            named_classes(job.wanted_class_names, "wanted_classes", classes, {}));
  const std::vector<ClassId> wanted = known_ids(to_keep.names, classes);
  DetectionJobReport report;
  report.network_form = detector.form();
  report.findings = std::move(to_keep.findings);
  std::vector<FrameDetections> frames;
  for (std::size_t i = 0; i < dataset->size(); ++i) {
    const auto frame = dataset->read(i);
    auto found = frame ? detector.detect(frame->color)
                       : Result<std::vector<Detection>>(Unexpected(frame.error()));
    if (found) {
      if (!job.wanted_class_names.empty()) {
        report.num_filtered +=
            std::erase_if(*found, [&](const Detection& one) { return !is_of_one(one, wanted); });
      }
      frames.push_back(named(*found,
                             classes,
                             frame->name,
                             frame->stamp,
                             frame->color.width_px(),
                             frame->color.height_px()));
      report.num_detections += found->size();
    } else {
      report.skipped.push_back(found.error());
    }
    if (progress && !progress(i + 1, dataset->size())) return interrupted();
  }
  report.num_frames = frames.size();
  if (frames.empty()) {
    return fail(ErrorCode::kNotFound, "no frame of the dataset could be given to the detector");
  }
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, as_text(frames, job, detector.form()));
  HYPERMAP_TRY(write_file_atomically(job.output, text));
  return report;
}

}  // namespace hypermap
