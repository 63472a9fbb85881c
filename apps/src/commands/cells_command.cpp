// SPDX-License-Identifier: BSD-3-Clause
#include "cells_text.hpp"
#include "cells_way.hpp"
#include "command.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/io/archive/supercell_layer.hpp"
#include "hypermap/io/exports/map_stack.hpp"
#include "hypermap/io/exports/supercell_export.hpp"
#include "hypermap/io/options/palette_file.hpp"
#include "hypermap/projection/stack/asked_layers.hpp"
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
#include <set>
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
  bool known = false;
  bool json = false;
};

/// Full names of the graph's layers that an option's text asks for.
Result<std::vector<std::string>> layers_of(const char* option,
                                           const std::string& text,
                                           const StackOfFile& made,
                                           const CellsCommand& arguments) {
  ClassVocabulary vocabulary = made.map.vocabulary;
  HYPERMAP_TRY(arguments.stack.class_names.replace(vocabulary));
  auto names = asked_layers(text, made.stack, vocabulary);
  if (!names) return Unexpected(of_option(names.error(), option));
  return names;
}

/// The supercells of any of the layers, ascending.
Result<std::vector<int>> found_of(const TopometricGraph& graph,
                                  const std::vector<std::string>& layers,
                                  double at_least) {
  std::set<int> all;
  for (const std::string& layer : layers) {
    HYPERMAP_ASSIGN_OR_RETURN(const auto found, supercells_of(graph, layer, Probability(at_least)));
    all.insert(found.begin(), found.end());
  }
  return std::vector<int>(all.begin(), all.end());
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

Result<WayRequest> way_asked_for(const CellsCommand& arguments, const StackOfFile& made) {
  WayRequest request{.ends = *arguments.path, .known = arguments.known};
  if (arguments.avoid) {
    HYPERMAP_ASSIGN_OR_RETURN(request.avoid,
                              layers_of("--avoid", *arguments.avoid, made, arguments));
  }
  return request;
}

/// Errors: kInvalidArgument for a folder with a stack's maps, which a later stack would not replace
/// for what cells puts there.
Result<void> check_cells_folder(const std::filesystem::path& folder) {
  HYPERMAP_ASSIGN_OR_RETURN(const bool has_stack, holds_stack_maps(folder));
  if (!has_stack) return {};
  return Unexpected(Error{ErrorCode::kInvalidArgument,
                          "holds the maps of 'stack': cells needs another",
                          folder.string()});
}

Result<CellsAnswer> find_cells(const CellsCommand& arguments, const CommonOptions& common) {
  HYPERMAP_TRY(check_cells_folder(arguments.output));
  ClassPalette palette;
  if (!arguments.palette.empty()) {
    HYPERMAP_ASSIGN_OR_RETURN(palette, read_palette(arguments.palette));
  }
  HYPERMAP_ASSIGN_OR_RETURN(StackOfFile made, arguments.stack.make(common));
  CellsAnswer answer;
  answer.sensed = made.sensed;
  HYPERMAP_ASSIGN_OR_RETURN(answer.supercells, extract_supercells(made.stack, arguments.options));
  HYPERMAP_ASSIGN_OR_RETURN(answer.graph, topometric_graph(made.stack, answer.supercells));
  answer.without_supercell = layers_without_supercell(made.stack, answer.graph);
  if (arguments.of_layer) {
    HYPERMAP_ASSIGN_OR_RETURN(const auto layers,
                              layers_of("--of", *arguments.of_layer, made, arguments));
    HYPERMAP_ASSIGN_OR_RETURN(answer.of_layer, found_of(answer.graph, layers, arguments.at_least));
  }
  if (arguments.path) {
    HYPERMAP_ASSIGN_OR_RETURN(const WayRequest asked, way_asked_for(arguments, made));
    HYPERMAP_ASSIGN_OR_RETURN(answer.way,
                              find_way(made.stack, answer.supercells, answer.graph, asked));
    answer.cells_without_class = made.cells_without_class;
  }
  HYPERMAP_ASSIGN_OR_RETURN(const auto saved, save_cells(answer, std::move(made), arguments.stack));
  auto files = write_supercells(answer.supercells, answer.graph, arguments.output, palette);
  if (!files) return Unexpected(with_written(files.error(), saved));
  answer.files = std::move(*files);
  answer.files.insert(answer.files.end(), saved.begin(), saved.end());
  return answer;
}

/// What is wrong with an end of the way.
std::string why_avoided(const AvoidedEnd& end) {
  const std::string number = std::to_string(end.supercell);
  const std::string place = std::string("its ") + end.name + " " + end.place;
  const std::string so = " more probably of " + printable(end.layer) + " than not";
  return end.is_of_supercell
             ? place + " lies in supercell " + number + ", which is" + so
             : place + " lies in a cell that is" + so + ", as supercell " + number + " is not";
}

ExitCode report_avoided_ends(const CellsAnswer& answer) {
  ExitCode worst = ExitCode::kDone;
  if (!answer.way) return worst;
  for (const AvoidedEnd& end : answer.way->avoided_ends) {
    worst = report({Severity::kWarning,
                    {.code = ErrorCode::kInvalidArgument,
                     .what = why_avoided(end) + ": the way touches there what --avoid names",
                     .field = "--path"}});
  }
  return worst;
}

ExitCode report_unknown(const CellsAnswer& answer, const CellsCommand& arguments) {
  if (!answer.way || answer.way->unknown.empty()) return ExitCode::kDone;
  const std::size_t num_unknown = answer.way->unknown.size();
  return report({Severity::kWarning,
                 {.code = ErrorCode::kInvalidArgument,
                  .what = std::to_string(num_unknown) + " of the way's " +
                          count_text(answer.way->path->nodes.size(), "supercell") +
                          (num_unknown == 1 ? " is" : " are") +
                          " unknown: no layer says anything of more than half of their cells" +
                          (arguments.known ? "; --known keeps the ends of the way where they are"
                                           : "; --known leads around them"),
                  .field = "--path"}});
}

ExitCode run_cells(const CellsCommand& arguments, const CommonOptions& common) {
  const auto answer = find_cells(arguments, common);
  if (!answer) return report(answer.error());
  arguments.json ? print_cells_json(*answer) : print_cells_text(*answer);
  const bool is_path_missing = answer->way && !answer->way->path;
  if (is_path_missing) std::fprintf(stderr, "cells: no way leads there\n");
  if (answer->way) tell_cells_without_class("cells", answer->cells_without_class);
  const ExitCode worst = std::max({report_skipped(answer->sensed),
                                   report_avoided_ends(*answer),
                                   report_unknown(*answer, arguments)});
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

void add_cells_command(CLI::App& program, const CommonOptions& common, Action& action) {
  auto arguments = std::make_shared<CellsCommand>();
  CLI::App& command = *program.add_subcommand(
      "cells", "Regions of a map that are of one kind, and the graph of them");
  arguments->stack.add_to(command);
  command.add_option("--output", arguments->output, "folder for image, DOT and GeoJSON")
      ->required();
  add_supercell_options(command, arguments->options);
  CLI::Option* of_layer = command.add_option(
      "--of",
      arguments->of_layer,
      "which supercells are of this layer, or of a class as query --string takes it");
  command.add_option("--at-least", arguments->at_least, "probability by which they are")
      ->check(number_in(0.0, 1.0))
      ->needs(of_layer)
      ->capture_default_str();
  CLI::Option* path = command.add_option("--path",
                                         arguments->path,
                                         "X,Y,X,Y: the shortest way over supercells, from the "
                                         "first point to the second, through unknown "
                                         "ones too, which is said");
  command
      .add_option("--avoid",
                  arguments->avoid,
                  "layer that the way must not lead through, or a class as query --string takes "
                  "it; its two "
                  "ends may lie in it, which is said")
      ->needs(path);
  command.add_flag("--known", arguments->known, "the way must not lead through unknown supercells")
      ->needs(path);
  command.add_option("--palette", arguments->palette, kPaletteHelp);
  command.add_flag("--json", arguments->json, "one JSON document");
  show_examples(command,
                {"hypermap cells lab.hmap --output cells",
                 "hypermap cells lab.hmap --fuse occupancy --path 0,-1.8,-1,1.5 --avoid occupancy "
                 "--total --output cells"});
  command.callback([arguments, &common, &action] {
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
    action = [arguments, &common] { return run_cells(*arguments, common); };
  });
}

}  // namespace hypermap::app
