// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/sensor_noise.hpp"

#include "hypermap/core/base/random_numbers.hpp"

#include <array>
#include <cassert>
#include <cmath>

namespace hypermap {
namespace {

constexpr std::uint64_t kNoiseStream = 0x6465707468;  // which numbers: "depth"

/// True when depth jumps between the pixel and one of its four neighbours.
bool is_at_edge(const DepthImage& depth_m, int u, int v, double ratio) {
  const double here = static_cast<double>(depth_m.at(u, v));
  constexpr std::array<std::array<int, 2>, 4> kNeighbours{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  for (const auto& [du, dv] : kNeighbours) {
    if (!depth_m.contains(u + du, v + dv)) continue;
    const double there = static_cast<double>(depth_m.at(u + du, v + dv));
    if (std::abs(there - here) > ratio * std::min(here, there)) return true;
  }
  return false;
}

bool in_range(double depth_m, const SensorNoiseOptions& options) {
  return depth_m >= options.min_range_m && depth_m <= options.max_range_m;
}

}  // namespace

double axial_noise_m(double depth_m, const SensorNoiseOptions& options) {
  const double beyond = depth_m - 0.4;
  return options.noise_base_m + options.noise_per_m2 * beyond * beyond;
}

DepthImage measured_depth(const DepthImage& true_depth_m,
                          const Image<float>& incidence_cos,
                          const SensorNoiseOptions& options,
                          std::uint64_t seed,
                          std::uint64_t frame) {
  assert(true_depth_m.size() == incidence_cos.size());
  const CounterRng random(seed, kNoiseStream, frame);
  const double least_cos = std::cos(options.max_incidence_rad);
  DepthImage measured(true_depth_m.width_px(), true_depth_m.height_px());
  for (int v = 0; v < measured.height_px(); ++v) {
    for (int u = 0; u < measured.width_px(); ++u) {
      const double depth = static_cast<double>(true_depth_m.at(u, v));
      if (!(depth > 0.0) || !in_range(depth, options)) continue;
      if (static_cast<double>(incidence_cos.at(u, v)) < least_cos) continue;
      if (is_at_edge(true_depth_m, u, v, options.edge_ratio)) continue;
      const std::uint64_t counter = 2 * measured.index(u, v);
      if (random.uniform_at(counter) < options.dropout) continue;
      const double noisy = depth + axial_noise_m(depth, options) * random.normal_at(counter + 1);
      const double stepped = options.step_m * std::round(noisy / options.step_m);
      if (in_range(stepped, options)) measured.at(u, v) = static_cast<float>(stepped);
    }
  }
  return measured;
}

}  // namespace hypermap
