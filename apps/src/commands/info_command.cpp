// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"
#include "dataset_arguments.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/archive/archive_floor.hpp"
#include "hypermap/io/archive/archive_info.hpp"
#include "hypermap/io/archive/archive_sizes.hpp"
#include "hypermap/io/archive/map_sessions.hpp"
#include "hypermap/io/archive/supercell_layer.hpp"
#include "hypermap/io/check/file_info.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "load_arguments.hpp"
#include "provenance_text.hpp"
#include "sizes_text.hpp"
#include "tables.hpp"
#include "time_arguments.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace hypermap::app {
namespace {

using Json = nlohmann::ordered_json;

struct InfoArguments {
  std::string file;
  std::optional<std::string> description;
  bool json = false;
  bool sizes = false;
  LoadArguments load;
};

/// " on 2 layers: /ism/chair, /ism/sofa"; nothing of what has no layers in it.
std::string parts_text(const LayerSummary& layer) {
  std::string names;
  for (const std::string& part : layer.parts)
    names += (names.empty() ? "" : ", ") + printable(part);
  return names.empty() ? names : " on " + count_text(layer.parts.size(), "layer") + ": " + names;
}

std::string size_text(const LayerSummary& layer) {
  if (layer.cells) {
    return std::to_string(layer.cells->occupied) + " occupied, " +
           std::to_string(layer.cells->free) + " free, " + std::to_string(layer.cells->unknown) +
           " unknown cells";
  }
  if (layer.num_objects) {
    const bool is_graph = layer.class_name == kSupercellLayerClass;
    std::string objects = count_text(*layer.num_objects, is_graph ? "supercell" : "object");
    if (layer.num_tentative.value_or(0) > 0) {
      objects += " (and " + std::to_string(*layer.num_tentative) + " tentative)";
    }
    return objects;
  }
  if (layer.leaves && layer.voxels) {
    std::string voxels = std::to_string(layer.voxels->occupied) + " occupied, " +
                         std::to_string(layer.voxels->free) + " free voxels";
    if (layer.leaves == layer.voxels) return voxels;
    return voxels + " in " + std::to_string(layer.leaves->occupied + layer.leaves->free) +
           " leaves";
  }
  if (layer.num_values) return count_text(*layer.num_values, "value");
  return "kept as it is";
}

std::string bounds_text(const LayerSummary& layer) {
  if (!layer.bounds) return "empty";
  const Eigen::Vector3d extent = layer.bounds->sizes();
  std::string text = fixed(extent.x(), 2) + " x " + fixed(extent.y(), 2);
  if (!layer.flat) text += " x " + fixed(extent.z(), 2);
  return text + " m";
}

/// "occupancy: 60 x 40 cells of 0.05 m from (-1.500, -1.000), turned by 0.00 degrees".
std::string lattice_text(const LayerSummary& layer) {
  const GridGeometry& grid = *layer.grid;
  return printable(layer.name) + ": " + std::to_string(grid.cols) + " x " +
         std::to_string(grid.rows) + " cells of " + number_text(grid.resolution_m) + " m from (" +
         fixed(grid.origin.x(), 3) + ", " + fixed(grid.origin.y(), 3) + "), turned by " +
         fixed(grid.yaw_rad * 180.0 / std::numbers::pi, 2) + " degrees";
}

/// "fixed: load_file false, enable_update false"; nothing where all flags are at their default.
std::string changed_flags_text(const LayerSummary& layer) {
  const LayerFlags flags = layer.flags.value_or(LayerFlags{});
  if (flags == LayerFlags{}) return "";
  std::string text;
  if (!flags.load_file) text += ", load_file false";
  if (flags.subscribe_mode) text += ", subscribe_mode true";
  if (!flags.enable_update) text += ", enable_update false";
  return printable(layer.name) + ": " + text.substr(2);
}

/// "morning: 0.0 s to 33.2 s, from lab".
std::string session_text(const MapSession& session) {
  std::string text = printable(name_of(session)) + ": ";
  if (session.first && session.last) {
    text += dated_text(*session.first) + " to " + dated_text(*session.last);
  } else {
    text += "times unknown";
  }
  return text + ", from " + printable(session.input);
}

/// How grids lie, which flags of layers are set, and what stacks and supercells are made of.
void print_parts(const ArchiveInfo& info) {
  for (const LayerSummary& layer : info.layers) {
    if (layer.grid) std::printf("%s\n", lattice_text(layer).c_str());
  }
  for (const LayerSummary& layer : info.layers) {
    const std::string flags = changed_flags_text(layer);
    if (!flags.empty()) std::printf("%s\n", flags.c_str());
  }
  for (const LayerSummary& layer : info.layers) {
    if (layer.parts.empty()) continue;
    std::printf("%s%s\n", printable(layer.name).c_str(), parts_text(layer).c_str());
  }
}

void print(const ArchiveInfo& info) {
  Table table({"layer", "class", "frame", "extent", "content"});
  for (const LayerSummary& layer : info.layers) {
    table.add({printable(layer.name),
               printable(layer.class_name),
               printable(layer.frame_id),
               bounds_text(layer),
               size_text(layer)});
  }
  std::printf("%s", table.text().c_str());
  std::printf("%zu %s, %s, format version %lld\n",
              info.classes.size(),
              info.classes.size() == 1 ? "class" : "classes",
              count_text(info.transforms.size(), "transform").c_str(),
              static_cast<long long>(info.format_version));
  print_parts(info);
  std::string relations;
  for (const RelationKind kind : kRelationKinds) {
    const std::size_t count = info.num_relations[static_cast<std::size_t>(kind)];
    if (count == 0) continue;
    relations +=
        (relations.empty() ? "" : ", ") + std::to_string(count) + " " + std::string(name_of(kind));
  }
  if (!relations.empty()) std::printf("relations of objects: %s\n", relations.c_str());
  for (const DetectorDescription& detector : info.detectors) {
    std::printf("detector %s\n", to_string(detector).c_str());
  }
  if (info.num_aliases + info.num_super_classes > 0) {
    std::printf("names of classes: %zu %s, %zu %s\n",
                info.num_aliases,
                info.num_aliases == 1 ? "alias" : "aliases",
                info.num_super_classes,
                info.num_super_classes == 1 ? "super-class" : "super-classes");
  }
  for (const ModelSummary& model : info.models) {
    std::printf("embeddings of %s: %s of %zu numbers\n",
                printable(model.model).c_str(),
                count_text(model.num_objects, "object").c_str(),
                model.dimension);
  }
  if (info.num_views > 0)
    std::printf("views of %s\n", count_text(info.num_views, "object").c_str());
  if (info.num_vertices > 0) {
    std::printf("topological map: %s, %s\n",
                info.num_vertices == 1 ? "1 vertex"
                                       : (std::to_string(info.num_vertices) + " vertices").c_str(),
                count_text(info.num_edges, "edge").c_str());
  }
  const bool has_height = !std::ranges::all_of(info.layers, &LayerSummary::flat);
  if (has_height) {
    std::printf("floor %s\n", text_of(info.floor).c_str());
  }
  for (const FrameTransform& transform : info.transforms) {
    std::printf("%s in %s: x %.3f m, y %.3f m, yaw %.2f degrees\n",
                printable(transform.child_frame_id).c_str(),
                printable(transform.frame_id).c_str(),
                transform.x_m,
                transform.y_m,
                transform.yaw_rad * 180.0 / std::numbers::pi);
  }
  for (const Provenance& run : info.provenance) {
    std::printf("%s\n", provenance_text(run).c_str());
  }
  for (const MapSession& session : sessions_of(info.provenance)) {
    std::printf("session %s\n", session_text(session).c_str());
  }
}

Json dataset_json(const DatasetSummary& summary) {
  const PinholeCamera& camera = summary.camera;
  return {{"layout", summary.layout},
          {"name", summary.name},
          {"frames", summary.num_frames},
          {"depth", summary.num_depth},
          {"color", summary.num_color},
          {"poses", summary.num_poses},
          {"detection_frames", summary.num_detection_frames},
          {"detections", summary.num_detections},
          {"depth_units_per_m", summary.depth_units_per_m},
          {"stamp_tolerance_s", summary.stamp_tolerance_s},
          {"camera",
           {{"width", camera.width_px},
            {"height", camera.height_px},
            {"fx", camera.fx_px},
            {"fy", camera.fy_px},
            {"cx", camera.cx_px},
            {"cy", camera.cy_px}}},
          {"unpaired", summary.unpaired}};
}

void print(const DatasetSummary& summary) {
  std::printf("%s: %s, %s (%zu depth, %zu colour, %s)\n",
              printable(summary.name).c_str(),
              summary.layout.c_str(),
              count_text(summary.num_frames, "frame").c_str(),
              summary.num_depth,
              summary.num_color,
              count_text(summary.num_poses, "pose").c_str());
  std::printf("camera %d x %d, fx %.2f fy %.2f cx %.2f cy %.2f, %.0f depth units a metre\n",
              summary.camera.width_px,
              summary.camera.height_px,
              summary.camera.fx_px,
              summary.camera.fy_px,
              summary.camera.cx_px,
              summary.camera.cy_px,
              summary.depth_units_per_m);
  std::printf("%s in %s, %s without partner\n",
              count_text(summary.num_detections, "detection").c_str(),
              count_text(summary.num_detection_frames, "frame").c_str(),
              count_text(summary.unpaired.size(), "file").c_str());
}

std::string to_json(const DatasetSummary& summary) {
  return dataset_json(summary).dump(2, ' ', false, Json::error_handler_t::replace);
}

ExitCode report_all(const std::vector<Finding>& findings) {
  ExitCode worst = ExitCode::kDone;
  for (const Finding& finding : findings) worst = std::max(worst, report(finding));
  return worst;
}

ExitCode show_sizes(const InfoArguments& arguments) {
  const auto loaded = load_archive(
      arguments.file, arguments.load.limits, archive_layer_types(), stop_when_interrupted());
  if (!loaded) return report(loaded.error());
  const auto sizes = archive_sizes(loaded->value);
  if (!sizes) return report(with_source(sizes.error(), {arguments.file}));
  std::printf("%s%s",
              (arguments.json ? to_json(*sizes) : sizes_text(*sizes)).c_str(),
              arguments.json ? "\n" : "");
  return report_all(loaded->findings);
}

ExitCode run(const InfoArguments& arguments) {
  const auto described = describe_file(
      arguments.file, arguments.load.limits, stop_when_interrupted(), arguments.description);
  if (!described) return report(described.error());
  const auto show = [&](const auto& info) {
    if (arguments.json) {
      std::printf("%s\n", to_json(info).c_str());
    } else {
      print(info);
    }
  };
  std::visit(show, described->value);
  return report_all(described->findings);
}

}  // namespace

void add_info_command(CLI::App& program, Action& action) {
  auto arguments = std::make_shared<InfoArguments>();
  CLI::App& command =
      *program.add_subcommand("info", "What is in an archive, octree, map_server YAML or dataset");
  command.add_option("file", arguments->file, "file, or folder of a dataset")->required();
  command.add_option("--dataset", arguments->description, kDescriptionHelp);
  command.add_flag(
      "--sizes", arguments->sizes, "of an archive: what each part of the map costs in it");
  command.add_flag("--json", arguments->json, "one JSON document");
  arguments->load.add_to(command);
  show_examples(
      command,
      {"hypermap info lab.hmap", "hypermap info lab --json", "hypermap info lab.hmap --sizes"});
  command.callback([arguments, &action] {
    action = [arguments] { return arguments->sizes ? show_sizes(*arguments) : run(*arguments); };
  });
}

}  // namespace hypermap::app
