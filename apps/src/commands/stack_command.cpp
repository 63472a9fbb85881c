// SPDX-License-Identifier: BSD-3-Clause
#include "choices.hpp"
#include "command.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/io/exports/map_stack.hpp"
#include "hypermap/projection/stack/stack_services.hpp"
#include "outputs.hpp"
#include "stack_arguments.hpp"

#include <CLI/Validators.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace hypermap::app {
namespace {

using Json = nlohmann::ordered_json;

struct StackCommand {
  StackArguments stack;
  std::string output;
  std::string pooling = "maximum";
  bool json = false;
};

/// Cells of a layer, or of the combined map.
struct GridCounts {
  std::string name;
  std::size_t occupied = 0;  ///< More is said for than against, as free and unknown say.
  std::size_t free = 0;
  std::size_t unknown = 0;
  OccupancyCounts map;  ///< As map_server reads them, by its thresholds.
};

/// What was made of a map and where it was written.
struct WrittenStack {
  GridGeometry geometry;
  std::string frame_id;
  std::vector<GridCounts> layers;
  GridCounts combined;
  std::vector<std::filesystem::path> files;
  std::optional<SensedStackReport> sensed;
  std::optional<std::size_t> cells_without_class;  ///< As num_cells_without_class.
};

Pooling pooling_of(const std::string& name) {
  const auto names = pooling_names();
  return static_cast<Pooling>(std::ranges::find(names, name) - names.begin());
}

Result<GridCounts> counts_of(const std::string& name, const LogOddsGrid& grid) {
  HYPERMAP_ASSIGN_OR_RETURN(const OccupancyGrid map, trinary_cells(grid));
  const auto num_for = std::ranges::count_if(grid.cells(), [](auto steps) { return steps > 0; });
  const auto occupied = static_cast<std::size_t>(num_for);
  return GridCounts{.name = name,
                    .occupied = occupied,
                    .free = grid.num_known() - occupied,
                    .unknown = grid.cells().size() - grid.num_known(),
                    .map = map.counts()};
}

Result<WrittenStack> write_stack(const StackCommand& arguments, const CommonOptions& common) {
  HYPERMAP_TRY(check_stack_folder(arguments.output));
  HYPERMAP_ASSIGN_OR_RETURN(StackOfFile made, arguments.stack.make(common));
  const GridStack stack = made.stack;
  WrittenStack written{.geometry = stack.geometry(),
                       .frame_id = stack.options().frame_id,
                       .layers = {},
                       .combined = {},
                       .files = {},
                       .sensed = made.sensed,
                       .cells_without_class = made.cells_without_class};
  HYPERMAP_ASSIGN_OR_RETURN(const LogOddsGrid combined,
                            pooled(stack, pooling_of(arguments.pooling)));
  HYPERMAP_ASSIGN_OR_RETURN(const auto saved, arguments.stack.save(std::move(made), {}));
  auto files = write_stack_maps(stack, combined, arguments.output);
  if (!files) return Unexpected(with_written(files.error(), saved));
  written.files = std::move(*files);
  written.files.insert(written.files.end(), saved.begin(), saved.end());
  for (const auto& [name, grid] : stack.layers()) {
    HYPERMAP_ASSIGN_OR_RETURN(GridCounts counts, counts_of(name, grid));
    written.layers.push_back(std::move(counts));
  }
  HYPERMAP_ASSIGN_OR_RETURN(written.combined, counts_of("combined", combined));
  return written;
}

Json grid_json(const GridCounts& counts) {
  return {{"name", counts.name},
          {"occupied", counts.occupied},
          {"free", counts.free},
          {"unknown", counts.unknown},
          {"map",
           {{"occupied", counts.map.occupied},
            {"free", counts.map.free},
            {"unknown", counts.map.unknown}}}};
}

Json sensed_json(const SensedStackReport& sensed) {
  Json refused = Json::object();
  for (const auto& [reason, count] : sensed.num_refused) refused[reason] = count;
  return {{"frames", sensed.num_frames},
          {"skipped", sensed.skipped.size()},
          {"registered", sensed.num_registered},
          {"refused", std::move(refused)},
          {"mean_shift_m", sensed.mean_shift_m},
          {"max_shift_m", sensed.max_shift_m}};
}

Json stack_json(const WrittenStack& written, const std::string& pooling) {
  const GridGeometry& geometry = written.geometry;
  Json layers = Json::array();
  for (const GridCounts& layer : written.layers) layers.push_back(grid_json(layer));
  Json files = Json::array();
  for (const auto& path : written.files) files.push_back(path.string());
  Json document = {{"frame", written.frame_id},
                   {"resolution_m", geometry.resolution_m},
                   {"origin", {geometry.origin.x(), geometry.origin.y(), geometry.yaw_rad}},
                   {"cols", geometry.cols},
                   {"rows", geometry.rows},
                   {"layers", std::move(layers)},
                   {"pooling", pooling},
                   {"combined", grid_json(written.combined)},
                   {"files", std::move(files)}};
  if (written.cells_without_class) document["cells_without_class"] = *written.cells_without_class;
  if (written.sensed) document["sensed"] = sensed_json(*written.sensed);
  return document;
}

void print_sensed(const SensedStackReport& sensed) {
  std::printf("fused %s", count_text(sensed.num_frames, "frame").c_str());
  if (sensed.num_registered > 0) {
    std::printf(", %zu of them registered, moved by %.3f m on average and %.3f m at most",
                sensed.num_registered,
                sensed.mean_shift_m,
                sensed.max_shift_m);
  }
  std::printf("\n");
  for (const auto& [reason, count] : sensed.num_refused) {
    std::printf("not registered, fused as posed: %s, %s (%s)\n",
                count_text(count, "frame").c_str(),
                std::string(refusal_text(reason)).c_str(),
                reason.c_str());
  }
}

void print_layer(const GridCounts& counts) {
  std::printf("%s: %s occupied, %zu free, %zu unknown; in its map %zu, %zu, %zu\n",
              printable(counts.name).c_str(),
              count_text(counts.occupied, "cell").c_str(),
              counts.free,
              counts.unknown,
              counts.map.occupied,
              counts.map.free,
              counts.map.unknown);
}

/// Says on stderr when the combined map has less than one of its layers.
void tell_outvoted(const WrittenStack& written) {
  const auto most = std::ranges::max_element(written.layers, {}, &GridCounts::occupied);
  if (most == written.layers.end() || written.combined.occupied >= most->occupied) return;
  std::fprintf(stderr,
               "stack: combined has %s occupied where %s has %zu: what other layers say against a "
               "cell outvotes it; --pool maximum keeps it\n",
               count_text(written.combined.occupied, "cell").c_str(),
               printable(most->name).c_str(),
               most->occupied);
}

ExitCode run_stack(const StackCommand& arguments, const CommonOptions& common) {
  const auto written = write_stack(arguments, common);
  if (!written) return report(written.error());
  const ExitCode worst = report_skipped(written->sensed);
  tell_cells_without_class("stack", written->cells_without_class);
  tell_outvoted(*written);
  if (arguments.json) {
    const Json document = stack_json(*written, arguments.pooling);
    std::printf("%s\n", document.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
    return worst;
  }
  if (written->sensed) print_sensed(*written->sensed);
  for (const GridCounts& layer : written->layers) print_layer(layer);
  GridCounts combined = written->combined;
  combined.name += " (" + arguments.pooling + ")";
  print_layer(combined);
  if (written->geometry.yaw_rad != 0.0) {
    std::printf("the maps are turned back by %.3f degrees and padded with unknown cells\n",
                written->geometry.yaw_rad * 180.0 / std::numbers::pi);
  }
  for (const auto& path : written->files) std::printf("%s\n", path.c_str());
  return worst;
}

}  // namespace

void add_stack_command(CLI::App& program, const CommonOptions& common, Action& action) {
  auto arguments = std::make_shared<StackCommand>();
  CLI::App& command = *program.add_subcommand(
      "stack", "A map as semantic occupancy grids: a layer for each class, and all of them pooled");
  arguments->stack.add_to(command);
  command
      .add_option("--output",
                  arguments->output,
                  "folder for maps of map_server; one that holds those of an earlier stack, and "
                  "nothing else, is "
                  "replaced as a whole")
      ->required();
  command
      .add_option("--pool",
                  arguments->pooling,
                  "how layers become the combined map: maximum takes the largest evidence of a "
                  "cell, bayesian the sum of it, in which many layers that say free outvote one "
                  "that says occupied")
      ->transform(one_of(pooling_names()))
      ->capture_default_str();
  command.add_flag("--json", arguments->json, "one JSON document");
  show_examples(command,
                {"hypermap stack lab.hmap --output grids",
                 "hypermap stack lab.hmap --class chair,sofa --fuse occupancy=0.5 --resolution 0.1 "
                 "--pool bayesian --output grids",
                 "hypermap stack lab.hmap --input lab --sensor depth,detections=0.5 --output grids",
                 "hypermap stack --tiles drive --area 10,10,16,16 --output grids"});
  command.callback([arguments, &common, &action] {
    keep_apart(
        "--output",
        arguments->output,
        {arguments->stack.file, arguments->stack.tiles, arguments->stack.sensed.dataset.input});
    arguments->stack.finish();
    action = [arguments, &common] { return run_stack(*arguments, common); };
  });
}

}  // namespace hypermap::app
