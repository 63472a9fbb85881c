// SPDX-License-Identifier: BSD-3-Clause
#include "beam_evidence.hpp"

#include "cell_lattice.hpp"
#include "hypermap/core/base/caught.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hypermap {
namespace {

/// Arcs are drawn as chords that turn by no more than this: within 1e-4 of the range.
constexpr double kChordRad = 0.02;

/// Of a cell, all shares.
struct BeamSums {
  float free = 0.0F;         ///< Of its area, that beams covered before their ends.
  float width = 0.0F;        ///< Of its width, that ends cover.
  float largest_end = 0.0F;  ///< Of one beam's end that lies in it.
};

void append_arc(Ring& ring, const Beam& beam, double radius_m, bool forwards) {
  const double turn = beam.to_rad - beam.from_rad;
  const int num_chords = std::max(1, static_cast<int>(std::ceil(turn / kChordRad)));
  for (int i = 0; i <= num_chords; ++i) {
    const double part = static_cast<double>(forwards ? i : num_chords - i) / num_chords;
    const double bearing = beam.from_rad + part * turn;
    ring.push_back(beam.apex + radius_m * Eigen::Vector2d(std::cos(bearing), std::sin(bearing)));
  }
}

double near_end_m(const Beam& beam) {
  return std::max(0.0, beam.range_m - beam.error_m);
}

/// What lies before the end.
Polygon free_part(const Beam& beam) {
  Polygon sector;
  sector.outer.push_back(beam.apex);
  append_arc(sector.outer, beam, beam.has_end ? near_end_m(beam) : beam.range_m, true);
  return sector;
}

/// Where the end may be.
Polygon end_part(const Beam& beam) {
  Polygon band;
  append_arc(band.outer, beam, beam.range_m + beam.error_m, true);
  append_arc(band.outer, beam, near_end_m(beam), false);
  return band;
}

Rect bounds_of(std::span<const Beam> beams, const Eigen::Vector2d& apex) {
  Rect rect{apex, apex};
  for (const Beam& beam : beams) {
    const Polygon part = beam.has_end ? end_part(beam) : free_part(beam);
    for (const Eigen::Vector2d& corner : part.outer) {
      rect.min = rect.min.cwiseMin(corner);
      rect.max = rect.max.cwiseMax(corner);
    }
  }
  return rect;
}

/// The cells of `whole` around a polygon that lies within it.
struct GridPart {
  GridGeometry geometry;
  Cell first;
};

GridPart part_around(const GridGeometry& whole, const Polygon& polygon) {
  const Rect rect = bounds(polygon);
  const Eigen::Vector2d min = to_cells(whole, rect.min).array().floor();
  const Eigen::Vector2d max = to_cells(whole, rect.max).array().floor();
  GridPart part{whole,
                {std::clamp(static_cast<int>(min.x()), 0, whole.cols - 1),
                 std::clamp(static_cast<int>(min.y()), 0, whole.rows - 1)}};
  part.geometry.cols =
      std::clamp(static_cast<int>(max.x()), 0, whole.cols - 1) - part.first.col + 1;
  part.geometry.rows =
      std::clamp(static_cast<int>(max.y()), 0, whole.rows - 1) - part.first.row + 1;
  part.geometry.origin = from_cells(whole, Eigen::Vector2d(part.first.col, part.first.row));
  return part;
}

class BeamCanvas {
 public:
  explicit BeamCanvas(const GridGeometry& geometry)
      : geometry_(geometry), sums_(geometry.num_cells()) {}

  void add(const Beam& beam) {
    for_each_share(free_part(beam), [](BeamSums& sums, double covered) {
      sums.free += static_cast<float>(covered);
    });
    if (beam.has_end) add_end(beam);
  }

  [[nodiscard]] std::vector<LogOddsSteps> cells(const EvidenceOptions& options) const {
    const LogOdds hit = LogOdds::of(options.p_hit);
    const LogOdds free = LogOdds::of(options.p_free);
    std::vector<LogOddsSteps> cells;
    cells.reserve(sums_.size());
    for (const BeamSums& sums : sums_) {
      const double has_end =
          static_cast<double>(std::clamp(std::max(sums.largest_end, sums.width), 0.0F, 1.0F));
      const double is_free =
          (1.0 - has_end) * static_cast<double>(std::clamp(sums.free, 0.0F, 1.0F));
      cells.push_back(to_steps(has_end * hit + is_free * free));
    }
    return cells;
  }

 private:
  void add_end(const Beam& beam) {
    const double edge_m = geometry_.resolution_m;
    const double length_in_cells = 2.0 * beam.error_m / edge_m;
    const double width_in_cells =
        std::min(1.0, beam.range_m * (beam.to_rad - beam.from_rad) / edge_m);
    for_each_share(end_part(beam), [&](BeamSums& sums, double covered) {
      const double width = covered / length_in_cells;
      const double of_end = std::min(width / width_in_cells, std::min(1.0, 1.0 / length_in_cells));
      sums.width += static_cast<float>(width);
      sums.largest_end = std::max(sums.largest_end, static_cast<float>(of_end));
    });
  }

  template <class Add>
  void for_each_share(const Polygon& polygon, const Add& add) {
    const GridPart part = part_around(geometry_, polygon);
    for_each_covered_cell(part.geometry, polygon, [&](Cell cell, double covered) {
      const Cell there{part.first.col + cell.col, part.first.row + cell.row};
      add(sums_[geometry_.index(there)], covered);
    });
  }

  GridGeometry geometry_;
  std::vector<BeamSums> sums_;
};

}  // namespace

Result<LogOddsGrid> evidence_of_beams(std::span<const Beam> beams,
                                      const Eigen::Vector2d& apex,
                                      const EvidenceOptions& options) {
  HYPERMAP_ASSIGN_OR_RETURN(const GridGeometry geometry,
                            lattice_around(bounds_of(beams, apex), options.resolution_m));
  return guarded(ErrorCode::kInvalidArgument, "the sensor's grid", [&] {
    BeamCanvas canvas(geometry);
    for (const Beam& beam : beams) canvas.add(beam);
    return LogOddsGrid::create(geometry, canvas.cells(options));
  });
}

}  // namespace hypermap
