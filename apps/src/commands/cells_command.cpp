// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/io/archive/supercell_layer.hpp"
#include "hypermap/io/exports/supercell_export.hpp"
#include "hypermap/io/options/palette_file.hpp"
#include "hypermap/projection/supercells/supercells.hpp"
#include "hypermap/projection/supercells/topometric_graph.hpp"
#include "number_lists.hpp"
#include "option_flags.hpp"
#include "outputs.hpp"
#include "stack_arguments.hpp"

#include <CLI/Validators.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hypermap::app {
namespace {

using Json = nlohmann::ordered_json;

struct CellsCommand {
  StackArguments stack;
  SupercellOptions options;
  std::string output;
  std::string palette;
  std::optional<std::string> of_layer;
  double at_least = 0.5;
  std::optional<std::string> path;
  std::optional<std::string> avoid;
  bool json = false;
};

/// What was found, written and asked.
struct CellsAnswer {
  Supercells supercells;
  TopometricGraph graph;
  std::vector<std::filesystem::path> files;
  std::optional<std::vector<int>> of_layer = {};
  bool is_path_asked = false;
  std::optional<GraphPath> path = {};
  std::optional<SensedStackReport> sensed = {};
};

/// The supercell at a place that was asked for. Errors: kNotFound outside the grid.
Result<int> supercell_below(const Supercells& supercells, double x, double y) {
  if (const auto number = supercell_at(supercells, {x, y})) return *number;
  return fail(ErrorCode::kNotFound,
              "no cell is at " + std::to_string(x) + ", " + std::to_string(y),
              "--path");
}

Result<std::vector<int>> found_of(const TopometricGraph& graph,
                                  const CellsCommand& arguments,
                                  const std::string& layer,
                                  double at_least) {
  return supercells_of(graph,
                       full_layer_name(arguments.stack.request.of_classes.options, layer),
                       Probability(at_least));
}

/// A way that leads through no supercell that is more probably of the layer to avoid than not.
Result<std::optional<GraphPath>> path_asked_for(const CellsAnswer& answer,
                                                const CellsCommand& arguments) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto ends, parse_numbers(*arguments.path, 4, 4, "--path"));
  HYPERMAP_ASSIGN_OR_RETURN(const int from, supercell_below(answer.supercells, ends[0], ends[1]));
  HYPERMAP_ASSIGN_OR_RETURN(const int to, supercell_below(answer.supercells, ends[2], ends[3]));
  if (!arguments.avoid) return shortest_path(answer.graph, from, to);
  const std::string name =
      full_layer_name(arguments.stack.request.of_classes.options, *arguments.avoid);
  HYPERMAP_TRY(supercells_of(answer.graph, name));
  const auto place = static_cast<std::size_t>(std::ranges::find(answer.graph.layers, name) -
                                              answer.graph.layers.begin());
  return shortest_path(answer.graph, from, to, [place](const SupercellNode& node) {
    return node.mean[place] <= LogOdds();
  });
}

Result<std::vector<std::filesystem::path>> save_cells(const CellsAnswer& answer,
                                                      StackOfFile made,
                                                      const StackArguments& arguments) {
  if (!arguments.archive) return std::vector<std::filesystem::path>{};
  HYPERMAP_ASSIGN_OR_RETURN(SupercellLayer layer,
                            SupercellLayer::create(answer.supercells, answer.graph));
  std::vector<Layer> layers;
  layers.push_back(
      {LayerInfo{.name = std::string(kSupercellLayer), .frame_id = made.stack.options().frame_id},
       std::move(layer)});
  return arguments.save(std::move(made), std::move(layers));
}

Result<CellsAnswer> find_cells(const CellsCommand& arguments) {
  ClassPalette palette;
  if (!arguments.palette.empty()) {
    HYPERMAP_ASSIGN_OR_RETURN(palette, read_palette(arguments.palette));
  }
  HYPERMAP_ASSIGN_OR_RETURN(StackOfFile made, arguments.stack.make());
  CellsAnswer answer;
  answer.sensed = made.sensed;
  HYPERMAP_ASSIGN_OR_RETURN(answer.supercells, extract_supercells(made.stack, arguments.options));
  HYPERMAP_ASSIGN_OR_RETURN(answer.graph, topometric_graph(made.stack, answer.supercells));
  if (arguments.of_layer) {
    HYPERMAP_ASSIGN_OR_RETURN(
        answer.of_layer,
        found_of(answer.graph, arguments, *arguments.of_layer, arguments.at_least));
  }
  answer.is_path_asked = arguments.path.has_value();
  if (answer.is_path_asked) {
    HYPERMAP_ASSIGN_OR_RETURN(answer.path, path_asked_for(answer, arguments));
  }
  HYPERMAP_ASSIGN_OR_RETURN(
      answer.files, write_supercells(answer.supercells, answer.graph, arguments.output, palette));
  HYPERMAP_ASSIGN_OR_RETURN(const auto saved, save_cells(answer, std::move(made), arguments.stack));
  answer.files.insert(answer.files.end(), saved.begin(), saved.end());
  return answer;
}

void print_cells_json(const CellsAnswer& answer) {
  Json files = Json::array();
  for (const auto& path : answer.files) files.push_back(path.string());
  Json document{{"frame", answer.graph.frame_id},
                {"supercells", answer.supercells.count},
                {"layers", answer.graph.layers},
                {"moves", answer.supercells.num_moves},
                {"first_energy", answer.supercells.first_energy},
                {"energy", answer.supercells.energy},
                {"files", std::move(files)}};
  if (answer.of_layer) document["of"] = *answer.of_layer;
  if (answer.is_path_asked) {
    document["path"] =
        answer.path ? Json{{"supercells", answer.path->nodes}, {"length_m", answer.path->length_m}}
                    : Json();
  }
  std::printf("%s\n", document.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

std::string list_of(const std::vector<int>& numbers) {
  std::string text;
  for (const int number : numbers) text += (text.empty() ? "" : ", ") + std::to_string(number);
  return text.empty() ? "none" : text;
}

void print_cells_text(const CellsAnswer& answer) {
  std::printf("%s, %s, energy %.6f, of the squares %.6f\n",
              count_text(static_cast<std::size_t>(answer.supercells.count), "supercell").c_str(),
              count_text(answer.supercells.num_moves, "move").c_str(),
              answer.supercells.energy,
              answer.supercells.first_energy);
  if (answer.of_layer) std::printf("found: %s\n", list_of(*answer.of_layer).c_str());
  if (answer.path) {
    std::printf("path: %s; %.3f m\n", list_of(answer.path->nodes).c_str(), answer.path->length_m);
  }
  for (const auto& path : answer.files) std::printf("%s\n", path.c_str());
}

ExitCode run_cells(const CellsCommand& arguments) {
  const auto answer = find_cells(arguments);
  if (!answer) return report(answer.error());
  arguments.json ? print_cells_json(*answer) : print_cells_text(*answer);
  const bool is_path_missing = answer->is_path_asked && !answer->path;
  if (is_path_missing) std::fprintf(stderr, "cells: no way leads there\n");
  const ExitCode worst = report_skipped(answer->sensed);
  return is_path_missing ? std::max(worst, ExitCode::kFindings) : worst;
}

void add_supercell_options(CLI::App& command, SupercellOptions& options) {
  const OptionTable& table = option_table(options);
  command
      .add_option("--levels", options.num_levels, "the first supercells have edges of 2^n cells")
      ->check(value_of_field(table, "num_levels"))
      ->capture_default_str();
  command.add_option("--bins", options.num_bins, "probabilities are told apart by 1 / this")
      ->check(value_of_field(table, "num_bins"))
      ->capture_default_str();
  command.add_option("--contour-weight", options.contour_weight, "larger makes outlines smoother")
      ->check(value_of_field(table, "contour_weight"))
      ->capture_default_str();
  command.add_option("--max-passes", options.max_passes, "over all blocks of one size")
      ->check(value_of_field(table, "max_passes"))
      ->capture_default_str();
  command.add_flag("--total",
                   options.total,
                   "both supercells together must gain by a move, not the growing one alone");
  command.add_flag("--cell-weighted",
                   options.cell_weighted,
                   "variances count by cells, both sides gain, small blocks move: outlines keep to "
                   "those of objects");
}

}  // namespace

void add_cells_command(CLI::App& program, Action& action) {
  auto arguments = std::make_shared<CellsCommand>();
  CLI::App& command = *program.add_subcommand(
      "cells", "Regions of a map that are of one kind, and the graph of them");
  arguments->stack.add_to(command);
  command.add_option("--output", arguments->output, "folder for image, DOT and GeoJSON")
      ->required();
  add_supercell_options(command, arguments->options);
  CLI::Option* of_layer =
      command.add_option("--of", arguments->of_layer, "which supercells are of this layer");
  command.add_option("--at-least", arguments->at_least, "probability by which they are")
      ->check(number_in(0.0, 1.0))
      ->needs(of_layer)
      ->capture_default_str();
  CLI::Option* path = command.add_option(
      "--path", arguments->path, "X,Y,X,Y: the shortest way from supercell to supercell");
  command.add_option("--avoid", arguments->avoid, "layer that the way must not lead through")
      ->needs(path);
  command.add_option("--palette", arguments->palette, kPaletteHelp);
  command.add_flag("--json", arguments->json, "one JSON document");
  show_examples(command,
                {"hypermap cells lab.hmap --output cells",
                 "hypermap cells lab.hmap --fuse occupancy --path 0.5,0.5,3,2 --avoid occupancy "
                 "--total --output cells"});
  command.callback([arguments, &action] {
    keep_apart("--output",
               arguments->output,
               {arguments->stack.file,
                arguments->stack.tiles,
                arguments->palette,
                arguments->stack.sensed.dataset.input});
    arguments->stack.finish();
    if (arguments->path) {
      const auto ends = parse_numbers(*arguments->path, 4, 4, "--path");
      if (!ends) throw CLI::ValidationError("--path", ends.error().what);
    }
    action = [arguments] { return run_cells(*arguments); };
  });
}

}  // namespace hypermap::app
