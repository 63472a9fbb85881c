// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A stack as others ask for it: any of its layers, anywhere, at any resolution, one by one or
/// pooled to a single grid.
///
/// Source: [sogm] III-D, III-D.1, figure 4.
#pragma once

#include "hypermap/core/base/job_progress.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// What is asked for: pose, size and resolution as a grid in the stack's frame.
struct StackRequest {
  GridGeometry geometry;
  /// Names of layers; one stands also for all below it. All layers when empty.
  std::vector<std::string> layers = {};
  ResamplingOptions resampling = {};
};

/// The layers on other cells, by the same names. `progress` is called after each layer.
/// Errors: kInterrupted; kNotFound for a name that is no layer's, telling those that there are;
/// those of `GridStack::create` and `resampled`.
[[nodiscard]] Result<GridStack> cut_out(const GridStack& stack,
                                        const StackRequest& request,
                                        const JobProgress& progress = {});

/// How layers become one.
enum class Pooling : std::uint8_t {
  kBayesian,  ///< As independent opinions on one feature ("obstacle"): P_B.
  kMaximum,   ///< Of different features, whichever is the most probable: P_M.
};

/// "bayesian", "maximum".
[[nodiscard]] std::span<const std::string_view> pooling_names();

/// The combined map: one grid of all layers, cell by cell. On other cells, or of some layers only:
/// of what cut_out gives.
///
/// Source: [sogm] Eq. (6). Layers that do not know a cell are skipped; it is unknown when none
/// does. Deviation: printed, P_M takes an unknown layer as 0.5, by which nothing would ever be free
/// where one layer was not looked at. Boundary: a stack without layers gives a grid that knows
/// nothing. Errors: kOutOfMemory.
[[nodiscard]] Result<LogOddsGrid> pooled(const GridStack& stack, Pooling rule);

}  // namespace hypermap
