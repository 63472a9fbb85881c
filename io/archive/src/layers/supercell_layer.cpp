// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/supercell_layer.hpp"

#include "grid_members.hpp"
#include "hypermap/projection/layers/asked_cells.hpp"
#include "hypermap/projection/stack/evidence_color.hpp"
#include "supercell_members.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <utility>

namespace hypermap {
namespace {

constexpr Rgb8 kEdgeColor{70, 70, 70};
constexpr double kMaxEnergy = 1e15;
constexpr double kMaxMoves = 9e15;

Result<void> refused(std::string what) {
  return fail(ErrorCode::kInvalidArgument, std::move(what), "graph");
}

/// Errors: kInvalidArgument for a label that is no supercell's.
Result<std::vector<std::size_t>> cells_of_each(const Supercells& supercells) {
  if (supercells.labels.size() != supercells.geometry.num_cells())
    return fail(ErrorCode::kInvalidArgument, "must have a label for each cell", "labels");
  std::vector<std::size_t> cells(static_cast<std::size_t>(std::max(supercells.count, 0)), 0);
  for (const std::int32_t label : supercells.labels) {
    if (label < 0 || label >= supercells.count) {
      return fail(ErrorCode::kInvalidArgument,
                  "has the label " + std::to_string(label) + ", there are " +
                      std::to_string(supercells.count) + " supercells",
                  "labels");
    }
    ++cells[static_cast<std::size_t>(label)];
  }
  return cells;
}

bool is_neighbour_of(const std::vector<SupercellNode>& nodes, int other, int number) {
  if (other < 0 || std::cmp_greater_equal(other, nodes.size()) || other == number) return false;
  return std::ranges::binary_search(nodes[static_cast<std::size_t>(other)].neighbours, number);
}

Result<void> check_node(const TopometricGraph& graph, std::size_t place) {
  const SupercellNode& node = graph.nodes[place];
  const std::string name = "node " + std::to_string(place);
  const std::size_t num_layers = graph.layers.size();
  if (node.log_odds.size() != num_layers || node.mean.size() != num_layers)
    return refused(name + " must have a number for each of " + std::to_string(num_layers) +
                   " layers");
  if (!node.centroid.allFinite()) return refused(name + " has no finite centroid");
  for (const int other : node.neighbours) {
    if (!is_neighbour_of(graph.nodes, other, static_cast<int>(place)))
      return refused(name + " has the neighbour " + std::to_string(other) + ", which has not it");
  }
  return {};
}

Result<void> check_graph(const Supercells& supercells, const TopometricGraph& graph) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto cells, cells_of_each(supercells));
  if (graph.nodes.size() != cells.size())
    return refused("must have a node for each of " + std::to_string(cells.size()) + " supercells");
  for (const SupercellNode& node : graph.nodes) {
    const auto unordered = std::ranges::adjacent_find(node.neighbours, std::greater_equal<>());
    if (unordered != node.neighbours.end()) return refused("neighbours must ascend");
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (graph.nodes[i].num_cells != cells[i] || cells[i] == 0)
      return refused("node " + std::to_string(i) + " says " +
                     std::to_string(graph.nodes[i].num_cells) + " cells, there are " +
                     std::to_string(cells[i]));
    HYPERMAP_TRY(check_node(graph, i));
  }
  return {};
}

/// The centre of the cell of each supercell that is nearest to its centroid.
std::vector<Eigen::Vector2d> inner_points(const Supercells& supercells,
                                          const TopometricGraph& graph) {
  std::vector<Eigen::Vector2d> points(graph.nodes.size());
  std::vector<double> squared_m2(graph.nodes.size(), std::numeric_limits<double>::infinity());
  const GridGeometry& geometry = supercells.geometry;
  for_each_asked_cell(geometry, {}, [&](Cell cell) {
    const auto number = static_cast<std::size_t>(supercells.labels[geometry.index(cell)]);
    const Eigen::Vector2d point = centre(geometry, cell);
    const double distance = (point - graph.nodes[number].centroid).squaredNorm();
    if (distance >= squared_m2[number]) return;
    squared_m2[number] = distance;
    points[number] = point;
  });
  return points;
}

LayerAnswer answer_of(const TopometricGraph& graph, int number, const Eigen::Vector2d& position) {
  const SupercellNode& node = graph.nodes[static_cast<std::size_t>(number)];
  LayerAnswer answer{.id = static_cast<std::uint64_t>(number),
                     .name = std::string(evidence_name(evidence_of(node, graph))),
                     .value = number,
                     .position = position};
  if (const auto best = best_layer(node))
    answer.confidence = node.mean[*best].probability().value();
  return answer;
}

Result<Supercells> supercells_of_keys(const YamlNode& root) {
  Supercells supercells;
  HYPERMAP_ASSIGN_OR_RETURN(supercells.geometry, geometry_of_keys(root));
  if (supercells.geometry.num_cells() == 0) return supercells;
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode count, root.at("supercells"));
  const auto most = static_cast<std::int64_t>(supercells.geometry.num_cells());
  HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t number, count.as_int(1, most));
  supercells.count = static_cast<int>(number);
  HYPERMAP_ASSIGN_OR_RETURN(supercells.first_energy,
                            number_of_key(root, "first_energy", -kMaxEnergy, kMaxEnergy));
  HYPERMAP_ASSIGN_OR_RETURN(supercells.energy,
                            number_of_key(root, "energy", -kMaxEnergy, kMaxEnergy));
  HYPERMAP_ASSIGN_OR_RETURN(const double moves, number_of_key(root, "moves", 0.0, kMaxMoves));
  supercells.num_moves = static_cast<std::size_t>(moves);
  return supercells;
}

Result<LayerContent> load_supercells(LayerReader& reader) {
  HYPERMAP_ASSIGN_OR_RETURN(const ValueTree tree, reader.yaml(".yaml"));
  const SourceName source;  // the archive names file and member
  const YamlNode root(tree, "", source);
  HYPERMAP_ASSIGN_OR_RETURN(Supercells supercells, supercells_of_keys(root));
  const std::size_t num_cells = supercells.geometry.num_cells();
  if (num_cells == 0) return LayerContent(SupercellLayer());
  TopometricGraph graph;
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode frame, root.at("frame"));
  HYPERMAP_ASSIGN_OR_RETURN(graph.frame_id, frame.as_string());
  HYPERMAP_ASSIGN_OR_RETURN(graph.layers, texts_of_key(root, "layers"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string labels, reader.bytes(".labels"));
  HYPERMAP_ASSIGN_OR_RETURN(supercells.labels, cells_of_bytes<std::int32_t>(labels, num_cells));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string lines, reader.bytes(".jsonl"));
  HYPERMAP_ASSIGN_OR_RETURN(graph.nodes,
                            nodes_of_lines(lines, static_cast<std::size_t>(supercells.count)));
  HYPERMAP_ASSIGN_OR_RETURN(SupercellLayer layer,
                            SupercellLayer::create(std::move(supercells), std::move(graph)));
  return LayerContent(std::move(layer));
}

}  // namespace

SupercellLayer::SupercellLayer(Supercells supercells, TopometricGraph graph)
    : supercells_(std::move(supercells)),
      graph_(std::move(graph)),
      positions_(inner_points(supercells_, graph_)) {}

Result<SupercellLayer> SupercellLayer::create(Supercells supercells, TopometricGraph graph) {
  HYPERMAP_TRY(validate(supercells.geometry));
  HYPERMAP_TRY(check_graph(supercells, graph));
  return SupercellLayer(std::move(supercells), std::move(graph));
}

Result<LayerContent> SupercellLayer::load(LayerReader& reader) {
  auto layer = load_supercells(reader);
  if (layer || layer.error().code != ErrorCode::kInvalidArgument) return layer;
  Error error = std::move(layer).error();
  error.code = ErrorCode::kMalformedFile;
  return tl::make_unexpected(std::move(error));
}

LayerStatistics SupercellLayer::statistics() const {
  LayerStatistics statistics{.num_objects = graph_.nodes.size()};
  if (graph_.nodes.empty()) return statistics;
  const Rect rect = hypermap::bounds(supercells_.geometry);
  statistics.bounds = Eigen::AlignedBox3d(Eigen::Vector3d(rect.min.x(), rect.min.y(), 0.0),
                                          Eigen::Vector3d(rect.max.x(), rect.max.y(), 0.0));
  return statistics;
}

Result<std::vector<LayerAnswer>> SupercellLayer::query(const LayerQuery& query) const {
  std::set<int> numbers;
  for_each_asked_cell(supercells_.geometry, query, [&](Cell cell) {
    numbers.insert(supercells_.labels[supercells_.geometry.index(cell)]);
  });
  std::vector<LayerAnswer> answers;
  for (const int number : numbers) {
    LayerAnswer answer = answer_of(graph_, number, positions_[static_cast<std::size_t>(number)]);
    if (has_representation(answer, query)) answers.push_back(std::move(answer));
  }
  return answers;
}

std::vector<LayerPrimitive> SupercellLayer::draw() const {
  if (graph_.nodes.empty()) return {};
  std::vector<Rgb8> of_node;
  of_node.reserve(graph_.nodes.size());
  for (const SupercellNode& node : graph_.nodes)
    of_node.push_back(evidence_color(evidence_of(node, graph_)));
  DrawnCells cells{.geometry = supercells_.geometry, .colors = {}};
  cells.colors.reserve(supercells_.labels.size());
  for (const std::int32_t label : supercells_.labels)
    cells.colors.push_back(of_node[static_cast<std::size_t>(label)]);
  std::vector<LayerPrimitive> drawn{std::move(cells)};
  for (std::size_t i = 0; i < graph_.nodes.size(); ++i) {
    for (const int other : graph_.nodes[i].neighbours) {
      const auto k = static_cast<std::size_t>(other);
      if (k < i) continue;
      drawn.push_back(DrawnLine{.points = {graph_.nodes[i].centroid, graph_.nodes[k].centroid},
                                .color = kEdgeColor});
    }
  }
  return drawn;
}

Result<void> SupercellLayer::save(LayerWriter& writer) const {
  std::vector<ValueTree::Entry> keys;
  append_geometry(keys, supercells_.geometry);
  if (graph_.nodes.empty()) return writer.yaml(".yaml", make_map(std::move(keys)));
  keys.emplace_back("frame", make_text(graph_.frame_id));
  keys.emplace_back("layers", make_text_list(graph_.layers));
  keys.emplace_back("supercells", make_number(supercells_.count));
  keys.emplace_back("first_energy", make_number(supercells_.first_energy));
  keys.emplace_back("energy", make_number(supercells_.energy));
  keys.emplace_back("moves", make_number(static_cast<double>(supercells_.num_moves)));
  HYPERMAP_TRY(writer.yaml(".yaml", make_map(std::move(keys))));
  HYPERMAP_TRY(
      writer.bytes(".labels", bytes_of_cells(std::span<const std::int32_t>(supercells_.labels))));
  return writer.bytes(".jsonl", lines_of_nodes(graph_.nodes));
}

bool SupercellLayer::equals(const MapLayer& other) const {
  return is_same_layer(*this, other);
}

}  // namespace hypermap
