// SPDX-License-Identifier: BSD-3-Clause
#include "simulated_mask.hpp"

#include "hypermap/core/segmentation/depth_cloud.hpp"

#include <algorithm>
#include <cstdint>

namespace hypermap {
MaskImage exact_mask(const Image<ObjectId>& instances, ObjectId id) {
  MaskImage mask(instances.width_px(), instances.height_px());
  std::ranges::transform(instances.pixels(), mask.pixels().begin(), [id](ObjectId at) {
    return static_cast<std::uint8_t>(at == id ? 1 : 0);
  });
  return mask;
}

MaskImage network_mask(const Image<ObjectId>& instances,
                       ObjectId id,
                       const PixelBox& box_px,
                       const MaskError& error) {
  const int width = instances.width_px();
  const int height = instances.height_px();
  const PixelRect box = pixels_in(box_px, width, height);
  MaskImage mask(width, height);
  const auto is_of_object = [&](int u, int v) {
    const int from_u = u - error.du_px;
    const int from_v = v - error.dv_px;
    return from_u >= 0 && from_v >= 0 && from_u < width && from_v < height &&
           instances.at(from_u, from_v) == id;
  };
  const auto take_block = [&](int u_begin, int v_begin) {
    const PixelRect block{u_begin,
                          v_begin,
                          std::min(u_begin + error.block_px, width),
                          std::min(v_begin + error.block_px, height)};
    int num_of_object = 0;
    for (int v = block.v_begin; v < block.v_end; ++v) {
      for (int u = block.u_begin; u < block.u_end; ++u) num_of_object += is_of_object(u, v) ? 1 : 0;
    }
    if (2 * num_of_object < block.width() * block.height()) return;
    for (int v = std::max(block.v_begin, box.v_begin); v < std::min(block.v_end, box.v_end); ++v) {
      for (int u = std::max(block.u_begin, box.u_begin); u < std::min(block.u_end, box.u_end); ++u)
        mask.at(u, v) = 1;
    }
  };
  const auto block_start = [&](int pixel) { return pixel - pixel % error.block_px; };
  for (int v = block_start(box.v_begin); v < box.v_end; v += error.block_px) {
    for (int u = block_start(box.u_begin); u < box.u_end; u += error.block_px) take_block(u, v);
  }
  return mask;
}

}  // namespace hypermap
