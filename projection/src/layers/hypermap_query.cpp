// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/hypermap_query.hpp"

#include "hypermap/core/geometry/polygon_motion.hpp"
#include "hypermap/projection/grids/cropped_grid.hpp"

#include <cmath>
#include <set>
#include <utility>

namespace hypermap {
namespace {

using Answers = std::vector<LayerAnswer>;

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

Result<void> check_finite(const LayerQuery& query) {
  if (query.at) {
    HYPERMAP_TRY(check_finite(query.at->xy));
    if (!std::isfinite(query.at->z.value_or(0.0))) {
      return fail(ErrorCode::kInvalidArgument, "a coordinate is not finite", "point");
    }
  }
  return query.area ? check_finite(*query.area) : Result<void>();
}

Result<Answers> run_query(const Hypermap& map, const QueryScope& scope, const LayerQuery& query) {
  HYPERMAP_ASSIGN_OR_RETURN(const Layer* layer, map.at(scope.layer));
  return query_layer(*layer, map.frames(), scope.frame_id, query);
}

}  // namespace

Result<Answers> query_layer(const Layer& layer,
                            const FrameTree& frames,
                            std::string_view frame_id,
                            const LayerQuery& query) {
  const std::string_view asked_in = frame_id.empty() ? layer.info.frame_id : frame_id;
  HYPERMAP_ASSIGN_OR_RETURN(const Eigen::Isometry2d layer_from_query,
                            frames.to_from(layer.info.frame_id, asked_in));
  HYPERMAP_TRY(check_finite(query));
  LayerQuery in_layer = query;
  if (in_layer.at) in_layer.at->xy = layer_from_query * in_layer.at->xy;
  if (in_layer.area) in_layer.area = moved(std::move(*in_layer.area), layer_from_query);
  HYPERMAP_ASSIGN_OR_RETURN(Answers answers, layer.content->query(in_layer));
  const Eigen::Isometry2d query_from_layer = layer_from_query.inverse();
  for (LayerAnswer& answer : answers) answer.position = query_from_layer * answer.position;
  return answers;
}

Result<Answers> query_at(const Hypermap& map,
                         const QueryScope& scope,
                         const Eigen::Vector2d& point) {
  return run_query(map, scope, {.at = PlanPoint{.xy = point}});
}

Result<Answers> query_area(const Hypermap& map, const QueryScope& scope, const Polygon& area) {
  return run_query(map, scope, {.area = area});
}

Result<Answers> query_string(const Hypermap& map,
                             const QueryScope& scope,
                             std::string_view text,
                             const std::optional<Polygon>& area) {
  return run_query(map, scope, {.text = text, .area = area});
}

Result<Answers> query_int(const Hypermap& map,
                          const QueryScope& scope,
                          std::int64_t value,
                          const std::optional<Polygon>& area) {
  return run_query(map, scope, {.value = value, .area = area});
}

Result<OccupancyLayer> sub_map(const Layer& layer,
                               const FrameTree& frames,
                               std::string_view frame_id,
                               const Polygon& area) {
  HYPERMAP_TRY(check_finite(area));
  const auto* cells = layer.content.as<OccupancyLayer>();
  if (cells == nullptr) {
    return fail(ErrorCode::kUnsupported,
                printable(layer.info.name) + " is of class " + printable(class_of(layer)) +
                    ", only " + std::string(kOccupancyLayerClass) + " has sub-maps",
                "layer");
  }
  const std::string_view asked_in = frame_id.empty() ? layer.info.frame_id : frame_id;
  HYPERMAP_ASSIGN_OR_RETURN(const Eigen::Isometry2d layer_from_area,
                            frames.to_from(layer.info.frame_id, asked_in));
  auto part = sub_map(cells->grid, moved(area, layer_from_area));
  if (!part) {
    return fail(
        ErrorCode::kNotFound, "meets no cell of layer " + printable(layer.info.name), "area");
  }
  return OccupancyLayer(*std::move(part), cells->extra);
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
