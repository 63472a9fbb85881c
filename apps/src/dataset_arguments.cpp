// SPDX-License-Identifier: BSD-3-Clause
#include "dataset_arguments.hpp"

#include "option_flags.hpp"

#include <CLI/Error.hpp>

#include <algorithm>
#include <system_error>

namespace hypermap::app {
namespace {

Result<std::vector<std::string>> class_names(const std::optional<std::string>& path) {
  if (!path) return std::vector<std::string>{};
  return read_class_names(*path);
}

}  // namespace

void DatasetArguments::add_to(CLI::App& command) {
  command
      .add_option("--input", input, "folder: TUM RGB-D, 7-Scenes, Open3D, ScanNet, dataset.yaml")
      ->required();
  command.add_option("--dataset", description, kDescriptionHelp);
  add_reading_to(command);
}

void DatasetArguments::add_reading_to(CLI::App& command) {
  const OptionTable& table = option_table(DatasetOptions{});
  command.add_option(
      "--classes", classes, "names of a model's outputs, one a line (default: COCO)");
  command.add_option("--first", first, "leave out so many frames at the start")
      ->check(value_of_field(table, "first"))
      ->capture_default_str();
  command.add_option("--stride", stride, "use every N-th frame")
      ->check(value_of_field(table, "stride"))
      ->capture_default_str();
  command.add_option("--max-frames", max_frames, "stop after so many frames")
      ->check(value_of_field(table, "max_frames"));
  command.add_option("--stamp-tolerance", stamp_tolerance_s, "seconds that partners may be apart")
      ->check(value_of_field(table, "stamp_tolerance_s"));
}

Result<DatasetOptions> DatasetArguments::options() const {
  DatasetOptions options;
  if (description) options.description = *description;
  options.first = first;
  options.stride = stride;
  options.stamp_tolerance_s = stamp_tolerance_s;
  options.max_frames = max_frames;
  HYPERMAP_ASSIGN_OR_RETURN(options.detection_reading.class_names, class_names(classes));
  return options;
}

Result<OnnxDetectorOptions> DatasetArguments::detector() const {
  OnnxDetectorOptions options;
  HYPERMAP_ASSIGN_OR_RETURN(options.class_names, class_names(classes));
  return options;
}

std::vector<std::string> unused_detections(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code unreadable;
  for (std::filesystem::directory_iterator entry(folder, unreadable), end;
       !unreadable && entry != end;
       entry.increment(unreadable)) {
    const std::string name = entry->path().filename().string();
    const bool is_found = name == "detections.json" || name == "detections.jsonl";
    if (name.starts_with("detections") && name.find(".json") != std::string::npos && !is_found)
      names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

CLI::Option& DetectionFiles::add_to(CLI::App& command) {
  CLI::Option& option = *command.add_option(
      "--detections", files, "detections file, one a detector; may be repeated");
  command.add_option(
      "--detector",
      detectors,
      "whose words --detections are: the first names the detector of the first file, "
      "and so on; may be repeated (default: what the file says, else its name)");
  return option;
}

void DetectionFiles::keep_to_files() const {
  if (detectors.size() <= files.size()) return;
  throw CLI::ValidationError("--detector",
                             "names " + std::to_string(detectors.size()) + " detectors of " +
                                 std::to_string(files.size()) + " files of --detections");
}

void DetectionFiles::put_into(DatasetOptions& options) const {
  options.detections.assign(files.begin(), files.end());
  options.detector_names = detectors;
}

void add_keep_classes(CLI::App& command, std::vector<std::string>& names) {
  command
      .add_option("--keep-classes",
                  names,
                  "the only classes whose detections count, separated by commas; others are left "
                  "out")
      ->delimiter(',');
}

}  // namespace hypermap::app
