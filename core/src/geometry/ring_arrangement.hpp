// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The plane as one ring that crosses itself divides it, and how often the ring winds about each
/// part.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/geometry/polygon.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hypermap {

/// One side of a piece of the ring. Sides 2k and 2k+1 belong to the same piece.
struct HalfEdge {
  std::size_t from = 0;            ///< Node where it starts; it ends where its twin starts.
  std::size_t next_clockwise = 0;  ///< Next half-edge that leaves the same node.
  std::size_t face = 0;            ///< On its left.
  int net = 0;  ///< How often the ring passes this way, less how often the other way.
};

/// Nodes, pieces and faces. Crossings are rounded to 1e-9 m.
class RingArrangement {
 public:
  /// Errors: kLimit when there are more than 100,000 crossings; those of
  /// LoadBudget::draw_edge_tests. Requires: cleaned_ring, at most 4,096 points. Cost: O(n^2).
  [[nodiscard]] static Result<RingArrangement> create(const Ring& ring, const LoadBudget& budget);

  [[nodiscard]] const std::vector<Eigen::Vector2d>& nodes() const noexcept { return nodes_; }
  [[nodiscard]] const std::vector<HalfEdge>& half_edges() const noexcept { return half_edges_; }
  /// Of each face; that outside is 0.
  [[nodiscard]] const std::vector<int>& windings() const noexcept { return windings_; }
  [[nodiscard]] int winding_left_of(std::size_t half_edge) const {
    return windings_[half_edges_[half_edge].face];
  }

 private:
  RingArrangement() = default;
  void link_around_nodes();
  void find_faces();
  void wind();

  std::vector<Eigen::Vector2d> nodes_;
  std::vector<HalfEdge> half_edges_;
  std::vector<int> windings_;
  std::size_t outside_ = 0;
};

/// The other side of the same piece.
[[nodiscard]] constexpr std::size_t twin(std::size_t half_edge) {
  return half_edge ^ std::size_t{1};
}

}  // namespace hypermap
