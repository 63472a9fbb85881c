// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/grid_stack_layer.hpp"

#include "grid_members.hpp"
#include "hypermap/projection/layers/asked_cells.hpp"
#include "hypermap/projection/stack/evidence_color.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace hypermap {
namespace {

constexpr double kMostLogOdds = 13.815;
constexpr double kPerCent = 100.0;

/// Of the layers' evidence of one cell, by maximum pooling.
PlaceEvidence evidence_at(const GridStack& stack, std::size_t cell) {
  PlaceEvidence evidence;
  LogOddsSteps most = 0;
  for (const auto& [name, grid] : stack.layers()) {
    const LogOddsSteps steps = grid.cells()[cell];
    evidence.is_known = evidence.is_known || steps != 0;
    if (steps <= most) continue;
    most = steps;
    evidence.best_layer = name;
  }
  return evidence;
}

/// Of a cell on one layer.
LayerAnswer answer_of(std::string_view name, LogOddsSteps steps, const Eigen::Vector2d& position) {
  const double probability = from_steps(steps).probability().value();
  return {.id = 0,
          .name = std::string(name),
          .value = std::lround(kPerCent * probability),
          .position = position,
          .confidence = probability};
}

/// Of a cell, `id` apart from its place.
void append_answers(std::vector<LayerAnswer>& answers, const GridStack& stack, Cell cell) {
  const GridGeometry& geometry = stack.geometry();
  const std::size_t place = geometry.index(cell);
  const Eigen::Vector2d position = centre(geometry, cell);
  bool is_known = false;
  bool is_occupied = false;
  std::uint64_t id = place;
  for (const auto& [name, grid] : stack.layers()) {
    id += geometry.num_cells();
    const LogOddsSteps steps = grid.cells()[place];
    is_known = is_known || steps != 0;
    if (steps <= 0) continue;
    is_occupied = true;
    answers.push_back(answer_of(last_part(name), steps, position));
    answers.back().id = id;
  }
  if (is_occupied) return;
  answers.push_back({.id = place,
                     .name = std::string(evidence_name({.is_known = is_known})),
                     .value = is_known ? 0 : -1,
                     .position = position});
}

Result<GridStackOptions> options_of_keys(const YamlNode& root) {
  GridStackOptions options;
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode frame, root.at("frame"));
  HYPERMAP_ASSIGN_OR_RETURN(options.frame_id, frame.as_string());
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode parent, root.at("parent"));
  HYPERMAP_ASSIGN_OR_RETURN(options.parent, parent.as_string());
  HYPERMAP_ASSIGN_OR_RETURN(const double most,
                            number_of_key(root, "max_log_odds", 0.0, kMostLogOdds));
  options.max_log_odds = LogOdds(most);
  HYPERMAP_ASSIGN_OR_RETURN(options.keep_share, number_of_key(root, "keep_share", 0.0, 1.0));
  return options;
}

/// The layers of these names, a member each.
Result<GridStack::Layers> read_layers(LayerReader& reader,
                                      const GridGeometry& geometry,
                                      const std::vector<std::string>& names) {
  GridStack::Layers layers;
  for (std::size_t i = 0; i < names.size(); ++i) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, reader.bytes("." + std::to_string(i)));
    HYPERMAP_ASSIGN_OR_RETURN(auto cells,
                              cells_of_bytes<LogOddsSteps>(bytes, geometry.num_cells()));
    HYPERMAP_ASSIGN_OR_RETURN(LogOddsGrid grid, LogOddsGrid::create(geometry, std::move(cells)));
    if (!layers.emplace(names[i], std::move(grid)).second)
      return fail(ErrorCode::kMalformedFile, "has two layers '" + printable(names[i]) + "'");
  }
  return layers;
}

Result<LayerContent> load_stack(LayerReader& reader) {
  HYPERMAP_ASSIGN_OR_RETURN(const ValueTree tree, reader.yaml(".yaml"));
  const SourceName source;  // the archive names file and member
  const YamlNode root(tree, "", source);
  HYPERMAP_ASSIGN_OR_RETURN(const GridGeometry geometry, geometry_of_keys(root));
  if (geometry.num_cells() == 0) return LayerContent(GridStackLayer());
  HYPERMAP_ASSIGN_OR_RETURN(GridStackOptions options, options_of_keys(root));
  HYPERMAP_ASSIGN_OR_RETURN(const auto names, texts_of_key(root, "layers"));
  HYPERMAP_ASSIGN_OR_RETURN(auto layers, read_layers(reader, geometry, names));
  HYPERMAP_ASSIGN_OR_RETURN(GridStack stack,
                            GridStack::create(geometry, std::move(options), std::move(layers)));
  return LayerContent(GridStackLayer(std::move(stack)));
}

}  // namespace

Result<LayerContent> GridStackLayer::load(LayerReader& reader) {
  auto layer = load_stack(reader);
  if (layer || layer.error().code != ErrorCode::kInvalidArgument) return layer;
  Error error = std::move(layer).error();
  error.code = ErrorCode::kMalformedFile;
  return tl::make_unexpected(std::move(error));
}

LayerStatistics GridStackLayer::statistics() const {
  LayerStatistics statistics{.cells = OccupancyCounts{}};
  if (!stack_) return statistics;
  const Rect rect = hypermap::bounds(stack_->geometry());
  statistics.bounds = Eigen::AlignedBox3d(Eigen::Vector3d(rect.min.x(), rect.min.y(), 0.0),
                                          Eigen::Vector3d(rect.max.x(), rect.max.y(), 0.0));
  for (std::size_t i = 0; i < stack_->geometry().num_cells(); ++i) {
    const PlaceEvidence evidence = evidence_at(*stack_, i);
    statistics.cells->occupied += evidence.best_layer ? 1U : 0U;
    statistics.cells->free += evidence.is_known && !evidence.best_layer ? 1U : 0U;
    statistics.cells->unknown += evidence.is_known ? 0U : 1U;
  }
  return statistics;
}

Result<std::vector<LayerAnswer>> GridStackLayer::query(const LayerQuery& query) const {
  std::vector<LayerAnswer> answers;
  if (!stack_) return answers;
  std::vector<LayerAnswer> of_cell;
  for_each_asked_cell(stack_->geometry(), query, [&](Cell cell) {
    of_cell.clear();
    append_answers(of_cell, *stack_, cell);
    for (LayerAnswer& answer : of_cell)
      if (has_representation(answer, query)) answers.push_back(std::move(answer));
  });
  std::ranges::sort(answers, {}, &LayerAnswer::id);
  return answers;
}

std::vector<LayerPrimitive> GridStackLayer::draw() const {
  if (!stack_) return {};
  DrawnCells cells{.geometry = stack_->geometry(), .colors = {}};
  cells.colors.reserve(cells.geometry.num_cells());
  for (std::size_t i = 0; i < cells.geometry.num_cells(); ++i)
    cells.colors.push_back(evidence_color(evidence_at(*stack_, i)));
  return {std::move(cells)};
}

Result<void> GridStackLayer::save(LayerWriter& writer) const {
  std::vector<ValueTree::Entry> keys;
  append_geometry(keys, stack_ ? stack_->geometry() : GridGeometry{});
  if (!stack_) return writer.yaml(".yaml", make_map(std::move(keys)));
  std::vector<std::string> names;
  names.reserve(stack_->layers().size());
  for (const auto& [name, grid] : stack_->layers()) names.push_back(name);
  const GridStackOptions& options = stack_->options();
  keys.emplace_back("frame", make_text(options.frame_id));
  keys.emplace_back("parent", make_text(options.parent));
  keys.emplace_back("max_log_odds", make_number(options.max_log_odds.value()));
  keys.emplace_back("keep_share", make_number(options.keep_share));
  keys.emplace_back("layers", make_text_list(names));
  HYPERMAP_TRY(writer.yaml(".yaml", make_map(std::move(keys))));
  std::size_t place = 0;
  for (const auto& [name, grid] : stack_->layers())
    HYPERMAP_TRY(writer.bytes("." + std::to_string(place++), bytes_of_cells(grid.cells())));
  return {};
}

bool GridStackLayer::equals(const MapLayer& other) const {
  return is_same_layer(*this, other);
}

}  // namespace hypermap
