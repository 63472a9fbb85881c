// SPDX-License-Identifier: BSD-3-Clause
#include "tune_sweep.hpp"

#include "data_dir.hpp"
#include "hypermap/io/jobs/parameter_sweep.hpp"
#include "hypermap/io/options/place_rules_file.hpp"
#include "hypermap/io/simulator/scene_file.hpp"
#include "hypermap/io/simulator/simulator.hpp"
#include "option_flags.hpp"
#include "places.hpp"
#include "progress.hpp"
#include "tables.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

namespace hypermap::app {
namespace {

/// A new folder among those for temporary files; it goes with what is in it.
class PassingFolder {
 public:
  [[nodiscard]] static Result<PassingFolder> create() {
    std::error_code failed;
    const auto temporaries = std::filesystem::temp_directory_path(failed);
    std::string name = (temporaries / "hypermap-sweep-XXXXXX").string();
    if (failed || ::mkdtemp(name.data()) == nullptr) {
      return Unexpected(Error{ErrorCode::kIo, "no temporary folder can be made", name});
    }
    return PassingFolder(name);
  }
  PassingFolder(PassingFolder&& other) noexcept : path_(std::move(other.path_)) {
    other.path_.clear();
  }
  PassingFolder& operator=(PassingFolder&&) = delete;
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;
  ~PassingFolder() {
    std::error_code stays;
    if (!path_.empty()) std::filesystem::remove_all(path_, stays);
  }

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  explicit PassingFolder(std::filesystem::path path) : path_(std::move(path)) {}

  std::filesystem::path path_;
};

/// A scene at each seed, below `folder`.
Result<std::vector<SweptSequence>> simulated(const SweepArguments& arguments,
                                             const std::filesystem::path& folder,
                                             const std::string& progress_when) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto path, find_scene(arguments.scene, data_dir()));
  HYPERMAP_ASSIGN_OR_RETURN(const Scene scene, load_scene(path));
  std::vector<SweptSequence> sequences;
  for (const std::uint64_t seed : arguments.seeds) {
    const std::string name = scene.name + " " + std::to_string(seed);
    const std::filesystem::path input = folder / std::to_string(seed);
    SimulationOptions options;
    options.num_frames = arguments.num_frames;
    options.seed = seed;
    Progress progress("simulating " + name, progress_when);
    HYPERMAP_TRY(simulate(scene, options, input, [&](std::size_t done, std::size_t total) {
      return progress.update(done, total);
    }));
    sequences.push_back({.name = name, .input = input, .truth = input / "truth.hmap"});
  }
  return sequences;
}

Result<std::vector<SweptSequence>> given(const SweepArguments& arguments,
                                         const DatasetArguments& dataset,
                                         const std::vector<std::string>& detections) {
  std::vector<SweptSequence> sequences;
  if (arguments.truth) {
    HYPERMAP_ASSIGN_OR_RETURN(DatasetOptions options, dataset.options());
    options.detections.assign(detections.begin(), detections.end());
    sequences.push_back({.name = dataset.input,
                         .input = dataset.input,
                         .truth = *arguments.truth,
                         .dataset = std::move(options)});
  }
  for (const auto& [input, truth] : arguments.also) {
    sequences.push_back({.name = input, .input = input, .truth = truth});
  }
  return sequences;
}

/// What the axes do not say: what is asked for beside a file is meant to be used.
Result<MapOptions> common_options(const SweepArguments& arguments, MapOptions options) {
  if (!arguments.places.empty()) {
    HYPERMAP_ASSIGN_OR_RETURN(options, with_option(options, "prior.source", "places"));
  }
  if (arguments.combiner) {
    HYPERMAP_ASSIGN_OR_RETURN(options, with_option(options, "stacking.rule", "trained"));
  }
  return options;
}

bool may_take_places(const SweepJob& job) {
  return job.options.mapper.prior.source == ClassPriorKind::kPlaces ||
         std::ranges::find(job.axes, "prior.source", &SweepAxis::option) != job.axes.end();
}

Result<SweepReport> swept(const SweepArguments& arguments,
                          const DatasetArguments& dataset,
                          const std::vector<std::string>& detections,
                          const MapOptions& options,
                          const std::string& progress_when) {
  SweepJob job{.combiner = arguments.combiner};
  HYPERMAP_ASSIGN_OR_RETURN(job.options, common_options(arguments, options));
  for (const std::string& text : arguments.axes) {
    auto axis = parse_sweep_axis(text);
    if (!axis) return Unexpected(of_option(std::move(axis).error(), "--sweep"));
    job.axes.push_back(std::move(*axis));
  }
  if (may_take_places(job)) {
    HYPERMAP_ASSIGN_OR_RETURN(job.place_rules, read_place_rules(places_file(arguments.places)));
  }
  const auto cores = static_cast<int>(std::thread::hardware_concurrency());
  job.options.mapper.num_threads = std::max(cores, 1);
  HYPERMAP_ASSIGN_OR_RETURN(const PassingFolder folder, PassingFolder::create());
  job.folder = folder.path();
  HYPERMAP_ASSIGN_OR_RETURN(job.sequences, given(arguments, dataset, detections));
  if (job.sequences.empty()) {
    HYPERMAP_ASSIGN_OR_RETURN(job.sequences, simulated(arguments, folder.path(), progress_when));
  }
  Progress progress("sweeping", progress_when);
  return run_sweep(
      job, [&](std::size_t done, std::size_t total) { return progress.update(done, total); });
}

/// For `check`: OPTION=a,b,c.
CLI::Validator sweep_axis() {
  const auto check = [](const std::string& text) {
    const auto axis = parse_sweep_axis(text);
    return axis ? std::string() : to_string(axis.error());
  };
  return {check, "OPTION=a,b,c"};
}

/// What is given beside a sweep is meant for one of its maps.
/// Throws: CLI::ValidationError where the option is swept without the value that takes the file.
void refuse_idle_file(const std::vector<std::string>& axes,
                      const char* flag,
                      const std::string& option,
                      const std::string& value) {
  const bool is_idle = std::ranges::any_of(axes, [&](const std::string& text) {
    const auto axis = parse_sweep_axis(text);
    return axis && axis->option == option &&
           std::ranges::find(axis->values, value) == axis->values.end();
  });
  if (!is_idle) return;
  throw CLI::ValidationError(flag, "is used by no map: " + option + " is swept without " + value);
}

std::vector<std::string> score_cells(const SweepScores& scores) {
  return {fixed(scores.f1, 3),
          fixed(scores.precision, 3),
          fixed(scores.recall, 3),
          fixed(scores.jaccard, 3),
          fixed(scores.label_precision, 3),
          fixed(scores.label_recall, 3),
          fixed(scores.distance_m, 3)};
}

void print_sweep(const SweepReport& report) {
  std::vector<std::string> heading;
  for (const SweepAxis& axis : report.axes) heading.push_back(axis.option);
  for (const char* name :
       {"of", "F1", "precision", "recall", "Jaccard", "label prec.", "label rec.", "distance m"}) {
    heading.emplace_back(name);
  }
  heading[report.axes.size()] = "of " + std::to_string(report.sequences.size());
  Table table(heading);
  for (const SweepPoint& point : report.points) {
    for (const auto& [name, scores] : {std::pair("mean", point.mean), {"worst", point.worst}}) {
      std::vector<std::string> row = point.values;
      row.emplace_back(name);
      for (std::string& cell : score_cells(scores)) row.push_back(std::move(cell));
      table.add(std::move(row));
    }
  }
  std::printf("%s", table.text().c_str());
}

}  // namespace

void SweepArguments::add_to(CLI::App& command) {
  auto* asked = command.add_option(
      "--sweep", axes, "map and evaluate with each value; several make a grid; instead of --frame");
  asked->check(sweep_axis());
  command.add_option("--scene", scene, "with --sweep: of the sequences that are simulated")
      ->capture_default_str()
      ->needs(asked);
  command.add_option("--seeds", seeds, "with --sweep: of these sequences, separated by commas")
      ->delimiter(',')
      ->default_str("1,2,3,4,5")
      ->needs(asked);
  command.add_option("--frames", num_frames, "with --sweep: of each of them")
      ->check(value_of_field(option_table(SimulationOptions{}), "num_frames"))
      ->capture_default_str()
      ->needs(asked);
  command
      .add_option("--places",
                  places,
                  "with --sweep: FILE of what belongs where, for the maps whose prior.source is "
                  "places: all, unless it is swept (indoor)")
      ->needs(asked);
  command
      .add_option("--combiner",
                  combiner,
                  "with --sweep: FILE of `combine`, for the maps whose stacking.rule is trained: "
                  "all, unless it is swept")
      ->needs(asked);
  auto* given_truth =
      command
          .add_option(
              "--truth", truth, "with --sweep: of --input, which is mapped instead of these")
          ->needs(asked);
  auto* others =
      command
          .add_option("--also", also, "with --sweep: DATASET TRUTH, a further one; may be repeated")
          ->needs(asked);
  for (const char* of_simulated : {"--scene", "--seeds", "--frames"}) {
    command.get_option(of_simulated)->excludes(given_truth)->excludes(others);
  }
  for (const char* of_a_frame : {"--frame", "--detection", "--output"}) {
    asked->excludes(command.get_option(of_a_frame));
  }
  command.add_flag("--json", json, "with --sweep and --times: one JSON document");
}

void SweepArguments::keep_to_rules() const {
  std::set<std::uint64_t> known;
  for (const std::uint64_t seed : seeds) {
    if (known.insert(seed).second) continue;
    throw CLI::ValidationError(
        "--seeds", "must name each seed once, names " + std::to_string(seed) + " twice");
  }
  if (!places.empty()) refuse_idle_file(axes, "--places", "prior.source", "places");
  if (combiner) refuse_idle_file(axes, "--combiner", "stacking.rule", "trained");
}

ExitCode sweep(const SweepArguments& arguments,
               const DatasetArguments& dataset,
               const std::vector<std::string>& detections,
               const MapOptions& options,
               const std::string& progress_when) {
  const auto report_or_error = swept(arguments, dataset, detections, options, progress_when);
  if (!report_or_error) return report(report_or_error.error());
  if (arguments.json) {
    std::printf("%s\n", to_json(*report_or_error).c_str());
  } else {
    print_sweep(*report_or_error);
  }
  return ExitCode::kDone;
}

}  // namespace hypermap::app
