// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The places that a sensor came to, and the ways between them, as a graph in the map.
///
/// Source: [smap] 3.5.1, pseudocode 3.4. Deviation: what an object or a place is called is not kept
/// in the vertices, but derived from objects and rooms, so that it is never older than they are.
#pragma once

#include "hypermap/core/base/cow_ref.hpp"
#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"

#include <Eigen/Core>

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace hypermap {

struct OptionTable;

using VertexId = Id<struct VertexTag>;  ///< Index into TopologicalMap::vertices().

struct TopologicalMapOptions {
  double vertex_distance_m = 1.0;  ///< An object is nearer to a vertex.   [smap] 3.5.1, V_d
  double edge_factor = 0.95;       ///< Of that distance: longest edge.     [smap] 3.5.1, E_f
  friend bool operator==(const TopologicalMapOptions&, const TopologicalMapOptions&) = default;
};

/// Errors: kInvalidArgument naming the field and its range.
[[nodiscard]] Result<void> validate(const TopologicalMapOptions& options);
[[nodiscard]] const OptionTable& option_table(const TopologicalMapOptions& options);

enum class VertexKind : std::uint8_t {
  kPath,     ///< The sensor was there.
  kSupport,  ///< Nobody was there: made toward an object that no other vertex is near.
};

inline constexpr std::array<VertexKind, 2> kVertexKinds{VertexKind::kPath, VertexKind::kSupport};
/// "path", "support".
[[nodiscard]] std::string_view name_of(VertexKind kind) noexcept;

struct TopologicalVertex {
  Eigen::Vector3d position_in_map = Eigen::Vector3d::Zero();
  VertexKind kind = VertexKind::kPath;
  friend bool operator==(const TopologicalVertex&, const TopologicalVertex&) = default;
};

/// Between two vertices, `from` < `to`.
struct TopologicalEdge {
  VertexId from;
  VertexId to;
  friend auto operator<=>(const TopologicalEdge&, const TopologicalEdge&) = default;
};

/// Where the sensor is: its position, and the vertex that it came to last, at most the longest edge
/// away.
struct TopologicalWalk {
  VertexId at;
  Eigen::Vector3d position_in_map = Eigen::Vector3d::Zero();
  friend bool operator==(const TopologicalWalk&, const TopologicalWalk&) = default;
};

/// Whether nothing is in the way from one place to another, as far as is known.
using IsWayFree = std::function<bool(const Eigen::Vector3d& from, const Eigen::Vector3d& to)>;

/// A graph that grows with the way of a sensor and with the objects that it sees.
///
/// Three rules hold at any time (`broken_rules`): joined vertices are nearer to each other than
/// 2 V_d; an object that was covered is nearer than V_d to a vertex; no edge is longer than V_d
/// E_f. Erratum: rule 1 is printed for any two vertices, which confines a map to 2 V_d; joined ones
/// are meant, so that it follows from rule 3.
///
/// A value. Deterministic in the order of the calls. Frame: Map. When memory ends in a call,
/// std::bad_alloc is thrown, and what was done of it by then obeys rules 1 and 3.
/// Cost: a position or an object looks at the vertices of the cells around it, not at all of them.
/// A copy shares the graph, and whichever of both makes the next vertex or edge copies it first.
class TopologicalMap {
 public:
  /// Requires: validate(options).
  explicit TopologicalMap(const TopologicalMapOptions& options = {});
  TopologicalMap(const TopologicalMap&) noexcept = default;
  TopologicalMap& operator=(const TopologicalMap&) noexcept = default;
  /// What is moved from stays as it was: it costs an atomic increment.
  // NOLINTNEXTLINE(performance-move-constructor-init)
  TopologicalMap(TopologicalMap&& other) noexcept : TopologicalMap(std::as_const(other)) {}
  TopologicalMap& operator=(TopologicalMap&& other) noexcept {
    return *this = std::as_const(other);
  }
  ~TopologicalMap() = default;

  /// The map of such parts, as accessors give them. Errors: kInvalidArgument, naming the field: a
  /// coordinate that is not finite or beyond `kMaxCoordinateM`, an edge whose ends are not vertices
  /// in ascending order, that stands twice or is longer than allowed, a walk that is not near its
  /// vertex; what `validate` refuses.
  [[nodiscard]] static Result<TopologicalMap> create(const TopologicalMapOptions& options,
                                                     std::span<const TopologicalVertex> vertices,
                                                     std::span<const TopologicalEdge> edges,
                                                     const std::optional<TopologicalWalk>& walk);

  /// The sensor goes straight to `position_in_map`, from where it was or, at first and after
  /// `interrupt`, from nowhere. Returns the vertex that it came to last.
  ///
  /// Where it leaves the vertex that it came to last, V_d E_f away or before something comes
  /// between them, it comes to the nearest other one that is nearer than that and to which the way
  /// is free; without one a path vertex is made there. Both are joined, by a path vertex in between
  /// where the two are too far apart or something is between them. A step of any length therefore
  /// leaves no edge longer than V_d E_f. Requires: finite, within `kMaxCoordinateM`. Boundary: no
  /// `is_free`: every way is.
  VertexId observe(const Eigen::Vector3d& position_in_map, const IsWayFree& is_free = {});

  /// The next position is not joined to those before: nobody knows the way to it.
  void interrupt() noexcept { walk_.reset(); }

  /// Makes support vertices from the nearest vertex straight toward an object, V_d E_f apart, until
  /// one is nearer than V_d. Returns the nearest vertex then: the one that the object belongs to.
  /// Requires: as observe. Boundary: exactly V_d is not near; in an empty map one at the object.
  VertexId cover(const Eigen::Vector3d& object_in_map);

  /// Of equally near ones the first; none in an empty map.
  [[nodiscard]] std::optional<VertexId> nearest(const Eigen::Vector3d& position_in_map) const;
  /// The same of path vertices that are nearer than `within_m`.
  [[nodiscard]] std::optional<VertexId> nearest_path_vertex(const Eigen::Vector3d& position_in_map,
                                                            double within_m) const;

  [[nodiscard]] const TopologicalMapOptions& options() const noexcept { return options_; }
  [[nodiscard]] const std::vector<TopologicalVertex>& vertices() const noexcept {
    return graph_->vertices;
  }
  /// Ascending. Cost: O(edges).
  [[nodiscard]] std::vector<TopologicalEdge> edges() const;
  /// The vertices that it is joined to, ascending. Requires: a vertex of this map.
  [[nodiscard]] std::span<const VertexId> neighbours(VertexId id) const;
  [[nodiscard]] const std::optional<TopologicalWalk>& walk() const noexcept { return walk_; }
  /// The length that no edge exceeds, V_d E_f.
  [[nodiscard]] double max_edge_m() const noexcept {
    return options_.vertex_distance_m * options_.edge_factor;
  }
  /// Requires: both are vertices of this map.
  [[nodiscard]] double distance_m(VertexId a, VertexId b) const;

  static constexpr double kMaxCoordinateM = 1e6;
  static constexpr double kRoundingM = 1e-9;  ///< Lengths of edges are exact to this.

  friend bool operator==(const TopologicalMap& a, const TopologicalMap& b) {
    return a.options_ == b.options_ && a.walk_ == b.walk_ &&
           (a.graph_.shares(b.graph_) ||
            (a.graph_->vertices == b.graph_->vertices && a.graph_->joined == b.graph_->joined));
  }

 private:
  using Cell = std::array<std::int32_t, 3>;
  struct CellHash {
    std::size_t operator()(const Cell& cell) const noexcept;
  };
  struct Graph {
    std::vector<TopologicalVertex> vertices;
    std::vector<std::vector<VertexId>> joined;
    /// Vertices by cubes with an edge of V_d.
    std::unordered_map<Cell, std::vector<VertexId>, CellHash> cells;
    OwnerCount owners;
  };

  [[nodiscard]] Cell cell_of(const Eigen::Vector3d& position) const;
  /// The nearest vertex not farther than `within_m` that fulfils the condition.
  template <class Condition>
  [[nodiscard]] std::optional<VertexId> nearest_within(const Eigen::Vector3d& position,
                                                       double within_m,
                                                       const Condition& condition) const;
  [[nodiscard]] const Eigen::Vector3d& position_of(VertexId id) const {
    return graph_->vertices[id.value].position_in_map;
  }
  VertexId add(const Eigen::Vector3d& position, VertexKind kind);
  void join(VertexId a, VertexId b);
  /// The vertex that the sensor comes to at `position`, where it leaves `left`.
  VertexId leave(VertexId left, const Eigen::Vector3d& position, const IsWayFree& is_free);

  TopologicalMapOptions options_;
  CowRef<Graph> graph_;  ///< Never null.
  std::optional<TopologicalWalk> walk_;
};

}  // namespace hypermap
