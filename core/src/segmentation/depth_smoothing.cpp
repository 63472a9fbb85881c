// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/depth_smoothing.hpp"

#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/segmentation/depth_cloud.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <span>
#include <string_view>

namespace hypermap {
namespace {

/// Inverse depth where nothing was measured; no gate reaches it.
constexpr float kNotMeasured = 0.0F;
constexpr float kStays = -1.0F;

constexpr std::string_view kRuleNames[] = {"none", "pairs"};

constexpr OptionRow kSmoothingRows[] = {
    option::choice<&DepthSmoothingOptions::rule>(
        "rule",
        kRuleNames,
        {.effect = "Whether noise is taken out of the depth before all else.",
         .smap = DepthSmoothingRule::kNone,
         .hypermap = DepthSmoothingRule::kNone}),
    option::count<&DepthSmoothingOptions::radius_px>(
        "radius_px",
        {1, 8},
        {.unit = "px", .effect = "Neighbours of a pixel reach so far in each direction."}),
    option::number<&DepthSmoothingOptions::gate_sigmas>(
        "gate_sigmas",
        option::above(0, 10),
        {.effect = "Neighbours that differ by more times the sensor's noise are another surface."}),
    option::number<&DepthSmoothingOptions::min_depth_m>(
        "min_depth_m", {0, 100}, {.unit = "m", .effect = "Nearer pixels stay as measured."}),
};

constexpr std::ptrdiff_t kBlockPx = 256;

/// Of pixels side by side: the sums of their near pairs, and how many these are.
struct BlockSums {
  std::array<float, kBlockPx> inverse = {};
  std::array<float, kBlockPx> pairs = {};
};

/// Pixels [begin, end) of one row: at most kBlockPx.
struct Block {
  std::ptrdiff_t begin = 0;
  std::ptrdiff_t end = 0;
};

/// The rows v, v + dv and v - dv of inverse depth, and row v of the gate.
struct Rows {
  const float* centre = nullptr;
  const float* below = nullptr;
  const float* above = nullptr;
  const float* gate = nullptr;
};

/// The largest difference of inverse depth that is near, less than the inverse depth itself.
float gate(double depth_m, const DepthSmoothingOptions& options) {
  if (depth_m < options.min_depth_m) return kStays;
  const double nearness = std::min(options.gate_sigmas * axial_noise_m(depth_m) / depth_m, 0.5);
  return static_cast<float>(nearness / depth_m);  // the derivative of 1 / z is 1 / z^2
}

/// Adds the pairs (u + du, v + dv), (u - du, v - dv) of the block's pixels that have both
/// in the image. Without branches, so that it runs on vectors.
void add_pairs(const Rows& rows,
               std::ptrdiff_t du,
               const Block& block,
               std::ptrdiff_t width,
               BlockSums& sums) {
  const std::ptrdiff_t begin = std::max(block.begin, std::abs(du));
  const std::ptrdiff_t end = std::min(block.end, width - std::abs(du));
  float* const inverse = sums.inverse.data() - block.begin;
  float* const pairs = sums.pairs.data() - block.begin;
  for (std::ptrdiff_t u = begin; u < end; ++u) {
    const float one = rows.below[u + du];
    const float other = rows.above[u - du];
    const float one_is_near = std::abs(one - rows.centre[u]) <= rows.gate[u] ? 1.0F : 0.0F;
    const float other_is_near = std::abs(other - rows.centre[u]) <= rows.gate[u] ? 1.0F : 0.0F;
    const float are_near = one_is_near * other_is_near;
    inverse[u] += are_near * (one + other);
    pairs[u] += are_near;
  }
}

}  // namespace

const OptionTable& option_table(const DepthSmoothingOptions&) {
  static constexpr OptionTable kTable{kSmoothingRows};
  return kTable;
}

Result<void> validate(const DepthSmoothingOptions& options) {
  return check_options(options);
}

/// Inverse depth and gate of one row.
void DepthSmoother::measure_row(const DepthImage& depth_m, int v) {
  const std::size_t begin = depth_m.index(0, v);
  const std::size_t end = begin + static_cast<std::size_t>(depth_m.width_px());
  for (std::size_t i = begin; i < end; ++i) {
    const float depth = depth_m.pixels()[i];
    inverse_[i] = is_measured(depth) ? 1.0F / depth : kNotMeasured;
    gate_[i] = is_measured(depth) ? gate(static_cast<double>(depth), options_) : kStays;
  }
}

void DepthSmoother::smooth_row(const DepthImage& depth_m, int v, float* smoothed_m) const {
  const std::ptrdiff_t width = depth_m.width_px();
  const int radius = options_.radius_px;
  const int rows_beside = std::min({radius, v, depth_m.height_px() - 1 - v});
  const auto row = [&](const std::vector<float>& values, int of) {
    return values.data() + depth_m.index(0, of);
  };
  const float* const centre = row(inverse_, v);
  for (Block block; block.begin < width; block.begin = block.end) {
    block.end = std::min(block.begin + kBlockPx, width);
    BlockSums sums;
    for (int dv = 0; dv <= rows_beside; ++dv) {
      const Rows rows{centre, row(inverse_, v + dv), row(inverse_, v - dv), row(gate_, v)};
      for (int du = dv == 0 ? 1 : -radius; du <= radius; ++du) {
        add_pairs(rows, du, block, width, sums);
      }
    }
    for (std::ptrdiff_t u = block.begin; u < block.end; ++u) {
      const auto i = static_cast<std::size_t>(u - block.begin);
      if (sums.pairs[i] > 0.0F) {
        smoothed_m[u] = (2.0F * sums.pairs[i] + 1.0F) / (sums.inverse[i] + centre[u]);
      }
    }
  }
}

DepthImage DepthSmoother::smoothed(const DepthImage& depth_m, int num_threads) {
  DepthImage smoothed_m = depth_m;
  if (options_.rule == DepthSmoothingRule::kNone || depth_m.empty()) return smoothed_m;
  inverse_.resize(depth_m.size());
  gate_.resize(depth_m.size());
  float* const pixels = smoothed_m.pixels().data();
  const int height_px = depth_m.height_px();
  tbb::task_arena arena(num_threads);
  arena.execute([&] {
    tbb::parallel_for(0, height_px, [&](int v) { measure_row(depth_m, v); });
    tbb::parallel_for(0, height_px, [&](int v) {
      const auto row_gate = std::span(gate_).subspan(depth_m.index(0, v),
                                                     static_cast<std::size_t>(depth_m.width_px()));
      if (std::ranges::all_of(row_gate, [](float gate) { return gate < 0.0F; })) return;
      smooth_row(depth_m, v, pixels + depth_m.index(0, v));
    });
  });
  return smoothed_m;
}

}  // namespace hypermap
