// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How near a place is to an object's surface, by the cells that its observations voted for.
#pragma once

#include "hypermap/core/geometry/occupancy_votes.hpp"

#include <Eigen/Core>

#include <memory>

namespace hypermap {

/// The middles of an object's voted cells, found by their distance. Frame: Map. Shared by copies.
///
/// A cell that few observations voted for is a part that few saw, or an error; it is believed as
/// far as others that are supported (OccupancyVotes) lie near it.
class ObjectSurface {
 public:
  /// Cost: O(n log n) for n cells; 20 B a cell.
  explicit ObjectSurface(const OccupancyVotes& points);

  [[nodiscard]] bool empty() const noexcept;
  /// The mean of the distances to the nearest supported cell and to the nearest cell of all, in
  /// metres; infinity where it is `most_m` and more, or no cell is supported.
  /// Cost: O(log n) as a rule; half of it where no cell is so near.
  [[nodiscard]] double distance_m(const Eigen::Vector3d& place_in_map, double most_m) const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;  ///< Never null.
};

}  // namespace hypermap
