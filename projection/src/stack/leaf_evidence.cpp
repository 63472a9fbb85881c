// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/stack/leaf_evidence.hpp"

#include "hypermap/core/base/caught.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kMaxCellsOfClasses = std::size_t{1} << 30U;

/// In steps, by cell: sums of whole numbers, so that the order of leaves does not count.
using StepSums = std::vector<std::int32_t>;

struct ColumnSums {
  std::map<ClassId, StepSums> of_class;
  std::map<ClassId, std::vector<bool>> has_class;
  StepSums occupied;  ///< Of all occupied leaves: that each of them is what it is.
  StepSums free;
  std::vector<bool> is_occupied;
};

/// What leaves of a band there are.
struct LeafKinds {
  std::set<ClassId> classes;     ///< Of occupied ones.
  double smallest_edge_m = 0.0;  ///< 0: there are none.
};

LeafKinds kinds_in(const LeafSource& leaves, const HeightBand& band, const GridGeometry& geometry) {
  LeafKinds kinds;
  leaves([&](const LeafSample& leaf) {
    const bool is_smaller = kinds.smallest_edge_m == 0.0 || leaf.edge_m < kinds.smallest_edge_m;
    const bool is_new =
        leaf.occupied && leaf.best_class && !kinds.classes.contains(*leaf.best_class);
    if (!is_smaller && !is_new) return;
    for_each_column(
        geometry, band, leaf, [&](Cell /*cell*/, double /*covered*/, double /*height*/) {
          if (is_smaller) kinds.smallest_edge_m = leaf.edge_m;
          if (is_new) kinds.classes.insert(*leaf.best_class);
        });
  });
  return kinds;
}

/// What a leaf says of a cell of which it is `num_voxels`. Source: [smap] Eq. (3.18).
int steps_of_leaf(const LeafSample& leaf, double num_voxels, LogOdds class_prior) {
  const LogOdds says = leaf.occupied && leaf.best_class
                           ? LogOdds(leaf.class_log_odds.value() - class_prior.value())
                           : leaf.occupancy;
  return static_cast<int>(std::lround(num_voxels * to_steps(says)));
}

ColumnSums sum_columns(const LeafSource& leaves,
                       const HeightBand& band,
                       const GridGeometry& geometry,
                       const LeafKinds& kinds,
                       LogOdds class_prior) {
  ColumnSums sums;
  const std::size_t num_cells = geometry.num_cells();
  sums.occupied.assign(num_cells, 0);
  sums.free.assign(num_cells, 0);
  sums.is_occupied.assign(num_cells, false);
  for (const ClassId id : kinds.classes) {
    sums.of_class[id].assign(num_cells, 0);
    sums.has_class[id].assign(num_cells, false);
  }
  leaves([&](const LeafSample& leaf) {
    for_each_column(geometry, band, leaf, [&](Cell cell, double covered, double height_m) {
      const std::size_t i = geometry.index(cell);
      const int steps =
          steps_of_leaf(leaf, covered * height_m / kinds.smallest_edge_m, class_prior);
      (leaf.occupied ? sums.occupied : sums.free)[i] += steps;
      if (!leaf.occupied) return;
      sums.is_occupied[i] = true;
      if (!leaf.best_class) return;
      sums.of_class.at(*leaf.best_class)[i] += steps;
      sums.has_class.at(*leaf.best_class)[i] = true;
    });
  });
  return sums;
}

Result<LogOddsGrid> grid_of(ClassId id, const ColumnSums& sums, const OccupancyGrid& occupancy) {
  const StepSums& of_class = sums.of_class.at(id);
  const std::vector<bool>& has_class = sums.has_class.at(id);
  std::vector<LogOddsSteps> cells(of_class.size(), 0);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    int steps = 0;
    if (has_class[i]) {
      steps = of_class[i];
    } else if (sums.is_occupied[i]) {
      steps = -sums.occupied[i];
    } else if (occupancy.cells()[i] == kFreeCell) {
      steps = sums.free[i];
    }
    cells[i] = to_steps(from_steps(steps));
  }
  return LogOddsGrid::create(occupancy.geometry(), std::move(cells));
}

}  // namespace

Result<std::vector<ClassEvidenceGrid>> project_class_evidence(
    const LeafSource& leaves,
    const HeightBand& band,
    const OccupancyProjectionOptions& options,
    std::size_t num_classes) {
  using Grids = std::vector<ClassEvidenceGrid>;
  HYPERMAP_ASSIGN_OR_RETURN(const OccupancyGrid occupancy,
                            project_occupancy(leaves, band, options));
  return guarded(ErrorCode::kInvalidArgument, "the evidence", [&]() -> Result<Grids> {
    const GridGeometry& geometry = occupancy.geometry();
    const LeafKinds kinds = kinds_in(leaves, band, geometry);
    const std::set<ClassId>& classes = kinds.classes;
    if (classes.size() * geometry.num_cells() > kMaxCellsOfClasses) {
      return fail(ErrorCode::kLimit,
                  std::to_string(classes.size()) + " grids together have more than 2^30 cells",
                  "resolution_m");
    }
    const Probability prior(1.0 / static_cast<double>(std::max<std::size_t>(num_classes, 2)));
    const ColumnSums sums = sum_columns(leaves, band, geometry, kinds, LogOdds::of(prior));
    Grids grids;
    for (const ClassId id : classes) {
      HYPERMAP_ASSIGN_OR_RETURN(LogOddsGrid grid, grid_of(id, sums, occupancy));
      grids.push_back({id, std::move(grid)});
    }
    return grids;
  });
}

}  // namespace hypermap
