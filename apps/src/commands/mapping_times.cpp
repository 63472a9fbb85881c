// SPDX-License-Identifier: BSD-3-Clause
#include "mapping_times.hpp"

#include "box_plots.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "outputs.hpp"

namespace hypermap::app {
namespace {

Result<void> write_times_plot(const MappingReport& report,
                              const std::filesystem::path& input,
                              const std::filesystem::path& path) {
  std::vector<BoxPlotRow> rows;
  rows.reserve(kFrameStages.size());
  for (const FrameStage stage : kFrameStages) {
    const FiveNumbers numbers = report.frame_times.of(stage).numbers();
    if (numbers.max > 0.0)
      rows.push_back({.name = std::string(name_of(stage)), .numbers = in_milliseconds(numbers)});
  }
  const std::filesystem::path named = input.lexically_normal();
  const auto name = named.has_filename() ? named.filename() : named.parent_path().filename();
  const std::size_t num_frames = report.frame_times.of(FrameStage::kFrame).n();
  return write_box_plot(
      path,
      "Mapping, " + printable(name.string()) + ", " + count_text(num_frames, "frame"),
      "milliseconds a frame",
      rows);
}

}  // namespace

void MappingTimesArguments::add_to(CLI::App& command) {
  command.add_option("--stats", stats, "JSON file for counts and times");
  command.add_option("--times-plot", plot, "PNG file for box plots of the times of a frame");
}

void MappingTimesArguments::keep_outputs_apart(
    const std::vector<std::filesystem::path>& read,
    const std::vector<std::filesystem::path>& written) const {
  const std::filesystem::path stats_path = stats.value_or("");
  const std::filesystem::path plot_path = plot.value_or("");
  keep_apart("--stats", stats_path, read);
  keep_unlike("--stats", stats_path, written);
  keep_suffix("--stats", stats_path, ".json");
  if (!plot) return;
  keep_apart("--times-plot", plot_path, read);
  keep_unlike("--times-plot", plot_path, written);
  keep_unlike("--times-plot", plot_path, {stats_path});
  keep_suffix("--times-plot", plot_path, ".png");
}

Result<void> MappingTimesArguments::check_targets() const {
  if (stats) HYPERMAP_TRY(check_target(*stats));
  if (plot) HYPERMAP_TRY(check_target(*plot));
  return {};
}

Result<void> MappingTimesArguments::write(const MappingReport& report,
                                          const std::filesystem::path& input) const {
  if (stats) HYPERMAP_TRY(write_file_atomically(*stats, to_json(report)));
  if (!plot) return {};
  return write_times_plot(report, input, *plot);
}

}  // namespace hypermap::app
