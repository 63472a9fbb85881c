// SPDX-License-Identifier: BSD-3-Clause
// Checks of what sequences are made of.
#include "file_checks.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/io/archive/listed_instances_file.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/text_file.hpp"
#include "hypermap/io/dataset/dataset_description.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "hypermap/io/dataset/detections_file.hpp"
#include "hypermap/io/dataset/intrinsics_file.hpp"
#include "hypermap/io/dataset/reading_check.hpp"
#include "hypermap/io/dataset/trajectory_file.hpp"
#include "hypermap/io/dataset/up_axis.hpp"

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxSequenceTextBytes = std::size_t{256} << 20U;

/// Words of the first line that is neither blank nor a comment.
std::size_t num_columns(std::string_view text) {
  for (const TextLine& line : split_lines(text)) {
    const std::string_view content = trimmed(line.text);
    if (!content.empty() && content.front() != '#') return split_words(content).size();
  }
  return 0;
}

Result<FileSummary> check_frames(const DatasetReader& reader) {
  const DatasetSummary& summary = reader.summary();
  FileSummary out{summary.layout + ", " + count_text(reader.size(), "frame") + ", " +
                      count_text(summary.num_detections, "detection"),
                  summary.findings};
  for (const std::string& name : summary.unpaired) {
    out.findings.push_back(
        {Severity::kWarning, {.code = ErrorCode::kNotFound, .what = name, .field = "unpaired"}});
  }
  for (std::size_t i = 0; i < reader.size(); ++i) {
    auto frame = reader.read(i);
    if (!frame) out.findings.push_back({Severity::kError, std::move(frame).error()});
  }
  return out;
}

/// What a few frames say of how the dataset is read.
void add_misreadings(FileSummary& summary, const DatasetReader& dataset, const fs::path& path) {
  const std::vector<FramePair> pairs = moving_pairs(dataset);
  auto finding = find_misreading(pairs, reading_of(dataset.summary()));
  const std::optional<std::string>& up_axis = dataset.summary().up_axis;
  if (const auto turn = map_from_input_axis(up_axis.value_or("")); !finding && turn) {
    finding = find_wrong_up(pairs, *turn);
  }
  if (!finding) return;
  finding->error.file = path.string();
  summary.findings.push_back(std::move(*finding));
}

}  // namespace

Result<FileSummary> check_depth(const fs::path& path, ImageSize expected) {
  HYPERMAP_ASSIGN_OR_RETURN(const DepthImage depth, read_depth(path, {}, expected));
  const auto valid =
      std::count_if(depth.pixels().begin(), depth.pixels().end(), [](float z) { return z > 0.0F; });
  return FileSummary{std::to_string(depth.width_px()) + " x " + std::to_string(depth.height_px()) +
                         ", " + count_text(static_cast<std::size_t>(valid), "measured pixel"),
                     {}};
}

Result<FileSummary> check_trajectory(const fs::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, read_file(path, kMaxSequenceTextBytes));
  const std::size_t columns = num_columns(text);
  if (columns == 3) {
    HYPERMAP_ASSIGN_OR_RETURN(auto loaded, read_log_trajectory(path));
    return FileSummary{count_text(loaded.value.poses.size(), "pose"), std::move(loaded.findings)};
  }
  if (columns == 4) {
    HYPERMAP_TRY(read_pose_matrix(path));
    return FileSummary{count_text(1, "pose"), {}};
  }
  if (columns == 12 || columns == 16) {
    HYPERMAP_ASSIGN_OR_RETURN(auto loaded, read_pose_lines(path));
    return FileSummary{count_text(loaded.value.poses.size(), "pose"), std::move(loaded.findings)};
  }
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, read_tum_trajectory(path));
  return FileSummary{count_text(loaded.value.poses.size(), "pose"), std::move(loaded.findings)};
}

Result<FileSummary> check_intrinsics(const fs::path& path, ImageSize expected) {
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, read_intrinsics(path));
  const Intrinsics& k = loaded.value;
  if (k.width_px || expected.width_px > 0) {
    HYPERMAP_TRY(camera_of(k,
                           expected.width_px > 0 ? expected.width_px : *k.width_px,
                           expected.height_px > 0 ? expected.height_px : *k.height_px));
  }
  const std::string size =
      k.width_px ? std::to_string(*k.width_px) + " x " + std::to_string(k.height_px.value_or(0))
                 : "no size stated";
  return FileSummary{"camera, " + size, std::move(loaded.findings)};
}

Result<FileSummary> check_detections(const fs::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, read_detections(path));
  return FileSummary{count_text(loaded.value.num_detections(), "detection") + " in " +
                         count_text(loaded.value.frames.size(), "frame"),
                     std::move(loaded.findings)};
}

Result<FileSummary> check_dataset(const fs::path& path, const FileCheckOptions& options) {
  std::error_code ec;
  if (!fs::is_directory(path, ec)) {
    HYPERMAP_ASSIGN_OR_RETURN(auto loaded, read_dataset_description(path));
    return FileSummary{"description of a dataset", std::move(loaded.findings)};
  }
  ClassRegistry registry;
  HYPERMAP_ASSIGN_OR_RETURN(const auto reader,
                            open_dataset(path, {.description = options.description}, registry));
  HYPERMAP_ASSIGN_OR_RETURN(FileSummary summary, check_frames(*reader));
  add_misreadings(summary, *reader, path);
  return summary;
}

Result<FileSummary> check_truth(const fs::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const ListedInstances listed, load_listed_instances(path));
  return FileSummary{
      count_text(listed.instances.size(), "thing") + " of " + printable(listed.sequence), {}};
}

}  // namespace hypermap
