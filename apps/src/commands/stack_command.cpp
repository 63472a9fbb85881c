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

/// A stack, its combined map and where both were written.
struct WrittenStack {
  GridStack stack;
  LogOddsGrid combined;
  std::vector<std::filesystem::path> files;
  std::optional<SensedStackReport> sensed;
};

Pooling pooling_of(const std::string& name) {
  const auto names = pooling_names();
  return static_cast<Pooling>(std::ranges::find(names, name) - names.begin());
}

Result<WrittenStack> write_stack(const StackCommand& arguments) {
  HYPERMAP_TRY(check_stack_folder(arguments.output));
  HYPERMAP_ASSIGN_OR_RETURN(StackOfFile made, arguments.stack.make());
  GridStack stack = made.stack;
  std::optional<SensedStackReport> sensed = made.sensed;
  HYPERMAP_ASSIGN_OR_RETURN(LogOddsGrid combined, pooled(stack, pooling_of(arguments.pooling)));
  HYPERMAP_ASSIGN_OR_RETURN(const auto saved, arguments.stack.save(std::move(made), {}));
  auto files = write_stack_maps(stack, combined, arguments.output);
  if (!files) return Unexpected(with_written(files.error(), saved));
  files->insert(files->end(), saved.begin(), saved.end());
  return WrittenStack{std::move(stack), std::move(combined), std::move(*files), std::move(sensed)};
}

/// Cells of which more is said for, and more against.
Json grid_json(const std::string& name, const LogOddsGrid& grid) {
  const auto num_for = std::ranges::count_if(grid.cells(), [](auto steps) { return steps > 0; });
  const auto num_known = static_cast<std::ptrdiff_t>(grid.num_known());
  return {{"name", name},
          {"occupied", num_for},
          {"free", num_known - num_for},
          {"unknown", static_cast<std::ptrdiff_t>(grid.cells().size()) - num_known}};
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
  const GridGeometry& geometry = written.stack.geometry();
  Json layers = Json::array();
  for (const auto& [name, grid] : written.stack.layers()) layers.push_back(grid_json(name, grid));
  Json files = Json::array();
  for (const auto& path : written.files) files.push_back(path.string());
  Json document = {{"frame", written.stack.options().frame_id},
                   {"resolution_m", geometry.resolution_m},
                   {"origin", {geometry.origin.x(), geometry.origin.y(), geometry.yaw_rad}},
                   {"cols", geometry.cols},
                   {"rows", geometry.rows},
                   {"layers", std::move(layers)},
                   {"pooling", pooling},
                   {"combined", grid_json("combined", written.combined)},
                   {"files", std::move(files)}};
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

void print_layer(const std::string& name, const LogOddsGrid& grid) {
  const Json counts = grid_json(name, grid);
  std::printf("%s: %ld cells occupied, %ld free, %ld unknown\n",
              printable(name).c_str(),
              counts["occupied"].get<long>(),
              counts["free"].get<long>(),
              counts["unknown"].get<long>());
}

ExitCode run_stack(const StackCommand& arguments) {
  const auto written = write_stack(arguments);
  if (!written) return report(written.error());
  const ExitCode worst = report_skipped(written->sensed);
  if (arguments.json) {
    const Json document = stack_json(*written, arguments.pooling);
    std::printf("%s\n", document.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
    return worst;
  }
  if (written->sensed) print_sensed(*written->sensed);
  for (const auto& [name, grid] : written->stack.layers()) print_layer(name, grid);
  print_layer("combined (" + arguments.pooling + ")", written->combined);
  if (written->stack.geometry().yaw_rad != 0.0) {
    std::printf("the maps are turned back by %.3f degrees and padded with unknown cells\n",
                written->stack.geometry().yaw_rad * 180.0 / std::numbers::pi);
  }
  for (const auto& path : written->files) std::printf("%s\n", path.c_str());
  return worst;
}

}  // namespace

void add_stack_command(CLI::App& program, Action& action) {
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
  command.add_option("--pool", arguments->pooling, "how layers become the combined map")
      ->transform(one_of(pooling_names()))
      ->capture_default_str();
  command.add_flag("--json", arguments->json, "one JSON document");
  show_examples(command,
                {"hypermap stack lab.hmap --output grids",
                 "hypermap stack lab.hmap --class chair,sofa --fuse occupancy=0.5 --resolution 0.1 "
                 "--pool bayesian --output grids",
                 "hypermap stack lab.hmap --input lab --sensor depth,detections=0.5 --output grids",
                 "hypermap stack --tiles drive --area 10,10,16,16 --output grids"});
  command.callback([arguments, &action] {
    keep_apart(
        "--output",
        arguments->output,
        {arguments->stack.file, arguments->stack.tiles, arguments->stack.sensed.dataset.input});
    arguments->stack.finish();
    action = [arguments] { return run_stack(*arguments); };
  });
}

}  // namespace hypermap::app
