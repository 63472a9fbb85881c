// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/exports/supercell_export.hpp"

#include "dot_text.hpp"
#include "export_folder.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/codec/png_image.hpp"

#include <nlohmann/json.hpp>

#include <string_view>
#include <utility>

namespace hypermap {
namespace {

using Json = nlohmann::ordered_json;

struct TouchingPair {
  int first = 0;
  int second = 0;
  double length_m = 0.0;
};

/// Each pair once, by its lower number, then the other one.
std::vector<TouchingPair> pairs_of(const TopometricGraph& graph) {
  std::vector<TouchingPair> pairs;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const SupercellNode& node = graph.nodes[i];
    for (const int other : node.neighbours) {
      const auto k = static_cast<std::size_t>(other);
      if (k < i) continue;
      const double length_m = (graph.nodes[k].centroid - node.centroid).norm();
      pairs.push_back({static_cast<int>(i), other, length_m});
    }
  }
  return pairs;
}

std::string label_of(const SupercellNode& node, std::size_t number, const TopometricGraph& graph) {
  const auto best = best_layer(node);
  return std::to_string(number) + (best ? " " + graph.layers[*best] : "");
}

Json point_json(const Eigen::Vector2d& point) {
  return {point.x(), point.y()};
}

Json node_json(const SupercellNode& node, std::size_t number, const TopometricGraph& graph) {
  Json layers = Json::object();
  for (std::size_t i = 0; i < graph.layers.size(); ++i) {
    layers[graph.layers[i]] = {{"log_odds", node.log_odds[i].value()},
                               {"mean", node.mean[i].value()},
                               {"probability", node.mean[i].probability().value()}};
  }
  const auto best = best_layer(node);
  return {{"type", "Feature"},
          {"id", number},
          {"properties",
           {{"cells", node.num_cells},
            {"best_layer", best ? Json(graph.layers[*best]) : Json()},
            {"neighbours", node.neighbours},
            {"layers", std::move(layers)}}},
          {"geometry", {{"type", "Point"}, {"coordinates", point_json(node.centroid)}}}};
}

Json pair_json(const TouchingPair& pair, const TopometricGraph& graph) {
  const auto at = [&](int number) {
    return point_json(graph.nodes[static_cast<std::size_t>(number)].centroid);
  };
  return {
      {"type", "Feature"},
      {"properties", {{"from", pair.first}, {"to", pair.second}, {"length_m", pair.length_m}}},
      {"geometry",
       {{"type", "LineString"}, {"coordinates", Json::array({at(pair.first), at(pair.second)})}}}};
}

}  // namespace

std::string topometric_dot(const TopometricGraph& graph) {
  std::string text = "graph topometric {\n";
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const SupercellNode& node = graph.nodes[i];
    text += "  " + std::to_string(i) + " [label=" + dot_string(label_of(node, i, graph)) +
            ", pos=\"" + number_text(node.centroid.x()) + "," + number_text(node.centroid.y()) +
            "!\"];\n";
  }
  for (const TouchingPair& pair : pairs_of(graph)) {
    text += "  " + std::to_string(pair.first) + " -- " + std::to_string(pair.second) +
            " [len=" + number_text(pair.length_m) + "];\n";
  }
  return text + "}\n";
}

std::string topometric_geojson(const TopometricGraph& graph) {
  Json features = Json::array();
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    features.push_back(node_json(graph.nodes[i], i, graph));
  }
  for (const TouchingPair& pair : pairs_of(graph)) features.push_back(pair_json(pair, graph));
  const Json document{{"type", "FeatureCollection"},
                      {"name", "topometric"},
                      {"frame_id", graph.frame_id},
                      {"unit", "metre"},
                      {"features", std::move(features)}};
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<std::vector<std::filesystem::path>> write_supercells(const Supercells& supercells,
                                                            const TopometricGraph& graph,
                                                            const std::filesystem::path& folder,
                                                            const ClassPalette& palette) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string png,
                            encode_png(supercell_image(supercells, graph, palette)));
  HYPERMAP_TRY(make_export_folder(folder));
  std::vector<std::filesystem::path> written;
  const auto write = [&](const char* name, std::string_view bytes) -> Result<void> {
    written.push_back(folder / name);
    return write_file_atomically(written.back(), bytes);
  };
  HYPERMAP_TRY(write("supercells.png", png));
  HYPERMAP_TRY(write("topometric.dot", topometric_dot(graph)));
  HYPERMAP_TRY(write("topometric.local.geojson", topometric_geojson(graph)));
  return written;
}

}  // namespace hypermap
