// SPDX-License-Identifier: BSD-3-Clause
#include "class_names.hpp"
#include "command.hpp"
#include "hypermap/core/vocabulary/asked_names.hpp"
#include "hypermap/io/archive/archive_layers.hpp"
#include "hypermap/io/archive/asked_of_map.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/codec/png_image.hpp"
#include "hypermap/io/options/palette_file.hpp"
#include "hypermap/viewer_offscreen/snapshot/layer_scene.hpp"
#include "hypermap/viewer_offscreen/snapshot/map_scene.hpp"
#include "hypermap/viewer_offscreen/snapshot/snapshot.hpp"
#include "load_arguments.hpp"
#include "number_lists.hpp"
#include "outputs.hpp"

#include <CLI/Validators.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hypermap::app {
namespace {

struct SnapshotArguments {
  std::string file;
  std::string output;
  std::string view = "iso";
  std::string size = "1280x720";
  std::optional<std::string> layers;
  std::optional<std::string> title;
  std::optional<double> cut_above_m;
  LoadArguments load;
  std::string palette;
  std::vector<std::string> classes;
  ClassNames class_names;
};

Result<SnapshotOptions> options_of(const SnapshotArguments& arguments) {
  SnapshotOptions options;
  HYPERMAP_ASSIGN_OR_RETURN(options.view, parse_snapshot_view(arguments.view));
  HYPERMAP_ASSIGN_OR_RETURN(const SnapshotSize size, parse_image_size(arguments.size));
  options.width_px = size.width_px;
  options.height_px = size.height_px;
  if (arguments.layers) {
    HYPERMAP_ASSIGN_OR_RETURN(options.layers, parse_snapshot_layers(*arguments.layers));
  }
  options.cut_above_m = arguments.cut_above_m;
  HYPERMAP_TRY(validate(options));
  return options;
}

/// The names that were asked for. Errors: those of asked_of_map; kNotFound for a text that asks for
/// nothing in the map.
Result<NameSelection> classes_to_show(const MapArchive& archive,
                                      const SnapshotArguments& arguments) {
  const std::vector<std::string> known = names_in(archive);
  for (const std::string& text : arguments.classes) {
    const auto names = asked_of_map(archive, text);
    if (!names) return Unexpected(of_option(names.error(), "--class"));
    const auto is_asked = [&](const std::string& name) { return names->contains(name); };
    if (std::ranges::any_of(known, is_asked)) continue;
    return fail(ErrorCode::kNotFound, nothing_asked(text, known, archive.vocabulary), "--class");
  }
  return asked_of_map(archive, arguments.classes);
}

/// What the map's layers draw. The topological map lies over all that stands on the floor: it is
/// drawn where the overlay is asked for by name.
SnapshotScene scene_of(const MapArchive& archive,
                       std::span<const Object* const> objects,
                       const SnapshotOptions& options) {
  SnapshotScene scene = map_scene(
      archive.hypermap, archive.classes, objects, shown_leaves(archive), shown_frame_id(archive));
  if (archive.floor != MapFloor{}) scene.floor_m = archive.floor.height_m;
  const auto ways = archive_layer(archive, kTopologicalMapLayer);
  if (!ways || !options.layers || !options.layers->overlay) return scene;
  return with_layer(std::move(scene), *ways, archive.hypermap.frames());
}

/// What the user may want to know of an image that was written.
struct Drawn {
  std::vector<std::string> left_out;  ///< Layers of the map.
  ExitCode findings = ExitCode::kDone;
};

Result<Drawn> run(const SnapshotArguments& arguments, const SnapshotOptions& options) {
  ClassPalette palette;
  if (!arguments.palette.empty()) {
    HYPERMAP_ASSIGN_OR_RETURN(palette, read_palette(arguments.palette));
  }
  HYPERMAP_ASSIGN_OR_RETURN(
      auto loaded,
      load_archive(
          arguments.file, arguments.load.limits, archive_layer_types(), stop_when_interrupted()));
  HYPERMAP_TRY(arguments.class_names.replace(loaded.value.vocabulary));
  const MapArchive& archive = loaded.value;
  const auto confirmed = confirmed_objects_of(archive);
  SnapshotScene scene = scene_of(archive, confirmed, options);
  if (!arguments.classes.empty()) {
    HYPERMAP_ASSIGN_OR_RETURN(const NameSelection names, classes_to_show(archive, arguments));
    scene = only_named(std::move(scene), names);
  }
  scene.num_tentative = archive.objects.size() - confirmed.size();
  scene.palette = palette;
  scene.title = arguments.title.value_or(std::filesystem::path(arguments.file).filename().string());
  HYPERMAP_ASSIGN_OR_RETURN(const ColorImage image, render_snapshot(scene, options));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, encode_png(image));
  HYPERMAP_TRY(write_file_atomically(arguments.output, bytes));
  return Drawn{
      .left_out = std::move(scene.left_out),
      .findings = warn_of_unknown_classes(archive, arguments.palette, palette.class_names())};
}

}  // namespace

void add_snapshot_command(CLI::App& program, Action& action) {
  auto arguments = std::make_shared<SnapshotArguments>();
  CLI::App& command = *program.add_subcommand("snapshot", "An image of a map, without a screen");
  command.add_option("file", arguments->file, "archive or configuration")->required();
  command.add_option("--output", arguments->output, "PNG to write")->required();
  command.add_option("--view", arguments->view, "iso, top, or a camera pose \"x y z qx qy qz qw\"")
      ->capture_default_str();
  command.add_option("--size", arguments->size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  command.add_option(
      "--layers",
      arguments->layers,
      "voxels,objects,occupancy,semantic,trajectory,overlay or all (default: by view); overlay "
      "draws stacks and supercells in the colours of their classes, which the legend leaves out, "
      "by default where no occupancy grid would lie under them, and, where it is asked for, the "
      "topological map: its edges, path vertices as squares, support vertices as crosses");
  command
      .add_option("--class",
                  arguments->classes,
                  "only objects, shapes and voxels of these classes, as query --string takes them, "
                  "separated by commas; may be repeated")
      ->delimiter(',');
  arguments->class_names.add_to(command);
  command.add_option("--palette", arguments->palette, kPaletteHelp);
  command.add_option("--title", arguments->title, "text over the image (default: file name)");
  command
      .add_option("--cut-above", arguments->cut_above_m, "hide what is higher (default: ceiling)")
      ->check(number_in(-10000.0, 10000.0));
  arguments->load.add_to(command);
  show_examples(
      command,
      {"hypermap snapshot lab.hmap --output lab.png",
       "hypermap snapshot lab.hmap --view top --layers occupancy,semantic --output plan.png"});
  command.callback([arguments, &action] {
    keep_apart("--output",
               arguments->output,
               {arguments->file, arguments->palette, arguments->class_names.file});
    keep_suffix("--output", arguments->output, ".png");
    auto options = options_of(*arguments);
    if (!options) throw CLI::ValidationError("--" + options.error().field, options.error().what);
    action = [arguments, options = *options] {
      const auto done = run(*arguments, options);
      if (!done) return report(done.error());
      std::printf("%s\n", arguments->output.c_str());
      for (const std::string& layer : done->left_out) {
        std::fprintf(stderr, "warning: not drawn: %s\n", layer.c_str());
      }
      return done->left_out.empty() ? done->findings : ExitCode::kFindings;
    };
  });
}

}  // namespace hypermap::app
