// SPDX-License-Identifier: BSD-3-Clause
#include "background_surfaces.hpp"

#include "hypermap/core/segmentation/masks.hpp"

#include <cstddef>
#include <span>
#include <utility>

namespace hypermap {
namespace {

/// 1 on the cells that are measured and not near the mask.
MaskImage cells_off_mask(const DepthWindow& window) {
  MaskImage off = widened(window.in_mask, window.mask_tolerance);
  const std::span<std::uint8_t> values = off.pixels();
  for (std::size_t cell = 0; cell < window.size(); ++cell)
    values[cell] = values[cell] == 0 && window.depth_m[cell] > 0.0F ? 1 : 0;
  return off;
}

/// 1 on the cells of surfaces with more than `max_outside` outside the box.
MaskImage cells_running_on(const DepthWindow& window,
                           const DepthComponents& surfaces,
                           double max_outside) {
  std::vector<std::uint8_t> runs_on;
  runs_on.reserve(surfaces.components.size());
  for (const DepthComponent& surface : surfaces.components) {
    const bool is_own = surface.kind != kOthersKind;
    runs_on.push_back(is_own && surface.outside_share() > max_outside ? 1 : 0);
  }
  MaskImage cells(window.width(), window.height());
  const std::span<std::uint8_t> values = cells.pixels();
  for (std::size_t cell = 0; cell < window.size(); ++cell) {
    const std::uint32_t id = surfaces.of_cell[cell];
    if (id != kNoComponent) values[cell] = runs_on[id];
  }
  return cells;
}

}  // namespace

BackgroundCells background_surfaces(const DepthWindow& window,
                                    const DepthComponents& surfaces,
                                    const std::vector<std::uint8_t>& is_object,
                                    const ForegroundOptions& options) {
  MaskImage cells = window.is_masked()
                        ? cells_off_mask(window)
                        : cells_running_on(window, surfaces, options.part_max_outside);
  const std::span<std::uint8_t> values = cells.pixels();
  for (std::size_t cell = 0; cell < window.size(); ++cell) {
    if (is_object[cell] != 0) values[cell] = 0;
  }
  return {.rect = window.rect, .block_px = window.block_px, .is_background = std::move(cells)};
}

}  // namespace hypermap
