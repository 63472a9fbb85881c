// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How near a place is to an object's surface, by the cells that its observations voted for.
#pragma once

#include "hypermap/core/geometry/occupancy_votes.hpp"

#include <Eigen/Core>

#include <memory>

namespace hypermap {

/// The voted cells of an object, found by their distance. Frame: Map. Shared by copies.
///
/// A cell that few observations voted for is a part that few saw, or an error; it is believed as
/// far as others that are supported (OccupancyVotes) lie near it.
class ObjectSurface {
 public:
  /// Cost: O(n log n) for n cells; about 40 B a cell.
  explicit ObjectSurface(const OccupancyVotes& points);

  [[nodiscard]] bool empty() const noexcept;
  /// The mean of the distances to the nearest supported cell and to the nearest cell of all, in
  /// metres; infinity where it is `most_m` and more, or no cell is supported. A cell of up to
  /// 2 cm stands for a point in its middle, a wider one for what half of the excess is around that.
  /// Cost: O(log n) as a rule, one search where no supported cell is so near that it can be.
  [[nodiscard]] double distance_m(const Eigen::Vector3d& place_in_map, double most_m) const;

 private:
  struct Trees;
  std::shared_ptr<const Trees> trees_;  ///< Never null.
};

}  // namespace hypermap
