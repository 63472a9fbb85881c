// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"
#include "edited_map.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/map_server.hpp"
#include "hypermap/io/archive/semantic_update_file.hpp"
#include "hypermap/io/archive/updated_shapes.hpp"
#include "hypermap/io/codec/file_kind.hpp"
#include "hypermap/projection/grids/grid_patch.hpp"
#include "load_arguments.hpp"
#include "outputs.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace hypermap::app {
namespace {

struct UpdateArguments {
  std::string file;
  std::string layer;
  std::string batch;
  std::string grid;
  std::string output;
  bool json = false;
  LoadArguments load;
};

/// What an update did, in words and as JSON, and what its file told of.
struct DoneUpdate {
  std::string text;
  nlohmann::ordered_json json;
  std::vector<Finding> findings;
};

/// The name of the layer as the map has it, or as it was given.
std::string layer_of(const UpdateArguments& arguments, const Hypermap& map) {
  std::string wanted = !arguments.layer.empty()  ? arguments.layer
                       : arguments.batch.empty() ? "occupancy"
                                                 : "semantic";
  if (map.find(wanted) != nullptr) return wanted;
  for (const Layer& layer : map.layers()) {
    if (is_spelling_of(layer.info.name, wanted)) return layer.info.name;
  }
  return wanted;
}

LoadBudget budget_of(const UpdateArguments& arguments) {
  return LoadBudget(arguments.load.limits.sums, stop_when_interrupted());
}

/// "3 objects added (ids 28, 29, 30), 1 modified, 2 deleted".
std::string text_of(const SemanticUpdateReport& report) {
  constexpr std::size_t kMaxShown = 10;
  std::string ids;
  for (std::size_t i = 0; i < std::min(report.added.size(), kMaxShown); ++i)
    ids += (i == 0 ? "" : ", ") + std::to_string(report.added[i]);
  if (report.added.size() > kMaxShown) ids += ", ...";
  return count_text(report.added.size(), "object") + " added" +
         (ids.empty() ? "" : " (" + ids + ")") + ", " + std::to_string(report.num_modified) +
         " modified, " + std::to_string(report.num_deleted) + " deleted";
}

Result<DoneUpdate> update_by_batch(const UpdateArguments& arguments, MapArchive& map) {
  HYPERMAP_ASSIGN_OR_RETURN(auto batch,
                            read_semantic_update(arguments.batch, {}, budget_of(arguments)));
  const std::string layer = layer_of(arguments, map.hypermap);
  const auto report = update_shapes(map, layer, std::move(batch.value));
  if (!report) return Unexpected(with_source(report.error(), {arguments.batch}));
  return DoneUpdate{.text = text_of(*report),
                    .json = {{"layer", layer},
                             {"added", report->added},
                             {"modified", report->num_modified},
                             {"deleted", report->num_deleted}},
                    .findings = std::move(batch.findings)};
}

Result<DoneUpdate> update_cells(const UpdateArguments& arguments, Hypermap& map) {
  HYPERMAP_ASSIGN_OR_RETURN(auto part,
                            read_map(arguments.grid,
                                     MapDialect::kMapServer,
                                     arguments.load.limits.reach,
                                     budget_of(arguments)));
  const std::string layer = layer_of(arguments, map);
  const OccupancyGrid& grid = part.value.grid;
  if (const auto done = map.update(layer, grid); !done)
    return Unexpected(with_source(done.error(), {arguments.grid}));
  // Invariant: the update found the layer and its place.
  const Cell first =
      *first_cell_of_part(map.find_as<OccupancyLayer>(layer)->grid.geometry(), grid.geometry());
  const GridGeometry& cells = grid.geometry();
  return DoneUpdate{.text = std::to_string(cells.cols) + " x " + std::to_string(cells.rows) +
                            " cells replaced from column " + std::to_string(first.col) + ", row " +
                            std::to_string(first.row) + " on",
                    .json = {{"layer", layer},
                             {"first_column", first.col},
                             {"first_row", first.row},
                             {"columns", cells.cols},
                             {"rows", cells.rows}},
                    .findings = std::move(part.findings)};
}

/// Where the changed map goes. Errors: kUnsupported for a file that is no archive, in whose place
/// none may be put.
Result<std::string> updated_file(const UpdateArguments& arguments) {
  if (!arguments.output.empty()) return arguments.output;
  HYPERMAP_ASSIGN_OR_RETURN(const FileKind kind, find_file_kind(arguments.file));
  if (kind == FileKind::kArchive) return arguments.file;
  return Unexpected(Error{.code = ErrorCode::kUnsupported,
                          .what = "is no archive: --output names the one to write",
                          .file = arguments.file});
}

ExitCode run_update(const UpdateArguments& arguments) {
  const auto target = updated_file(arguments);
  if (!target) return report(target.error());
  const auto update = [&](MapArchive map) -> Result<EditedMap> {
    HYPERMAP_ASSIGN_OR_RETURN(const DoneUpdate done,
                              arguments.batch.empty() ? update_cells(arguments, map.hypermap)
                                                      : update_by_batch(arguments, map));
    EditedMap edited{.map = std::move(map),
                     .text = (arguments.json ? done.json.dump(2) : done.text) + "\n"};
    for (const Finding& finding : done.findings) {
      edited.findings = std::max(edited.findings, report(finding));
    }
    return edited;
  };
  return run_edit(arguments.file, *target, arguments.load, update);
}

}  // namespace

void add_update_command(CLI::App& program, Action& action) {
  auto arguments = std::make_shared<UpdateArguments>();
  CLI::App& command = *program.add_subcommand(
      "update", "Changes to a layer of a map, all or none: shapes, or a part of a grid");
  command.add_option("map", arguments->file, "archive or configuration")->required();
  command.add_option(
      "--layer", arguments->layer, "which (default: semantic with --batch, occupancy with --grid)");
  auto* batch = command.add_option(
      "--batch",
      arguments->batch,
      "YAML file of shapes to add, of keys to modify by id, and of ids to delete (docs/UPDATE.md)");
  command
      .add_option("--grid",
                  arguments->grid,
                  "map_server YAML of a part of the grid: its cells take the place of those there")
      ->excludes(batch);
  command.add_option("--output", arguments->output, "archive to write (default: the file itself)");
  command.add_flag("--json", arguments->json, "one JSON document");
  arguments->load.add_to(command);
  show_examples(command,
                {"hypermap update lab.hmap --batch changes.yaml",
                 "hypermap update lab.hmap --layer plan --batch changes.yaml --output new.hmap",
                 "hypermap update lab.hmap --grid corner.yaml"});
  command.callback([arguments, &action] {
    if (arguments->batch.empty() && arguments->grid.empty())
      throw CLI::ValidationError("update", "needs --batch or --grid: what is to change");
    if (!arguments->output.empty()) {
      keep_apart("--output", arguments->output, {arguments->batch, arguments->grid});
      keep_suffix("--output", arguments->output, ".hmap");
    }
    action = [arguments] { return run_update(*arguments); };
  });
}

}  // namespace hypermap::app
