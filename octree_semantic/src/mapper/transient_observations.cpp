// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/transient_observations.hpp"

#include "hypermap/core/segmentation/masks.hpp"
#include "mapper/borrowed_frames.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace hypermap {

RgbdFrame without_observations(const RgbdFrame& frame, std::span<const Observation> observations) {
  MaskImage marks(frame.camera.width_px, frame.camera.height_px);
  for (const Observation& observation : observations) {
    for (const std::uint32_t pixel : observation.segment.pixel_indices) marks.pixels()[pixel] = 1;
  }
  const MaskImage reached = widened_by_tolerance(marks);
  DepthImage depth_m(frame.camera.width_px, frame.camera.height_px);
  std::ranges::transform(frame.depth_m.pixels(),
                         reached.pixels(),
                         depth_m.pixels().begin(),
                         [](float z_m, std::uint8_t is_in) { return is_in == 0 ? z_m : 0.0F; });
  return with_depth(frame, std::move(depth_m));
}

}  // namespace hypermap
