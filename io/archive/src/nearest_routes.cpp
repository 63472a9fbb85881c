// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/nearest_routes.hpp"

#include "asked_conditions.hpp"
#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/geometry/polygon_motion.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/projection/layers/occupancy_layer.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

/// What find_layer_of finds. Errors: kNotFound.
template <class T>
Result<const Layer*> layer_with(const MapArchive& archive,
                                std::string_view name,
                                std::string_view what) {
  if (const Layer* found = find_layer_of<T>(archive, name)) return found;
  return fail(ErrorCode::kNotFound, "the map has no " + std::string(what), std::string(name));
}

double distance_to(const std::vector<Polygon>& parts, const Eigen::Vector2d& point) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const Polygon& part : parts) least_m = std::min(least_m, distance_m(part, point));
  return least_m;
}

/// Why no robot can start there. Errors: kNotFound, naming `at`.
Result<void> check_start(const FreeSpace& space, const Eigen::Vector2d& start) {
  const auto refuse = [](const std::string& why) { return fail(ErrorCode::kNotFound, why, "at"); };
  switch (space.standing(start)) {
    case Standing::kFits:
      return {};
    case Standing::kOutside:
      return refuse("is outside the occupancy grid: no way starts there");
    case Standing::kUnknown:
      return refuse("is in unknown space: nobody saw whether it is free");
    case Standing::kOccupied:
      return refuse("is in an obstacle");
    case Standing::kTooNarrow:
      break;
  }
  return refuse(
      "is free, but an obstacle or the grid's edge is nearer than the robot's radius of " +
      number_text(space.robot_radius_m()) + " m");
}

/// The objects that are looked for, in the frame of the grid.
struct Wanted {
  std::vector<MapAnswer> answers;
  std::vector<std::vector<Polygon>> footprints;
};

/// Cells in row-major order.
using Places = std::vector<std::size_t>;

/// Ids of those that are reached from nowhere.
std::vector<std::uint64_t> without_places(const Wanted& wanted, const std::vector<Places>& places) {
  std::vector<std::uint64_t> ids;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].empty()) ids.push_back(wanted.answers[i].id);
  }
  return ids;
}

/// A question with its layers. Refers to the map and the query.
class RouteQuestion {
 public:
  RouteQuestion(const MapArchive& archive, const MapQuery& query, const ApproachOptions& options)
      : archive_(archive), query_(query), options_(options) {}

  Result<ReachedObjects> answer(std::size_t count) {
    HYPERMAP_ASSIGN_OR_RETURN(grid_,
                              layer_with<OccupancyLayer>(archive_, kOccupancyLayer, kNoGrid));
    HYPERMAP_ASSIGN_OR_RETURN(shapes_,
                              layer_with<SemanticLayer>(archive_, kSemanticLayer, kNoShapes));
    HYPERMAP_TRY(check_frame(archive_, query_.frame_id));
    const std::string frame_id = query_.frame_id.empty() ? grid_->info.frame_id : query_.frame_id;
    HYPERMAP_ASSIGN_OR_RETURN(const Eigen::Isometry2d grid_from_query,
                              archive_.hypermap.frames().to_from(grid_->info.frame_id, frame_id));
    HYPERMAP_ASSIGN_OR_RETURN(Wanted wanted, find_wanted(frame_id));
    HYPERMAP_ASSIGN_OR_RETURN(
        const FreeSpace space,
        FreeSpace::create(grid_->content.as<OccupancyLayer>()->grid, options_.robot_radius_m));
    const Eigen::Vector2d start = grid_from_query * query_.at->xy;
    HYPERMAP_TRY(check_start(space, start));
    HYPERMAP_ASSIGN_OR_RETURN(const auto places, places_of(wanted, space));
    ReachedObjects reached{
        .frame_id = frame_id, .found = {}, .out_of_reach = without_places(wanted, places)};
    for (RouteToGoal& one : routes_to_nearest(space, start, places, count)) {
      reached.found.push_back(
          {.object = std::move(wanted.answers[one.goal]),
           .straight_m = distance_to(wanted.footprints[one.goal], start),
           .gap_m = distance_to(wanted.footprints[one.goal], one.route.points.back()),
           .route = std::move(one.route)});
      for (Eigen::Vector2d& point : reached.found.back().route.points) {
        point = grid_from_query.inverse() * point;
      }
    }
    if (reached.found.empty()) return no_way(wanted.answers.size(), reached.out_of_reach.size());
    return reached;
  }

 private:
  static constexpr std::string_view kNoGrid = "occupancy grid, whose free space is asked for";
  static constexpr std::string_view kNoShapes = "semantic layer, whose objects are asked for";

  /// Errors: those of query_map; kNotFound when there is none.
  [[nodiscard]] Result<Wanted> find_wanted(const std::string& frame_id) const {
    MapQuery conditions{.layer = shapes_->info.name,
                        .text = query_.text,
                        .area = query_.area,
                        .frame_id = frame_id};
    if (!query_.text && !query_.area) conditions.value = query_.value;
    HYPERMAP_ASSIGN_OR_RETURN(MapAnswers answers, query_map(archive_, conditions));
    if (query_.value) {
      std::erase_if(answers.found,
                    [&](const MapAnswer& one) { return one.value != *query_.value; });
    }
    if (answers.found.empty()) {
      return fail(ErrorCode::kNotFound, "no object" + unmet_conditions_of(query_, archive_));
    }
    HYPERMAP_ASSIGN_OR_RETURN(
        const Eigen::Isometry2d grid_from_shapes,
        archive_.hypermap.frames().to_from(grid_->info.frame_id, shapes_->info.frame_id));
    Wanted wanted{.answers = std::move(answers.found), .footprints = {}};
    wanted.footprints.reserve(wanted.answers.size());
    for (const MapAnswer& one : wanted.answers) {
      const SemanticObject* object = shapes_->content.as<SemanticLayer>()->find(one.id);
      std::vector<Polygon> parts = object->parts;
      for (Polygon& part : parts) part = moved(std::move(part), grid_from_shapes);
      wanted.footprints.push_back(std::move(parts));
    }
    return wanted;
  }

  /// From which each of the objects is reached.
  [[nodiscard]] Result<std::vector<Places>> places_of(const Wanted& wanted,
                                                      const FreeSpace& space) const {
    std::vector<Places> out;
    out.reserve(wanted.footprints.size());
    for (const auto& footprint : wanted.footprints) {
      HYPERMAP_ASSIGN_OR_RETURN(Places places, places_to_reach(space, footprint, options_.reach_m));
      out.push_back(std::move(places));
    }
    return out;
  }

  [[nodiscard]] Unexpected no_way(std::size_t num_objects, std::size_t num_out_of_reach) const {
    const std::string robot = "a robot of radius " + number_text(options_.robot_radius_m) + " m";
    const std::string those = count_text(num_objects, "object") + conditions_of(query_);
    if (num_out_of_reach == num_objects) {
      return fail(ErrorCode::kNotFound,
                  "no free place for " + robot + " has one of " + those + " within " +
                      number_text(options_.reach_m) + " m of its rim");
    }
    return fail(ErrorCode::kNotFound, "no free way leads " + robot + " to one of " + those);
  }

  const MapArchive& archive_;
  const MapQuery& query_;
  const ApproachOptions& options_;
  const Layer* grid_ = nullptr;
  const Layer* shapes_ = nullptr;
};

}  // namespace

Result<ReachedObjects> query_nearest_routes(const MapArchive& archive,
                                            const MapQuery& query,
                                            const ApproachOptions& options,
                                            std::size_t count) {
  HYPERMAP_TRY(validate(options));
  if (!query.at) return fail(ErrorCode::kInvalidArgument, "is needed", "at");
  if (query.at->z) return fail(ErrorCode::kInvalidArgument, "takes 2 numbers on the floor", "at");
  return guarded(ErrorCode::kInvalidArgument, "the way", [&] {
    return RouteQuestion(archive, query, options).answer(count);
  });
}

}  // namespace hypermap
