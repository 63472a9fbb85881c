// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/archive_info.hpp"
#include "hypermap/io/archive/map_sessions.hpp"
#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/json_text.hpp"
#include "hypermap/io/codec/time_text.hpp"

#include <charconv>
#include <cmath>
#include <span>

namespace hypermap {
namespace {

std::string json_of(const Eigen::Vector3d& point, bool flat) {
  std::string text = "[" + json_number(point.x()) + "," + json_number(point.y());
  if (!flat) text += "," + json_number(point.z());
  return text + "]";
}

std::string json_of(const GridGeometry& grid) {
  return json_object({{"columns", std::to_string(grid.cols)},
                      {"rows", std::to_string(grid.rows)},
                      {"resolution_m", json_number(grid.resolution_m)},
                      {"origin",
                       "[" + json_number(grid.origin.x()) + "," + json_number(grid.origin.y()) +
                           "," + json_number(grid.yaw_rad) + "]"}});
}

std::string json_of(const LayerSummary& layer) {
  std::string text = json_object({{"name", json_quoted(layer.name)},
                                  {"class", json_quoted(layer.class_name)},
                                  {"frame_id", json_quoted(layer.frame_id)}});
  text.pop_back();  // the brace; what follows depends on the layer
  if (layer.flags) {
    const LayerFlags& flags = *layer.flags;
    text += std::string(",\"load_file\":") + (flags.load_file ? "true" : "false") +
            ",\"subscribe_mode\":" + (flags.subscribe_mode ? "true" : "false") +
            ",\"enable_update\":" + (flags.enable_update ? "true" : "false");
  }
  if (layer.cells)
    text += ",\"cells\":" + json_object({{"occupied", std::to_string(layer.cells->occupied)},
                                         {"free", std::to_string(layer.cells->free)},
                                         {"unknown", std::to_string(layer.cells->unknown)},
                                         {"between", std::to_string(layer.cells->between)}});
  if (layer.grid) text += ",\"grid\":" + json_of(*layer.grid);
  if (layer.num_objects) text += ",\"objects\":" + std::to_string(*layer.num_objects);
  if (layer.num_tentative) text += ",\"tentative\":" + std::to_string(*layer.num_tentative);
  for (const auto& [key, count] : {std::pair("leaves", layer.leaves), {"voxels", layer.voxels}}) {
    if (!count) continue;
    text += std::string(",\"") + key + "\":" +
            json_object({{"occupied", std::to_string(count->occupied)},
                         {"free", std::to_string(count->free)}});
  }
  if (layer.num_values) text += ",\"values\":" + std::to_string(*layer.num_values);
  if (!layer.parts.empty()) {
    text += ",\"parts\":" +
            json_array(layer.parts, [](const std::string& part) { return json_quoted(part); });
  }
  if (layer.bounds)
    text += ",\"bounds\":" + json_object({{"min", json_of(layer.bounds->min(), layer.flat)},
                                          {"max", json_of(layer.bounds->max(), layer.flat)}});
  return text + "}";
}

std::string json_of(const FrameTransform& transform) {
  return json_object({{"frame_id", json_quoted(transform.frame_id)},
                      {"child_frame_id", json_quoted(transform.child_frame_id)},
                      {"transform_pose",
                       "[" + json_number(transform.x_m) + "," + json_number(transform.y_m) + "," +
                           json_number(transform.yaw_rad) + "]"}});
}

/// A scalar as the number or truth value that it is, else as text.
std::string json_of_scalar(const ValueTree& scalar) {
  const std::string& text = scalar.text;
  if (scalar.quoted) return json_quoted(text);
  if (text == "true" || text == "false") return text;
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number =
      error == std::errc() && end == text.data() + text.size() && std::isfinite(number);
  return is_number ? json_number(number) : json_quoted(text);
}

// NOLINTNEXTLINE(misc-no-recursion): whoever read the tree bounded its depth
std::string json_of(const ValueTree& tree) {
  switch (tree.kind) {
    case ValueKind::kScalar:
      return json_of_scalar(tree);
    case ValueKind::kList:
      return json_array(tree.items, [](const ValueTree& item) { return json_of(item); });
    case ValueKind::kMap: {
      std::string text = "{";
      for (const auto& [key, value] : tree.entries) {
        if (text.size() > 1) text += ',';
        text += json_quoted(key) + ":" + json_of(value);
      }
      return text + "}";
    }
    case ValueKind::kNull:
      break;
  }
  return "null";
}

std::string name_or_null(const std::string& name) {
  return name.empty() ? "null" : json_quoted(name);
}

std::string seconds_or_null(const std::optional<Stamp>& stamp) {
  return stamp ? seconds_text(*stamp) : "null";
}

std::string json_of(const Provenance& provenance) {
  const Eigen::Matrix4d matrix = provenance.map_from_input.isometry().matrix();
  std::string rows;
  for (int r = 0; r < 4; ++r) {
    rows += r == 0 ? "[" : "],[";
    for (int c = 0; c < 4; ++c) rows += (c > 0 ? "," : "") + json_number(matrix(r, c));
  }
  return json_object({{"tool", json_quoted(provenance.tool)},
                      {"input", json_quoted(provenance.input)},
                      {"input_hash", json_quoted(provenance.input_hash)},
                      {"options", json_of(provenance.options)},
                      {"map_from_input", "[" + rows + "]]"},
                      {"world", json_quoted(provenance.world)},
                      {"next_frame_index", std::to_string(provenance.next_frame_index)},
                      {"session", name_or_null(provenance.session)}});
}

std::string json_of(const MapSession& session) {
  return json_object({{"number", std::to_string(session.number)},
                      {"name", name_or_null(session.name)},
                      {"input", json_quoted(session.input)},
                      {"first_s", seconds_or_null(session.first)},
                      {"last_s", seconds_or_null(session.last)}});
}

/// The newest run, with those before it.
std::string json_of_runs(std::span<const Provenance> runs) {
  if (runs.empty()) return "null";
  std::string text = json_of(runs.back());
  text.pop_back();
  text += ",\"earlier\":";
  text +=
      json_array(runs.first(runs.size() - 1), [](const Provenance& run) { return json_of(run); });
  return text + "}";
}

std::string json_of_classes(const std::vector<std::string>& names) {
  std::size_t id = 0;
  return json_array(names, [&id](const std::string& name) {
    return json_object({{"id", std::to_string(id++)}, {"name", json_quoted(name)}});
  });
}

std::string json_of_detectors(const std::vector<DetectorDescription>& detectors) {
  const auto text = [](const std::string& said) {
    return said.empty() ? std::string("null") : json_quoted(said);
  };
  std::size_t id = 0;
  return json_array(detectors, [&](const DetectorDescription& detector) {
    const auto name = [](const std::string& one) { return json_quoted(one); };
    return json_object(
        {{"id", std::to_string(id++)},
         {"name", json_quoted(detector.name)},
         {"type", text(detector.type)},
         {"architecture", text(detector.architecture)},
         {"classes", detector.classes.empty() ? "null" : json_array(detector.classes, name)}});
  });
}

std::string json_of_counts(const std::array<std::size_t, kRelationKinds.size()>& num_relations) {
  std::string text = "{";
  for (const RelationKind kind : kRelationKinds) {
    if (text.size() > 1) text += ',';
    text += json_quoted(key_of(kind)) + ":" +
            std::to_string(num_relations[static_cast<std::size_t>(kind)]);
  }
  return text + "}";
}

std::string json_of(const ModelSummary& model) {
  return json_object({{"model", json_quoted(model.model)},
                      {"dimension", std::to_string(model.dimension)},
                      {"objects", std::to_string(model.num_objects)}});
}

}  // namespace

std::string to_json(const ArchiveInfo& info) {
  const auto json = [](const auto& item) { return json_of(item); };
  return json_object({{"format_version", std::to_string(info.format_version)},
                      {"layers", json_array(info.layers, json)},
                      {"classes", json_of_classes(info.classes)},
                      {"detectors", json_of_detectors(info.detectors)},
                      {"class_names",
                       json_object({{"aliases", std::to_string(info.num_aliases)},
                                    {"super_classes", std::to_string(info.num_super_classes)}})},
                      {"transforms", json_array(info.transforms, json)},
                      {"relations", json_of_counts(info.num_relations)},
                      {"embeddings", json_array(info.models, json)},
                      {"views", std::to_string(info.num_views)},
                      {"topological_map",
                       json_object({{"vertices", std::to_string(info.num_vertices)},
                                    {"edges", std::to_string(info.num_edges)}})},
                      {"floor",
                       json_object({{"height_m", json_number(info.floor.height_m)},
                                    {"source", json_quoted(name_of(info.floor.source))}})},
                      {"sessions", json_array(sessions_of(info.provenance), json)},
                      {"provenance", json_of_runs(info.provenance)}});
}

}  // namespace hypermap
