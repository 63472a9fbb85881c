// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"
#include "hypermap/io/jobs/split_job.hpp"
#include "load_arguments.hpp"
#include "number_lists.hpp"
#include "outputs.hpp"
#include "part_text.hpp"
#include "progress.hpp"
#include "tables.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>

namespace hypermap::app {
namespace {

struct SplitArguments {
  std::string file;
  double edge_m = SplitJob{}.edge_m;
  std::string output;
  LoadArguments load;
};

void print_tiles(const SplitReport& split) {
  Table table({"tile", "x m", "y m", "voxels", "objects"});
  for (const MapTile& tile : split.tiles) {
    table.add({tile.file,
               fixed(tile.area.min.x(), 1),
               fixed(tile.area.min.y(), 1),
               std::to_string(tile.num_voxels),
               std::to_string(tile.num_objects)});
  }
  std::fputs(table.text().c_str(), stdout);
}

ExitCode run_split_command(const SplitArguments& arguments, const std::string& progress_when) {
  const auto whole = load_archive(
      arguments.file, arguments.load.limits, archive_layer_types(), stop_when_interrupted());
  if (!whole) return report(whole.error());
  const SplitJob job{
      .edge_m = arguments.edge_m, .output = arguments.output, .limits = arguments.load.limits};
  Progress progress("splitting", progress_when);
  const auto split = run_split(whole->value, job, [&](std::size_t done, std::size_t total) {
    return progress.update(done, total);
  });
  if (!split) {
    const bool is_of_edge = split.error().field == "edge_m";
    return report(is_of_edge ? of_option(split.error(), "--tile") : split.error());
  }
  print_tiles(*split);
  ExitCode worst = warn_of_left_out("split", split->left_out);
  for (const Finding& finding : whole->findings) worst = std::max(worst, report(finding));
  return worst;
}

}  // namespace

void add_split_command(CLI::App& program, const CommonOptions& common, Action& action) {
  auto arguments = std::make_shared<SplitArguments>();
  CLI::App& command =
      *program.add_subcommand("split", "A map as a folder of archives, one for each square");
  command.add_option("map", arguments->file, "archive")->required();
  command
      .add_option(
          "--tile", arguments->edge_m, "m; edge of the squares, with corners at its multiples")
      ->check(number_in(0.1, 1e5))
      ->capture_default_str();
  command
      .add_option("--output",
                  arguments->output,
                  "folder to write, with tiles.json, which says what lies where; one of earlier "
                  "tiles is replaced")
      ->required();
  arguments->load.add_to(command);
  show_examples(command, {"hypermap split building.hmap --tile 20 --output building"});
  command.callback([arguments, &common, &action] {
    keep_out_of_datasets("--output", arguments->output);
    action = [arguments, &common] { return run_split_command(*arguments, common.progress); };
  });
}

}  // namespace hypermap::app
