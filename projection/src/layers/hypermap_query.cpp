// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/hypermap_query.hpp"

#include <algorithm>
#include <functional>
#include <set>

namespace hypermap {
namespace {

using Answers = std::vector<LayerAnswer>;

/// A layer and the way from the query's frame to the layer's.
struct Target {
  const Layer* layer = nullptr;
  Eigen::Isometry2d layer_from_query = Eigen::Isometry2d::Identity();
};

Result<Target> resolve(const Hypermap& map, const QueryScope& scope) {
  HYPERMAP_ASSIGN_OR_RETURN(const Layer* layer, map.at(scope.layer));
  const std::string& frame = scope.frame_id.empty() ? layer->info.frame_id : scope.frame_id;
  HYPERMAP_ASSIGN_OR_RETURN(const Eigen::Isometry2d layer_from_query,
                            map.frames().to_from(layer->info.frame_id, frame));
  return Target{layer, layer_from_query};
}

Ring moved(const Ring& ring, const Eigen::Isometry2d& to_from) {
  Ring out;
  out.reserve(ring.size());
  for (const Eigen::Vector2d& point : ring) out.push_back(to_from * point);
  return out;
}

/// A rigid motion in the plane keeps the orientation of rings.
Polygon moved(const Polygon& polygon, const Eigen::Isometry2d& to_from) {
  Polygon out{.outer = moved(polygon.outer, to_from), .holes = {}};
  for (const Ring& hole : polygon.holes) out.holes.push_back(moved(hole, to_from));
  return out;
}

Result<void> check_finite(const Eigen::Vector2d& point) {
  if (point.allFinite()) return {};
  return fail(ErrorCode::kInvalidArgument, "a coordinate is not finite", "point");
}

Result<void> check_finite(const Polygon& area) {
  for (const Eigen::Vector2d& point : area.outer) {
    if (!point.allFinite()) {
      return fail(ErrorCode::kInvalidArgument, "a coordinate is not finite", "area");
    }
  }
  if (area.outer.size() < 3) {
    return fail(ErrorCode::kInvalidArgument, "expected three points or more", "area");
  }
  return {};
}

LayerAnswer answer_of(const SemanticObject& object) {
  return {.id = object.id,
          .name = object.name,
          .value = static_cast<std::int64_t>(object.id),
          .position = position_of(object),
          .confidence = confidence_of(object)};
}

Answers answers_of(const SemanticLayer& layer, const std::vector<std::uint64_t>& ids) {
  Answers answers;
  for (const std::uint64_t id : ids) answers.push_back(answer_of(*layer.find(id)));
  return answers;
}

LayerAnswer answer_of(const OccupancyGrid& grid, Cell cell) {
  const std::int8_t occupancy = grid.at(cell);
  LayerAnswer answer{.id = grid.geometry().index(cell),
                     .name = std::string(occupancy_string(occupancy)),
                     .value = occupancy,
                     .position = centre(grid.geometry(), cell)};
  if (occupancy != kUnknownCell) answer.confidence = occupancy / 100.0;
  return answer;
}

/// Cells that pass, of the area or of the whole grid, in row-major order.
Answers select_cells(const OccupancyGrid& grid,
                     const std::optional<Polygon>& area,
                     const std::function<bool(std::int8_t)>& passes) {
  Answers answers;
  const auto take = [&](Cell cell) {
    if (passes(grid.at(cell))) answers.push_back(answer_of(grid, cell));
  };
  if (area) {
    for_each_covered_cell(
        grid.geometry(), *area, [&](Cell cell, double /*covered*/) { take(cell); });
    return answers;
  }
  for (int row = 0; row < grid.geometry().rows; ++row) {
    for (int col = 0; col < grid.geometry().cols; ++col) take({col, row});
  }
  return answers;
}

/// Objects of these ids, restricted to the area by set intersection. Source: [hypermap] 3.3.3.
Answers select_objects(const SemanticLayer& layer,
                       const std::vector<std::uint64_t>& ids,
                       const std::optional<Polygon>& area) {
  if (!area) return answers_of(layer, ids);
  const std::vector<std::uint64_t> inside = layer.in(*area);
  std::vector<std::uint64_t> both;
  std::set_intersection(
      ids.begin(), ids.end(), inside.begin(), inside.end(), std::back_inserter(both));
  return answers_of(layer, both);
}

Unexpected is_opaque(const OpaqueLayer& layer) {
  return fail(ErrorCode::kUnsupported,
              "layers of class " + printable(layer.class_name) + " answer no query",
              "layer");
}

struct AtPoint {
  Eigen::Vector2d point;

  Result<Answers> operator()(const OccupancyLayer& layer) const {
    const auto cell = cell_at(layer.grid.geometry(), point);
    return cell ? Answers{answer_of(layer.grid, *cell)} : Answers{};
  }
  Result<Answers> operator()(const SemanticLayer& layer) const {
    return answers_of(layer, layer.at(point));
  }
  Result<Answers> operator()(const OpaqueLayer& layer) const { return is_opaque(layer); }
};

struct InArea {
  Polygon area;

  Result<Answers> operator()(const OccupancyLayer& layer) const {
    return select_cells(layer.grid, area, [](std::int8_t /*occupancy*/) { return true; });
  }
  Result<Answers> operator()(const SemanticLayer& layer) const {
    return answers_of(layer, layer.in(area));
  }
  Result<Answers> operator()(const OpaqueLayer& layer) const { return is_opaque(layer); }
};

struct ByString {
  std::string_view text;
  std::optional<Polygon> area;

  Result<Answers> operator()(const OccupancyLayer& layer) const {
    return select_cells(layer.grid, area, [this](std::int8_t occupancy) {
      return occupancy_string(occupancy) == text;
    });
  }
  Result<Answers> operator()(const SemanticLayer& layer) const {
    return select_objects(layer, layer.named(text), area);
  }
  Result<Answers> operator()(const OpaqueLayer& layer) const { return is_opaque(layer); }
};

struct ByInt {
  std::int64_t value;
  std::optional<Polygon> area;

  Result<Answers> operator()(const OccupancyLayer& layer) const {
    return select_cells(
        layer.grid, area, [this](std::int8_t occupancy) { return occupancy == value; });
  }
  Result<Answers> operator()(const SemanticLayer& layer) const {
    const auto id = static_cast<std::uint64_t>(value);
    const bool exists = value >= 0 && layer.find(id) != nullptr;
    return select_objects(
        layer, exists ? std::vector<std::uint64_t>{id} : std::vector<std::uint64_t>{}, area);
  }
  Result<Answers> operator()(const OpaqueLayer& layer) const { return is_opaque(layer); }
};

/// Asks the layer and gives the positions in the frame of the query.
template <class Query>
Result<Answers> ask(const Target& target, const Query& query) {
  HYPERMAP_ASSIGN_OR_RETURN(Answers answers, std::visit(query, target.layer->content));
  const Eigen::Isometry2d query_from_layer = target.layer_from_query.inverse();
  for (LayerAnswer& answer : answers) answer.position = query_from_layer * answer.position;
  return answers;
}

Result<std::optional<Polygon>> area_in_layer(const Target& target,
                                             const std::optional<Polygon>& area) {
  if (!area) return std::optional<Polygon>();
  HYPERMAP_TRY(check_finite(*area));
  return std::optional<Polygon>(moved(*area, target.layer_from_query));
}

}  // namespace

Result<Answers> query_at(const Hypermap& map,
                         const QueryScope& scope,
                         const Eigen::Vector2d& point) {
  HYPERMAP_ASSIGN_OR_RETURN(const Target target, resolve(map, scope));
  HYPERMAP_TRY(check_finite(point));
  return ask(target, AtPoint{target.layer_from_query * point});
}

Result<Answers> query_area(const Hypermap& map, const QueryScope& scope, const Polygon& area) {
  HYPERMAP_ASSIGN_OR_RETURN(const Target target, resolve(map, scope));
  HYPERMAP_TRY(check_finite(area));
  return ask(target, InArea{moved(area, target.layer_from_query)});
}

Result<Answers> query_string(const Hypermap& map,
                             const QueryScope& scope,
                             std::string_view text,
                             const std::optional<Polygon>& area) {
  HYPERMAP_ASSIGN_OR_RETURN(const Target target, resolve(map, scope));
  HYPERMAP_ASSIGN_OR_RETURN(const auto in_layer, area_in_layer(target, area));
  return ask(target, ByString{text, in_layer});
}

Result<Answers> query_int(const Hypermap& map,
                          const QueryScope& scope,
                          std::int64_t value,
                          const std::optional<Polygon>& area) {
  HYPERMAP_ASSIGN_OR_RETURN(const Target target, resolve(map, scope));
  HYPERMAP_ASSIGN_OR_RETURN(const auto in_layer, area_in_layer(target, area));
  return ask(target, ByInt{value, in_layer});
}

std::vector<std::string> distinct_names(const std::vector<LayerAnswer>& answers) {
  std::vector<std::string> names;
  std::set<std::string_view> seen;
  for (const LayerAnswer& answer : answers) {
    if (seen.insert(answer.name).second) names.push_back(answer.name);
  }
  return names;
}

}  // namespace hypermap
