// SPDX-License-Identifier: BSD-3-Clause
#include "choices.hpp"
#include "class_names.hpp"
#include "command.hpp"
#include "data_dir.hpp"
#include "hypermap/io/archive/asked_of_map.hpp"
#include "hypermap/io/archive/hashed_image_name.hpp"
#include "hypermap/io/archive/vocabulary_file.hpp"
#include "hypermap/io/exports/map_export.hpp"
#include "hypermap/io/options/palette_file.hpp"
#include "hypermap/io/options/place_rules_file.hpp"
#include "hypermap/io/options/relation_rules_file.hpp"
#include "load_arguments.hpp"
#include "number_lists.hpp"
#include "outputs.hpp"
#include "places.hpp"

#include <CLI/Validators.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <utility>

namespace hypermap::app {
namespace {

struct ExportArguments {
  std::string file;
  std::string format;
  std::string palette;
  std::string rules;
  std::string zones;
  std::string places;
  std::string area;
  ClassNames class_names;
  ExportRequest request;
  LoadArguments load;
};

std::filesystem::path zones_file(const std::string& given) {
  return given.empty() ? data_dir() / "nav2.yaml" : std::filesystem::path(given);
}

bool is_wanted(const MapArchive& archive, const ExportRequest& request, const std::string& name) {
  return request.classes.empty() ||
         std::ranges::any_of(request.classes, [&](const std::string& text) {
           const auto meant = asked_of_map(archive, text);
           return meant && meant->contains(name);
         });
}

/// Whether any shape that is written has a rule, so that masks are not all empty.
bool has_zones(const MapArchive& archive, const ExportRequest& request) {
  for (const Layer& layer : archive.hypermap.layers()) {
    const auto* shapes = layer.content.as<SemanticLayer>();
    if (shapes == nullptr) continue;
    for (const SemanticObject& shape : shapes->objects()) {
      const bool has_rule = zone_rule_of(shape.name, request.zones, archive.vocabulary).has_value();
      if (has_rule && is_wanted(archive, request, shape.name)) return true;
    }
  }
  return false;
}

/// What the user may want to know of an export that was done.
void remark(const MapArchive& archive, const ExportRequest& request) {
  if (request.format == ExportFormat::kClassGrids && archive.class_grids.empty()) {
    std::fprintf(stderr,
                 "export: the map has no class grids: these are made from the footprints in its "
                 "semantic layer\n");
  }
  if (request.format == ExportFormat::kNav2 && !has_zones(archive, request)) {
    std::fprintf(stderr,
                 "export: no zone is for a class of the map that was asked for (--zones, --class, "
                 "--class-names): both masks are empty\n");
  }
}

/// Warns of classes of the user's own files that nobody knows.
ExitCode warn_of_files(const MapArchive& archive,
                       const ExportArguments& arguments,
                       const ExportRequest& request) {
  std::vector<std::string> of_zones;
  if (!arguments.zones.empty()) {
    for (const auto& [name, rule] : request.zones.of_class) of_zones.push_back(name);
  }
  return std::max(
      warn_of_unknown_classes(archive, arguments.zones, of_zones),
      warn_of_unknown_classes(archive, arguments.palette, request.palette.class_names()));
}

/// The files that were written, and whether there was anything to warn of.
struct Exported {
  std::vector<std::filesystem::path> files;
  ExitCode findings = ExitCode::kDone;
};

Result<Exported> run(const ExportArguments& arguments) {
  ExportRequest request = arguments.request;
  if (!arguments.palette.empty()) {
    HYPERMAP_ASSIGN_OR_RETURN(request.palette, read_palette(arguments.palette));
  }
  if (!arguments.rules.empty()) {
    HYPERMAP_ASSIGN_OR_RETURN(request.rules, read_relation_options(arguments.rules));
  }
  if (request.format == ExportFormat::kTopologicalMap) {
    HYPERMAP_ASSIGN_OR_RETURN(request.place_rules, read_place_rules(places_file(arguments.places)));
  }
  if (request.format == ExportFormat::kNav2) {
    HYPERMAP_ASSIGN_OR_RETURN(request.zones, read_zone_rules(zones_file(arguments.zones)));
  }
  HYPERMAP_ASSIGN_OR_RETURN(
      auto loaded,
      load_archive(
          arguments.file, arguments.load.limits, archive_layer_types(), stop_when_interrupted()));
  HYPERMAP_TRY(arguments.class_names.replace(loaded.value.vocabulary));
  if (request.format == ExportFormat::kNav2 && loaded.value.vocabulary.empty()) {
    HYPERMAP_ASSIGN_OR_RETURN(loaded.value.vocabulary,  // a robot keeps off chairs as off seats
                              read_vocabulary(data_dir() / "vocabulary.yaml"));
  }
  auto written = export_map(loaded.value, request);
  if (!written) return Unexpected(with_source(written.error(), {arguments.file}));
  remark(loaded.value, request);
  return Exported{.files = std::move(*written),
                  .findings = warn_of_files(loaded.value, arguments, request)};
}

/// Throws: CLI::ValidationError for a text that is no polygon.
Polygon sub_map_area_of(const std::string& text) {
  auto ring = parse_points(text, "--area");
  if (!ring) throw CLI::ValidationError("--area", ring.error().what);
  auto area = make_polygon(*std::move(ring));
  if (!area) throw CLI::ValidationError("--area", area.error().what);
  return *std::move(area);
}

/// Whether the output names a map of map_server, whose image beside it no dataset takes for one of
/// its own. That image's name depends on what is in it; where one would be in the way, all would
/// be. Throws: CLI::ValidationError.
void check_ros_map_output(const std::filesystem::path& output) {
  const std::string name = output.filename().string();
  if (name.empty() || name == "." || name == ".." || name == "-") {
    throw CLI::ValidationError(
        "--output",
        "must be the name of a file, with a folder or without, is " + printable(output.string()));
  }
  const std::filesystem::path yaml = ros_map_yaml(output);
  if (!dataset_fault(yaml.parent_path() / hashed_image_name(yaml.stem().string(), ""))) return;
  throw CLI::ValidationError(
      "--output",
      "the image beside it would be read as one of a dataset's: " + printable(output.string()));
}

/// Whether the options go together, and the output is no input. Throws: CLI::ValidationError.
void check(const ExportArguments& arguments) {
  const ExportFormat format = arguments.request.format;
  const auto& output = arguments.request.output;
  const bool is_ros_map = format == ExportFormat::kRosMap;
  keep_apart("--output",
             is_ros_map ? ros_map_yaml(output) : output,
             {arguments.file,
              arguments.palette,
              arguments.rules,
              arguments.zones,
              arguments.places,
              arguments.class_names.file});
  if (is_ros_map) check_ros_map_output(output);
  const bool is_folder = format == ExportFormat::kClassGrids || format == ExportFormat::kViews ||
                         format == ExportFormat::kNav2;
  if (is_folder) keep_out_of_datasets("--output", output);
  const auto fits = validate(arguments.request);
  if (!fits) throw CLI::ValidationError(fits.error().field, fits.error().what);
  const bool has_relations = format == ExportFormat::kGeojson || format == ExportFormat::kRelations;
  if (!arguments.rules.empty() && !has_relations) {
    throw CLI::ValidationError(
        "--rules",
        "goes with --format geojson and relations, not with --format " + arguments.format);
  }
  if (!arguments.places.empty() && format != ExportFormat::kTopologicalMap) {
    throw CLI::ValidationError(
        "--places", "goes with --format topological-map, not with --format " + arguments.format);
  }
  if (!arguments.zones.empty() && format != ExportFormat::kNav2) {
    throw CLI::ValidationError("--zones",
                               "goes with --format nav2, not with --format " + arguments.format);
  }
}

}  // namespace

void add_export_command(CLI::App& program, Action& action) {
  auto arguments = std::make_shared<ExportArguments>();
  CLI::App& command =
      *program.add_subcommand("export", "A map in the forms that other programs read");
  command.add_option("file", arguments->file, "archive or configuration")->required();
  command.add_option("--format", arguments->format, "of the output")
      ->required()
      ->transform(one_of(export_format_names()));
  command
      .add_option(
          "--output",
          arguments->request.output,
          "file; for ros-map the stem or .yaml (the image beside it is named after its "
          "content), for class-grids, tiles, views and nav2 a folder, for geojson a name in "
          ".local.geojson, for relations such a name or one in .dot, for topological-map one in "
          ".dot, for glb one in .glb, for geopackage one in .gpkg")
      ->required();
  command.add_option(
      "--layer", arguments->request.layer, "2D layer (default: the first that fits)");
  command
      .add_option("--class",
                  arguments->request.classes,
                  "only these classes, as query --string takes them, separated by commas; may be "
                  "repeated")
      ->delimiter(',');
  command.add_flag(
      "--keep-rotation", arguments->request.keep_rotation, "grids keep the yaw of their origin");
  command.add_flag("--without-objects",
                   arguments->request.without_objects,
                   "ros-map: the floor that the map's objects stand on is free");
  command.add_option("--area",
                     arguments->area,
                     "ros-map: polygon \"x y,x y,x y,...\", metres: only cells whose interior it "
                     "meets");
  command.add_option(
      "--frame", arguments->request.area_frame_id, "of --area (default: the layer's)");
  command.add_flag("--complete",
                   arguments->request.complete,
                   "geojson: also a guess of the box of objects that were seen from few sides");
  command.add_flag("--with-voxels",
                   arguments->request.with_voxels,
                   "glb: each object also has its voxels, which the surface then lacks");
  arguments->load.add_to(command);
  command.add_option("--palette", arguments->palette, kPaletteHelp);
  command.add_option("--rules", arguments->rules, kRulesHelp);
  command.add_option("--zones",
                     arguments->zones,
                     "nav2: YAML file of where robots keep out and go slowly by classes (default: "
                     "data/nav2.yaml)");
  command.add_option("--places",
                     arguments->places,
                     "topological-map: YAML file with what belongs where, by which vertices bear "
                     "the class of their place (default: data/places.yaml)");
  arguments->class_names.add_to(command);
  show_examples(
      command,
      {"hypermap export lab.hmap --format ros-map --output lab_map",
       "hypermap export lab.hmap --format ros-map --without-objects --output lab_floor",
       "hypermap export lab.hmap --format ros-map --area \"0 0,4 0,4 3,0 3\" --output corner",
       "hypermap export lab.hmap --format ply --class chair --output chairs.ply",
       "hypermap export lab.hmap --format relations --output lab.dot",
       "hypermap export lab.hmap --format glb --with-voxels --output lab.glb",
       "hypermap export lab.hmap --format nav2 --output lab_nav2",
       "hypermap export lab.hmap --format geopackage --output lab.gpkg"});
  command.callback([arguments, &action] {
    arguments->request.format = parse_export_format(arguments->format).value();
    if (!arguments->area.empty()) arguments->request.area = sub_map_area_of(arguments->area);
    check(*arguments);
    action = [arguments] {
      const auto written = run(*arguments);
      if (!written) return report(written.error());
      for (const auto& path : written->files) std::printf("%s\n", path.c_str());
      if (!written->files.empty()) return written->findings;
      std::fprintf(stderr, "export: the map has nothing of that: no file was written\n");
      return ExitCode::kFindings;
    };
  });
}

}  // namespace hypermap::app
