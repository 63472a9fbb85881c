// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/topological_map.hpp"

#include "hypermap/core/base/random_numbers.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

namespace hypermap {
namespace {

/// A vertex is come to when it is nearer than the longest edge by so much: on a way that leaves
/// several spheres at one point this is what each further vertex brings it ahead.
constexpr double kApproachM = 1e-6;

/// Where the straight way from `from` to `to` leaves the sphere around `centre`; none if it ends
/// inside. Requires: `from` is inside or on it.
std::optional<Eigen::Vector3d> exit_of(const Eigen::Vector3d& from,
                                       const Eigen::Vector3d& to,
                                       const Eigen::Vector3d& centre,
                                       double radius_m) {
  if ((to - centre).norm() <= radius_m) return std::nullopt;
  const Eigen::Vector3d way = to - from;
  const Eigen::Vector3d offset = from - centre;
  const double a = way.squaredNorm();
  const double b = way.dot(offset);
  const double c = std::min(0.0, offset.squaredNorm() - radius_m * radius_m);
  const double t = (-b + std::sqrt(b * b - a * c)) / a;
  return from + std::clamp(t, 0.0, 1.0) * way;
}

bool is_within_bounds(const Eigen::Vector3d& position) {
  return position.allFinite() && position.cwiseAbs().maxCoeff() <= TopologicalMap::kMaxCoordinateM;
}

Unexpected refused_part(std::string_view list, std::size_t index, std::string what) {
  return fail(ErrorCode::kInvalidArgument,
              std::move(what),
              std::string(list) + "[" + std::to_string(index) + "]");
}

/// The next element is added without any memory.
template <class T>
void make_room(std::vector<T>& list) {
  if (list.size() == list.capacity()) list.reserve(2 * list.size() + 1);
}

}  // namespace

std::string_view name_of(VertexKind kind) noexcept {
  return kind == VertexKind::kPath ? "path" : "support";
}

std::size_t TopologicalMap::CellHash::operator()(const Cell& cell) const noexcept {
  std::uint64_t hash = 0;
  for (const std::int32_t index : cell) hash = mix_bits(hash ^ static_cast<std::uint32_t>(index));
  return hash;
}

TopologicalMap::TopologicalMap(const TopologicalMapOptions& options)
    : options_(options), graph_(CowRef<Graph>::make()) {
  assert(validate(options));
}

Result<TopologicalMap> TopologicalMap::create(const TopologicalMapOptions& options,
                                              std::span<const TopologicalVertex> vertices,
                                              std::span<const TopologicalEdge> edges,
                                              const std::optional<TopologicalWalk>& walk) {
  HYPERMAP_TRY(validate(options));
  TopologicalMap map(options);
  const auto count = vertices.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_within_bounds(vertices[i].position_in_map)) {
      return refused_part("vertices", i, "must be finite and within 1e6 m of the origin");
    }
    map.add(vertices[i].position_in_map, vertices[i].kind);
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto [from, to] = edges[i];
    if (from >= to || to.value >= count) {
      return refused_part("edges", i, "must name two vertices, the lower one first");
    }
    if (i > 0 && edges[i - 1] >= edges[i]) return refused_part("edges", i, "must be ascending");
    if (map.distance_m(from, to) > map.max_edge_m() + TopologicalMap::kRoundingM) {
      return refused_part("edges",
                          i,
                          "must be at most " + std::to_string(map.max_edge_m()) + " m long, is " +
                              std::to_string(map.distance_m(from, to)));
    }
    map.join(from, to);
  }
  if (walk) {
    const bool is_near = walk->at.value < count && is_within_bounds(walk->position_in_map) &&
                         (map.position_of(walk->at) - walk->position_in_map).norm() <=
                             map.max_edge_m() + TopologicalMap::kRoundingM;
    if (!is_near) {
      return fail(ErrorCode::kInvalidArgument, "must be near the vertex that it names", "walk");
    }
  }
  map.walk_ = walk;
  return map;
}

VertexId TopologicalMap::observe(const Eigen::Vector3d& position_in_map, const IsWayFree& is_free) {
  assert(is_within_bounds(position_in_map));
  if (!walk_) {
    const auto known = nearest_within(position_in_map, max_edge_m(), [&](VertexId id) {
      return !is_free || is_free(position_in_map, position_of(id));
    });
    walk_ = {.at = known ? *known : add(position_in_map, VertexKind::kPath),
             .position_in_map = position_in_map};
    return walk_->at;
  }
  if (is_free && !is_free(position_in_map, position_of(walk_->at))) {
    const IsWayFree is_free_of_both = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
      return is_free(from, to) && is_free(position_in_map, to);
    };
    walk_->at = leave(walk_->at, walk_->position_in_map, is_free_of_both);
  }
  while (const auto exit = exit_of(
             walk_->position_in_map, position_in_map, position_of(walk_->at), max_edge_m())) {
    walk_ = {.at = leave(walk_->at, *exit, is_free), .position_in_map = *exit};
  }
  walk_->position_in_map = position_in_map;
  return walk_->at;
}

VertexId TopologicalMap::leave(VertexId left,
                               const Eigen::Vector3d& position,
                               const IsWayFree& is_free) {
  const auto is_near = [&](VertexId id) {
    return id != left && (!is_free || is_free(position, position_of(id)));
  };
  const auto is_next = [&](VertexId id) {
    return is_near(id) && distance_m(left, id) <= max_edge_m() + kRoundingM &&
           (!is_free || is_free(position_of(left), position_of(id)));
  };
  const double reach_m = max_edge_m() - kApproachM;
  if (const auto next = nearest_within(position, reach_m, is_next)) {
    join(left, *next);
    return *next;
  }
  const auto beyond = nearest_within(position, reach_m, is_near);
  const VertexId made = add(position, VertexKind::kPath);
  join(left, made);
  if (beyond) join(*beyond, made);
  return made;
}

VertexId TopologicalMap::cover(const Eigen::Vector3d& object_in_map) {
  assert(is_within_bounds(object_in_map));
  const auto known = nearest(object_in_map);
  if (!known) return add(object_in_map, VertexKind::kSupport);
  VertexId last = *known;
  const Eigen::Vector3d start = position_of(last);
  const Eigen::Vector3d direction = (object_in_map - start).normalized();
  const double distance_m = (object_in_map - start).norm();
  for (int step = 1; (object_in_map - position_of(last)).norm() >= options_.vertex_distance_m;
       ++step) {
    const double along_m = std::min(step * max_edge_m(), distance_m);
    const VertexId made = add(start + along_m * direction, VertexKind::kSupport);
    join(last, made);
    last = made;
  }
  return last;
}

std::optional<VertexId> TopologicalMap::nearest(const Eigen::Vector3d& position_in_map) const {
  const auto any = [](VertexId) { return true; };
  const double edge_m = options_.vertex_distance_m;
  const auto is_cheap = [&](double within_m) {
    const double cells_per_side = 2.0 * within_m / edge_m + 2.0;
    return std::pow(cells_per_side, 3.0) < static_cast<double>(vertices().size());
  };
  for (double within_m = edge_m; within_m == edge_m || is_cheap(within_m); within_m *= 2.0) {
    if (const auto found = nearest_within(position_in_map, within_m, any)) return found;
  }
  std::optional<VertexId> best;
  double best_m2 = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < vertices().size(); ++i) {
    const double m2 = (vertices()[i].position_in_map - position_in_map).squaredNorm();
    if (m2 >= best_m2) continue;
    best = VertexId{i};
    best_m2 = m2;
  }
  return best;
}

template <class Condition>
std::optional<VertexId> TopologicalMap::nearest_within(const Eigen::Vector3d& position,
                                                       double within_m,
                                                       const Condition& condition) const {
  const Cell low = cell_of(position.array() - within_m);
  const Cell high = cell_of(position.array() + within_m);
  std::vector<std::pair<double, VertexId>> found;
  for (std::int32_t x = low[0]; x <= high[0]; ++x) {
    for (std::int32_t y = low[1]; y <= high[1]; ++y) {
      for (std::int32_t z = low[2]; z <= high[2]; ++z) {
        const auto cell = graph_->cells.find({x, y, z});
        if (cell == graph_->cells.end()) continue;
        for (const VertexId id : cell->second) {
          const double distance_m = (position_of(id) - position).norm();
          if (distance_m <= within_m) found.emplace_back(distance_m, id);
        }
      }
    }
  }
  std::ranges::sort(found);
  const auto best =
      std::ranges::find_if(found, [&](const auto& one) { return condition(one.second); });
  if (best == found.end()) return std::nullopt;
  return best->second;
}

std::optional<VertexId> TopologicalMap::nearest_path_vertex(const Eigen::Vector3d& position_in_map,
                                                            double within_m) const {
  return nearest_within(position_in_map, within_m, [&](VertexId id) {
    return vertices()[id.value].kind == VertexKind::kPath &&
           (position_of(id) - position_in_map).norm() < within_m;
  });
}

std::vector<TopologicalEdge> TopologicalMap::edges() const {
  std::vector<TopologicalEdge> edges;
  for (std::uint32_t i = 0; i < graph_->joined.size(); ++i) {
    for (const VertexId other : graph_->joined[i]) {
      if (other.value > i) edges.push_back({VertexId{i}, other});
    }
  }
  return edges;
}

std::span<const VertexId> TopologicalMap::neighbours(VertexId id) const {
  return graph_->joined[id.value];
}

double TopologicalMap::distance_m(VertexId a, VertexId b) const {
  return (position_of(a) - position_of(b)).norm();
}

TopologicalMap::Cell TopologicalMap::cell_of(const Eigen::Vector3d& position) const {
  Cell cell{};
  for (int axis = 0; axis < 3; ++axis) {
    cell[static_cast<std::size_t>(axis)] =
        static_cast<std::int32_t>(std::floor(position[axis] / options_.vertex_distance_m));
  }
  return cell;
}

/// Invariant: memory that ends leaves all three lists as they were.
VertexId TopologicalMap::add(const Eigen::Vector3d& position, VertexKind kind) {
  Graph& graph = graph_.writable();
  const VertexId id{static_cast<std::uint32_t>(graph.vertices.size())};
  make_room(graph.vertices);
  make_room(graph.joined);
  graph.cells[cell_of(position)].push_back(id);
  graph.vertices.push_back({position, kind});
  graph.joined.emplace_back();
  return id;
}

/// Invariant: as add; an edge stands at both of its ends or at none.
void TopologicalMap::join(VertexId a, VertexId b) {
  if (std::ranges::binary_search(graph_->joined[a.value], b)) return;
  Graph& graph = graph_.writable();
  make_room(graph.joined[a.value]);
  make_room(graph.joined[b.value]);
  const auto insert = [](std::vector<VertexId>& ids, VertexId id) {
    ids.insert(std::ranges::lower_bound(ids, id), id);
  };
  insert(graph.joined[a.value], b);
  insert(graph.joined[b.value], a);
}

}  // namespace hypermap
