// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/stack/log_odds_grid.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/number_text.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

namespace hypermap {
namespace {

constexpr double kStepsPerUnit = 1000.0;

bool is_within_bounds(int steps) {
  return steps >= -kMaxLogOddsSteps && steps <= kMaxLogOddsSteps;
}

/// Of each per cent, 0 .. 100.
std::array<LogOddsSteps, 101> steps_of_per_cents() {
  std::array<LogOddsSteps, 101> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = to_steps(LogOdds::of(Probability(static_cast<double>(i) / 100.0)));
  }
  return table;
}

}  // namespace

LogOddsSteps to_steps(LogOdds log_odds) noexcept {
  assert(!std::isnan(log_odds.value()));
  constexpr double kMax = kMaxLogOddsSteps;
  const double steps = std::clamp(log_odds.value() * kStepsPerUnit, -kMax, kMax);
  return static_cast<LogOddsSteps>(std::lround(steps));
}

Result<LogOddsGrid> LogOddsGrid::create(const GridGeometry& geometry) {
  HYPERMAP_TRY(validate(geometry));
  return guarded(ErrorCode::kInvalidArgument, "the grid", [&] {
    return create(geometry, std::vector<LogOddsSteps>(geometry.num_cells(), 0));
  });
}

Result<LogOddsGrid> LogOddsGrid::create(const GridGeometry& geometry,
                                        std::vector<LogOddsSteps> cells) {
  HYPERMAP_TRY(validate(geometry));
  if (cells.size() != geometry.num_cells()) {
    return fail(ErrorCode::kInvalidArgument,
                std::to_string(cells.size()) + " cells given, the geometry has " +
                    std::to_string(geometry.num_cells()),
                "cells");
  }
  const auto wrong = std::ranges::find_if_not(cells, is_within_bounds);
  if (wrong != cells.end()) {
    return fail(ErrorCode::kInvalidArgument,
                "log-odds must be from -13.815 to 13.815, is " +
                    number_text(from_steps(*wrong).value()) + " in cell " +
                    std::to_string(wrong - cells.begin()),
                "cells");
  }
  LogOddsGrid grid;
  grid.geometry_ = geometry;
  grid.cells_ = std::move(cells);
  return grid;
}

Result<LogOddsGrid> LogOddsGrid::of_probabilities(const GridGeometry& geometry,
                                                  std::span<const double> probabilities) {
  HYPERMAP_TRY(validate(geometry));
  const auto is_probability = [](double p) { return p >= 0.0 && p <= 1.0; };  // false for NaN
  const auto wrong = std::ranges::find_if_not(probabilities, is_probability);
  if (wrong != probabilities.end()) {
    return fail(ErrorCode::kInvalidArgument,
                "a probability must be from 0 to 1, is " + number_text(*wrong) + " in cell " +
                    std::to_string(wrong - probabilities.begin()),
                "cells");
  }
  return guarded(ErrorCode::kInvalidArgument, "the grid", [&] {
    std::vector<LogOddsSteps> cells;
    cells.reserve(probabilities.size());
    for (const double p : probabilities) cells.push_back(to_steps(LogOdds::of(Probability(p))));
    return create(geometry, std::move(cells));
  });
}

Result<LogOddsGrid> LogOddsGrid::of_occupancy(const OccupancyGrid& occupancy) {
  return guarded(ErrorCode::kInvalidArgument, "the grid", [&] {
    const auto steps_of = steps_of_per_cents();
    std::vector<LogOddsSteps> cells;
    cells.reserve(occupancy.cells().size());
    for (const std::int8_t cell : occupancy.cells()) {
      const bool is_known = cell != kUnknownCell;
      cells.push_back(is_known ? steps_of[static_cast<std::uint8_t>(cell)] : LogOddsSteps{0});
    }
    return create(occupancy.geometry(), std::move(cells));
  });
}

void LogOddsGrid::set(Cell cell, LogOddsSteps steps) {
  assert(geometry_.contains(cell) && is_within_bounds(steps));
  cells_[geometry_.index(cell)] = steps;
}

std::size_t LogOddsGrid::num_known() const noexcept {
  return cells_.size() - static_cast<std::size_t>(std::ranges::count(cells_, LogOddsSteps{0}));
}

Result<OccupancyGrid> to_occupancy(const LogOddsGrid& grid) {
  return guarded(ErrorCode::kInvalidArgument, "the grid", [&] {
    std::vector<std::int8_t> cells;
    cells.reserve(grid.cells().size());
    for (const LogOddsSteps steps : grid.cells()) {
      const double p = from_steps(steps).probability().value();
      cells.push_back(steps == 0 ? kUnknownCell : static_cast<std::int8_t>(std::lround(100 * p)));
    }
    return OccupancyGrid::create(grid.geometry(), std::move(cells));
  });
}

}  // namespace hypermap
