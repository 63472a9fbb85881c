// SPDX-License-Identifier: BSD-3-Clause
#include "class_names.hpp"
#include "command.hpp"
#include "diff_text.hpp"
#include "hypermap/core/base/option_table.hpp"
#include "hypermap/io/archive/archive_changes.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/archive/transformed_map.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/codec/png_image.hpp"
#include "hypermap/viewer_offscreen/snapshot/map_scene.hpp"
#include "hypermap/viewer_offscreen/snapshot/snapshot.hpp"
#include "load_arguments.hpp"
#include "option_flags.hpp"
#include "outputs.hpp"
#include "placement_argument.hpp"

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

struct DiffArguments {
  std::string before;
  std::string after;
  std::optional<std::string> transform;
  ClassNames class_names;
  ChangeOptions options;
  bool all = false;
  bool json = false;
  std::string output;
  std::string image;
  LoadArguments load;
};

/// Both maps, in one frame, and what changed.
struct ComparedArchives {
  MapArchive before;
  MapArchive after;
  ArchiveChanges found;
  std::vector<Finding> findings;
};

Result<Loaded<MapArchive>> load(const DiffArguments& arguments, const std::string& file) {
  HYPERMAP_ASSIGN_OR_RETURN(
      auto loaded,
      load_archive(file, arguments.load.limits, archive_layer_types(), stop_when_interrupted()));
  HYPERMAP_TRY(arguments.class_names.replace(loaded.value.vocabulary));
  return loaded;
}

/// The error names the map that its field stands for; any other field is of the later map.
Error of_file(Error error, const DiffArguments& arguments) {
  error.file = error.field == "before" ? arguments.before : arguments.after;
  if (error.field == "before" || error.field == "after") error.field.clear();
  return error;
}

Result<ComparedArchives> compare(const DiffArguments& arguments) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto placement, placement_of(arguments.transform));
  HYPERMAP_ASSIGN_OR_RETURN(auto before, load(arguments, arguments.before));
  HYPERMAP_ASSIGN_OR_RETURN(auto after, load(arguments, arguments.after));
  if (placement) {
    auto moved = transformed(after.value, MapFromOldMap(isometry_of(*placement)));
    if (!moved) return Unexpected(of_motion(of_file(moved.error(), arguments), "--transform"));
    after.value = std::move(*moved);
  }
  auto found = archive_changes(before.value, after.value, arguments.options);
  if (!found) return Unexpected(of_file(found.error(), arguments));
  before.findings.insert(before.findings.end(), after.findings.begin(), after.findings.end());
  return ComparedArchives{.before = std::move(before.value),
                          .after = std::move(after.value),
                          .found = std::move(*found),
                          .findings = std::move(before.findings)};
}

/// The later map from above with what changed, in place of its other layers.
Result<std::string> drawn(const ComparedArchives& compared,
                          const SemanticLayer& changes,
                          const DiffArguments& arguments) {
  SnapshotScene scene = map_scene(compared.after.hypermap,
                                  compared.after.classes,
                                  {},
                                  shown_leaves(compared.after),
                                  compared.found.frame_id);
  if (compared.after.floor != MapFloor{}) scene.floor_m = compared.after.floor.height_m;
  scene.overlay = {};
  scene.semantic.assign(changes.objects().begin(), changes.objects().end());
  scene.title = std::filesystem::path(arguments.before).filename().string() + " to " +
                std::filesystem::path(arguments.after).filename().string();
  HYPERMAP_ASSIGN_OR_RETURN(const ColorImage image, render_snapshot(scene, {.view = TopView{}}));
  return encode_png(image);
}

/// Writes what is asked for, and tells the files. The layer goes into a copy of the later map.
Result<std::vector<std::filesystem::path>> write_outputs(const ComparedArchives& compared,
                                                         const DiffArguments& arguments) {
  std::vector<std::filesystem::path> files;
  if (arguments.output.empty() && arguments.image.empty()) return files;
  HYPERMAP_ASSIGN_OR_RETURN(SemanticLayer changes,
                            changes_layer(compared.before, compared.after, compared.found));
  if (!arguments.image.empty()) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, drawn(compared, changes, arguments));
    HYPERMAP_TRY(write_file_atomically(arguments.image, bytes));
    files.emplace_back(arguments.image);
  }
  if (arguments.output.empty()) return files;
  MapArchive marked = compared.after;
  HYPERMAP_TRY(marked.hypermap.put_layer(
      {LayerInfo{.name = std::string(kChangesLayer), .frame_id = compared.found.frame_id},
       std::move(changes)}));
  if (auto saved = save_archive(marked, arguments.output, {.limits = arguments.load.limits});
      !saved) {
    return Unexpected(with_written(saved.error(), files));
  }
  files.emplace_back(arguments.output);
  return files;
}

ExitCode run_diff(const DiffArguments& arguments) {
  const auto compared = compare(arguments);
  if (!compared) return report(compared.error());
  const auto files = write_outputs(*compared, arguments);
  if (!files) return report(files.error());
  arguments.json ? print_changes_json(compared->before, compared->after, compared->found, *files)
                 : print_changes(compared->before, compared->after, compared->found, arguments.all);
  if (!arguments.json) {
    for (const auto& file : *files) std::printf("%s\n", file.string().c_str());
  }
  const bool is_changed = std::ranges::any_of(
      compared->found.changes, [](const auto& change) { return is_change(change.kind); });
  ExitCode worst = is_changed ? ExitCode::kFindings : ExitCode::kDone;
  for (const Finding& finding : compared->findings) worst = std::max(worst, report(finding));
  return worst;
}

void add_change_options(CLI::App& command, ChangeOptions& options) {
  const OptionTable& table = option_table(options);
  command
      .add_option("--same-place",
                  options.same_place_m,
                  "metres within which an object may be one that stayed, large ones farther")
      ->check(value_of_field(table, "same_place_m"))
      ->capture_default_str();
  command
      .add_option(
          "--max-move", options.max_move_m, "metres; what is farther away is another object")
      ->check(value_of_field(table, "max_move_m"))
      ->capture_default_str();
  command
      .add_option(
          "--min-known",
          options.min_known_share,
          "share of an object's place that the other map must know, or it was not looked at")
      ->check(value_of_field(table, "min_known_share"))
      ->capture_default_str();
  command
      .add_option("--min-free",
                  options.min_free_share,
                  "share of what is known there that must be free where nothing is")
      ->check(value_of_field(table, "min_free_share"))
      ->capture_default_str();
  command
      .add_option("--min-overlap",
                  options.min_overlap_share,
                  "of the boxes of two classes, over their union, where they are one thing")
      ->check(value_of_field(table, "min_overlap_share"))
      ->capture_default_str();
}

}  // namespace

void add_diff_command(CLI::App& program, Action& action) {
  auto arguments = std::make_shared<DiffArguments>();
  CLI::App& command = *program.add_subcommand("diff", "What changed between two maps of a place");
  command.add_option("before", arguments->before, "archive of the earlier map")->required();
  command.add_option("after", arguments->after, "archive of the later map")->required();
  command
      .add_option("--transform",
                  arguments->transform,
                  "X,Y,Z,YAW: where the later map's origin lies in the earlier map, metres and "
                  "degrees (default: both have one origin)")
      ->check(placement_text());
  add_change_options(command, arguments->options);
  arguments->class_names.add_to(command);
  command.add_flag("--all", arguments->all, "tells of what stayed, too");
  command.add_option("--output",
                     arguments->output,
                     "archive to write: the later map with what changed as layer changes");
  command.add_option("--image", arguments->image, "PNG to write: what changed, from above");
  command.add_flag("--json", arguments->json, "one JSON document");
  arguments->load.add_to(command);
  show_examples(command,
                {"hypermap diff monday.hmap tuesday.hmap",
                 "hypermap diff monday.hmap tuesday.hmap --image changes.png --output "
                 "changes.hmap"});
  command.callback([arguments, &action] {
    const std::vector<std::filesystem::path> inputs{
        arguments->before, arguments->after, arguments->class_names.file};
    keep_apart("--output", arguments->output, inputs);
    keep_apart("--image", arguments->image, inputs);
    if (!arguments->output.empty()) keep_suffix("--output", arguments->output, ".hmap");
    if (!arguments->image.empty()) keep_suffix("--image", arguments->image, ".png");
    action = [arguments] { return run_diff(*arguments); };
  });
}

}  // namespace hypermap::app
