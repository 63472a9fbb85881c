// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Lists of voted cells: made from points, added, widened.
///
/// All lists are ascending by cell, each cell once.
#pragma once

#include "hypermap/core/geometry/occupancy_votes.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// Coordinates beyond it are no points of a map.
inline constexpr double kMaxVotedCoordinateM = 1e6;

/// One vote for each cell that has a point. Points that are not finite or too far are left out.
[[nodiscard]] std::vector<PointVote> votes_of(std::span<const Eigen::Vector3f> points,
                                              double edge_m);

/// The votes of both lists, cell by cell.
[[nodiscard]] std::vector<PointVote> sum_of(std::span<const PointVote> mine,
                                            std::span<const PointVote> votes);

/// The list in cells of twice the edge. A wide cell has the votes of the best of its parts: their
/// sum would count an observation several times, and strays that lie side by side would agree.
[[nodiscard]] std::vector<PointVote> widened(std::span<const PointVote> votes);

/// The votes of the cell that the middle one of all votes lies in, cells in the order of their
/// votes: half of all votes lie in cells with more. Strays are many cells but few votes. 1 without
/// votes. The order of the cells does not matter.
[[nodiscard]] std::uint32_t typical_votes(std::span<const PointVote> votes);

[[nodiscard]] Eigen::Vector3d centre_of(const PointCell& cell, double edge_m);

}  // namespace hypermap
