// SPDX-License-Identifier: BSD-3-Clause
#include "cells_text.hpp"
#include "command.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/core/base/number_text.hpp"
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

std::string place_text(double x, double y) {
  return number_text(x) + "," + number_text(y);
}

/// The supercell at a place that was asked for. Errors: kNotFound outside the grid.
Result<int> supercell_below(const Supercells& supercells, double x, double y) {
  if (const auto number = supercell_at(supercells, {x, y})) return *number;
  return fail(ErrorCode::kNotFound,
              "no cell is at " + place_text(x, y) + ", there are cells in " +
                  corners_text(bounds(supercells.geometry)),
              "--path");
}

std::string full_name(const CellsCommand& arguments, const std::string& layer) {
  return full_layer_name(arguments.stack.request.of_classes.options, layer);
}

Result<std::vector<int>> found_of(const TopometricGraph& graph,
                                  const CellsCommand& arguments,
                                  const std::string& layer,
                                  double at_least) {
  auto found = supercells_of(graph, full_name(arguments, layer), Probability(at_least));
  if (!found) return Unexpected(of_option(found.error(), "--of"));
  return found;
}

/// The place of the layer to avoid among those of the graph. Errors: kNotFound.
Result<std::size_t> avoided_layer(const TopometricGraph& graph, const CellsCommand& arguments) {
  const std::string name = full_name(arguments, *arguments.avoid);
  const auto known = supercells_of(graph, name);
  if (!known) return Unexpected(of_option(known.error(), "--avoid"));
  return static_cast<std::size_t>(std::ranges::find(graph.layers, name) - graph.layers.begin());
}

/// Adds a way that leads through no supercell that is more probably of the layer to avoid than not.
/// Its ends are where they are: those in what is to be avoided are told.
Result<void> find_path(CellsAnswer& answer, const CellsCommand& arguments) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto ends, parse_numbers(*arguments.path, 4, 4, "--path"));
  HYPERMAP_ASSIGN_OR_RETURN(const int from, supercell_below(answer.supercells, ends[0], ends[1]));
  HYPERMAP_ASSIGN_OR_RETURN(const int to, supercell_below(answer.supercells, ends[2], ends[3]));
  if (!arguments.avoid) {
    answer.path = shortest_path(answer.graph, from, to);
    return {};
  }
  HYPERMAP_ASSIGN_OR_RETURN(const std::size_t avoided, avoided_layer(answer.graph, arguments));
  const auto is_passable = [avoided](const SupercellNode& node) {
    return node.mean[avoided] <= LogOdds();
  };
  for (const AvoidedEnd& end : {AvoidedEnd{"start", place_text(ends[0], ends[1]), from},
                                AvoidedEnd{"end", place_text(ends[2], ends[3]), to}}) {
    if (is_passable(answer.graph.nodes[static_cast<std::size_t>(end.supercell)])) continue;
    answer.avoided_ends.push_back(end);
  }
  answer.path = shortest_path(answer.graph, from, to, is_passable);
  return {};
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
  answer.without_supercell = layers_without_supercell(made.stack, answer.graph);
  if (arguments.of_layer) {
    HYPERMAP_ASSIGN_OR_RETURN(
        answer.of_layer,
        found_of(answer.graph, arguments, *arguments.of_layer, arguments.at_least));
  }
  answer.is_path_asked = arguments.path.has_value();
  if (answer.is_path_asked) {
    HYPERMAP_TRY(find_path(answer, arguments));
  }
  HYPERMAP_ASSIGN_OR_RETURN(const auto saved, save_cells(answer, std::move(made), arguments.stack));
  auto files = write_supercells(answer.supercells, answer.graph, arguments.output, palette);
  if (!files) return Unexpected(with_written(files.error(), saved));
  answer.files = std::move(*files);
  answer.files.insert(answer.files.end(), saved.begin(), saved.end());
  return answer;
}

ExitCode report_avoided_ends(const CellsAnswer& answer, const CellsCommand& arguments) {
  ExitCode worst = ExitCode::kDone;
  for (const AvoidedEnd& end : answer.avoided_ends) {
    worst =
        report({Severity::kWarning,
                {.code = ErrorCode::kInvalidArgument,
                 .what = std::string("its ") + end.name + " " + end.place + " lies in supercell " +
                         std::to_string(end.supercell) + ", which is more probably of " +
                         printable(full_name(arguments, *arguments.avoid)) +
                         " than not: the way touches there what --avoid names",
                 .field = "--path"}});
  }
  return worst;
}

ExitCode run_cells(const CellsCommand& arguments) {
  const auto answer = find_cells(arguments);
  if (!answer) return report(answer.error());
  arguments.json ? print_cells_json(*answer) : print_cells_text(*answer);
  const bool is_path_missing = answer->is_path_asked && !answer->path;
  if (is_path_missing) std::fprintf(stderr, "cells: no way leads there\n");
  const ExitCode worst =
      std::max(report_skipped(answer->sensed), report_avoided_ends(*answer, arguments));
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
  CLI::Option* total =
      command.add_flag("--total",
                       options.total,
                       "both supercells together must gain by a move, not the growing one alone");
  command
      .add_flag("--cell-weighted",
                options.cell_weighted,
                "variances count by cells, both sides gain, small blocks move: outlines keep to "
                "those of objects")
      ->excludes(total);
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
      "--path",
      arguments->path,
      "X,Y,X,Y: the shortest way over supercells, from the first point to the second");
  command
      .add_option(
          "--avoid",
          arguments->avoid,
          "layer that the way must not lead through; its two ends may lie in it, which is said")
      ->needs(path);
  command.add_option("--palette", arguments->palette, kPaletteHelp);
  command.add_flag("--json", arguments->json, "one JSON document");
  show_examples(command,
                {"hypermap cells lab.hmap --output cells",
                 "hypermap cells lab.hmap --fuse occupancy --path 1,-2,-1,1.5 --avoid occupancy "
                 "--total --output cells"});
  command.callback([arguments, &action] {
    keep_apart("--output",
               arguments->output,
               {arguments->stack.file,
                arguments->stack.tiles,
                arguments->palette,
                arguments->stack.sensed.dataset.input});
    keep_out_of_datasets("--output", arguments->output);
    arguments->stack.finish();
    if (arguments->path) {
      const auto ends = parse_numbers(*arguments->path, 4, 4, "--path");
      if (!ends) throw CLI::ValidationError("--path", ends.error().what);
    }
    action = [arguments] { return run_cells(*arguments); };
  });
}

}  // namespace hypermap::app
