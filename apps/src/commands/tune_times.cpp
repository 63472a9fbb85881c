// SPDX-License-Identifier: BSD-3-Clause
#include "tune_times.hpp"

#include "box_plots.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/io/jobs/segmentation_statistics.hpp"
#include "progress.hpp"
#include "tables.hpp"

#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

namespace hypermap::app {
namespace {

void add_numbers(Table& table,
                 const std::string& name,
                 std::size_t count,
                 const FiveNumbers& numbers,
                 int digits) {
  table.add({name,
             std::to_string(count),
             fixed(numbers.min, digits),
             fixed(numbers.lower, digits),
             fixed(numbers.median, digits),
             fixed(numbers.upper, digits),
             fixed(numbers.max, digits)});
}

void print_statistics(const SegmentationStatistics& statistics) {
  Table times({"ms", "detections", "min", "quartile", "median", "quartile", "max"});
  Table points({"points left", "detections", "min", "quartile", "median", "quartile", "max"});
  for (const StepStatistics& step : statistics.steps) {
    add_numbers(times, step.name, step.num_detections, in_milliseconds(step.seconds), 3);
    add_numbers(points, step.name, step.num_detections, step.points, 0);
  }
  add_numbers(
      times, "all steps", statistics.num_detections, in_milliseconds(statistics.seconds), 3);
  std::printf("%s\n%s", times.text().c_str(), points.text().c_str());
  std::printf("%s in %s; something was left of %zu\n",
              count_text(statistics.num_detections, "detection").c_str(),
              count_text(statistics.num_frames, "frame").c_str(),
              statistics.num_segments);
}

Result<void> write_plots(const SegmentationStatistics& statistics,
                         const std::string& name,
                         const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) return Unexpected(Error{ErrorCode::kIo, failed.message(), folder.string()});
  std::vector<BoxPlotRow> times;
  std::vector<BoxPlotRow> points;
  for (const StepStatistics& step : statistics.steps) {
    times.push_back({step.name, in_milliseconds(step.seconds)});
    points.push_back({step.name, step.points});
  }
  times.push_back({"all steps", in_milliseconds(statistics.seconds)});
  const std::string counted =
      printable(name) + ", " + count_text(statistics.num_detections, "detection");
  HYPERMAP_TRY(write_box_plot(
      folder / "times.png", "Segmentation, " + counted, "milliseconds a detection", times));
  return write_box_plot(
      folder / "points.png", "Points after each step, " + counted, "points", points);
}

}  // namespace

Result<void> tell_times(const DatasetReader& dataset,
                        const GeometricSegmentationOptions& options,
                        const std::optional<std::string>& output,
                        bool json,
                        const std::string& progress_when) {
  Result<SegmentationStatistics> statistics;
  {
    Progress progress("segmenting", progress_when);
    statistics =
        segmentation_statistics(dataset, options, [&](std::size_t done, std::size_t total) {
          return progress.update(done, total);
        });
  }
  if (!statistics) return Unexpected(statistics.error());
  if (output) HYPERMAP_TRY(write_plots(*statistics, dataset.summary().name, *output));
  if (json) {
    std::printf("%s\n", to_json(*statistics).c_str());
  } else {
    print_statistics(*statistics);
  }
  return {};
}

}  // namespace hypermap::app
