// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/stack/grid_stack.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/base/option_rows.hpp"
#include "resampler.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::size_t kMaxCellsOfLayers = std::size_t{1} << 30U;
constexpr std::size_t kMaxLayerNameBytes = 512;

constexpr OptionRow kStackRows[] = {
    option::number<&GridStackOptions::max_log_odds>(
        "max_log_odds",
        option::above(0, 13.815),
        {.unit = "log-odds", .effect = "Evidence saturates here; smaller is overturned sooner."}),
    option::number<&GridStackOptions::keep_share>(
        "keep_share",
        {},
        {.effect = "Share of old evidence that stays when new one comes; 1 forgets nothing."}),
};

Result<void> check_names(const GridStackOptions& options) {
  if (!options.parent.starts_with('/') || options.parent.ends_with('/')) {
    return fail(ErrorCode::kInvalidArgument,
                "must begin with / and not end with it, is '" + printable(options.parent) + "'",
                "parent");
  }
  if (!options.frame_id.empty()) return {};
  return fail(ErrorCode::kInvalidArgument, "a frame must have a name", "frame_id");
}

Result<void> check_layer_name(const std::string& name, const std::string& parent) {
  const bool is_below = name != parent && is_at_or_below(name, parent);
  const bool has_empty_part = name.ends_with('/') || name.find("//") != std::string::npos;
  if (is_below && !has_empty_part && name.size() <= kMaxLayerNameBytes) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be a name below " + printable(parent) +
                  "/, without empty parts and of at most " + std::to_string(kMaxLayerNameBytes) +
                  " bytes, is '" + printable(name) + "'",
              "layer");
}

Result<void> check_sensor(const SensorGrid& sensor, const GridStackOptions& options) {
  HYPERMAP_TRY(check_layer_name(sensor.layer, options.parent));
  if (sensor.weight > 0.0 && sensor.weight <= kMaxSensorWeight) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be above 0 and at most " + number_text(kMaxSensorWeight) + ", is " +
                  number_text(sensor.weight),
              "weight");
}

Result<void> check_num_layers(std::size_t num_layers, const GridGeometry& geometry) {
  if (num_layers * geometry.num_cells() <= kMaxCellsOfLayers) return {};
  return fail(ErrorCode::kLimit,
              std::to_string(num_layers) + " layers together have more than 2^30 cells",
              "layer");
}

Result<void> check_saturation(const LogOddsGrid& grid, const GridStackOptions& options) {
  const int max_steps = to_steps(options.max_log_odds);
  const auto cells = grid.cells();
  const auto beyond =
      std::ranges::find_if(cells, [max_steps](int steps) { return std::abs(steps) > max_steps; });
  if (beyond == cells.end()) return {};
  return fail(ErrorCode::kInvalidArgument,
              "log-odds must be at most " + number_text(options.max_log_odds.value()) +
                  " either way, is " + number_text(from_steps(*beyond).value()) + " in cell " +
                  std::to_string(beyond - cells.begin()),
              "cells");
}

/// A layer that was fused before.
Result<void> check_layer(const std::string& name,
                         const LogOddsGrid& grid,
                         const GridGeometry& geometry,
                         const GridStackOptions& options) {
  HYPERMAP_TRY(check_layer_name(name, options.parent));
  if (grid.geometry() != geometry)
    return fail(ErrorCode::kInvalidArgument, printable(name) + " has other cells", "layer");
  return check_saturation(grid, options);
}

/// Evidence that reaches a cell.
struct CellEvidence {
  Cell cell;
  int steps = 0;
};

std::vector<CellEvidence> evidence_of(const Resampler& resampler, double weight) {
  std::vector<CellEvidence> evidence;
  const CellWindow& window = resampler.window();
  for (int row = window.first.row; row < window.end.row; ++row) {
    for (int col = window.first.col; col < window.end.col; ++col) {
      const LogOddsSteps steps = resampler.at({col, row});
      const int weighted = static_cast<int>(std::lround(weight * steps));
      if (weighted != 0) evidence.push_back({{col, row}, weighted});
    }
  }
  return evidence;
}

/// Does not throw.
void add_evidence(LogOddsGrid& layer,
                  std::span<const CellEvidence> evidence,
                  const GridStackOptions& options) {
  const int max_steps = to_steps(options.max_log_odds);
  for (const CellEvidence& reached : evidence) {
    const int kept = static_cast<int>(options.keep_share * layer.at(reached.cell));
    const int sum = std::clamp(kept + reached.steps, -max_steps, max_steps);
    layer.set(reached.cell, static_cast<LogOddsSteps>(sum));
  }
}

/// Does not throw. What reaches beyond `to` is left out.
void copy_cells(const LogOddsGrid& from, Cell first, LogOddsGrid& to) {
  const auto end_of = [](int begin, int length, int size) {
    return static_cast<int>(
        std::clamp(std::int64_t{begin} + length, std::int64_t{0}, std::int64_t{size}));
  };
  const Cell end{end_of(first.col, from.geometry().cols, to.geometry().cols),
                 end_of(first.row, from.geometry().rows, to.geometry().rows)};
  for (int row = std::max(first.row, 0); row < end.row; ++row) {
    for (int col = std::max(first.col, 0); col < end.col; ++col) {
      to.set({col, row}, from.at({col - first.col, row - first.row}));
    }
  }
}

}  // namespace

const OptionTable& option_table(const GridStackOptions&) {
  static constexpr OptionTable kTable{kStackRows, kRule<check_names>};
  return kTable;
}

Result<void> validate(const GridStackOptions& options) {
  return check_options(options);
}

std::string_view last_part(std::string_view layer) {
  return layer.substr(layer.rfind('/') + 1);
}

bool is_at_or_below(std::string_view layer, std::string_view name) {
  return layer.starts_with(name) && (layer.size() == name.size() || layer[name.size()] == '/');
}

std::string stack_layer_name(std::string_view parent, std::string_view name) {
  std::string plain(name);
  std::ranges::replace(plain, '/', '_');
  return std::string(parent) + "/" + plain;
}

Result<GridStack> GridStack::create(const GridGeometry& geometry, GridStackOptions options) {
  HYPERMAP_TRY(validate(options));
  HYPERMAP_TRY(validate(geometry));
  if (geometry.num_cells() == 0) {
    return fail(ErrorCode::kInvalidArgument, "has no cells", "geometry");
  }
  return GridStack(geometry, std::move(options));
}

Result<GridStack> GridStack::create(const GridGeometry& geometry,
                                    GridStackOptions options,
                                    Layers layers) {
  HYPERMAP_ASSIGN_OR_RETURN(GridStack stack, create(geometry, std::move(options)));
  HYPERMAP_TRY(check_num_layers(layers.size(), geometry));
  for (const auto& [name, grid] : layers)
    HYPERMAP_TRY(check_layer(name, grid, geometry, stack.options_));
  stack.layers_ = std::move(layers);
  return stack;
}

Result<void> GridStack::check_new_layer(const std::string& layer) const {
  if (layers_.contains(layer)) return {};
  return check_num_layers(layers_.size() + 1, geometry_);
}

Result<std::size_t> GridStack::fuse(const SensorGrid& sensor,
                                    const Eigen::Matrix3d& stack_from_sensor,
                                    const ResamplingOptions& resampling) {
  HYPERMAP_TRY(check_sensor(sensor, options_));
  HYPERMAP_TRY(check_new_layer(sensor.layer));
  const bool is_new = !layers_.contains(sensor.layer);
  HYPERMAP_ASSIGN_OR_RETURN(
      const Resampler resampler,
      Resampler::create(sensor.grid, geometry_, stack_from_sensor, resampling));
  return guarded(ErrorCode::kInvalidArgument, "the layer", [&]() -> Result<std::size_t> {
    const std::vector<CellEvidence> evidence = evidence_of(resampler, sensor.weight);
    if (is_new) {
      HYPERMAP_ASSIGN_OR_RETURN(LogOddsGrid unknown, LogOddsGrid::create(geometry_));
      layers_.emplace(sensor.layer, std::move(unknown));
    }
    add_evidence(layers_.find(sensor.layer)->second, evidence, options_);
    return evidence.size();
  });
}

Result<std::size_t> GridStack::fuse(const SensorGrid& sensor,
                                    const FrameTree& frames,
                                    const ResamplingOptions& resampling) {
  HYPERMAP_ASSIGN_OR_RETURN(const Eigen::Isometry2d stack_from_sensor,
                            frames.to_from(options_.frame_id, sensor.frame_id));
  return fuse(sensor, Eigen::Matrix3d(stack_from_sensor.matrix()), resampling);
}

Result<void> GridStack::replace_cells(const std::string& layer,
                                      const LogOddsGrid& grid,
                                      Cell first) {
  HYPERMAP_TRY(check_layer_name(layer, options_.parent));
  HYPERMAP_TRY(check_new_layer(layer));
  HYPERMAP_TRY(check_saturation(grid, options_));
  return guarded(ErrorCode::kInvalidArgument, "the layer", [&]() -> Result<void> {
    if (!layers_.contains(layer)) {
      HYPERMAP_ASSIGN_OR_RETURN(LogOddsGrid unknown, LogOddsGrid::create(geometry_));
      layers_.emplace(layer, std::move(unknown));
    }
    copy_cells(grid, first, layers_.find(layer)->second);
    return {};
  });
}

}  // namespace hypermap
