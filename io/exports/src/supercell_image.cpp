// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/exports/supercell_export.hpp"
#include "hypermap/projection/stack/evidence_color.hpp"

#include <algorithm>
#include <cstdint>

namespace hypermap {
namespace {

constexpr int kLongerSide = 512;  // in pixels

Rgb8 darker(Rgb8 color) {
  const auto part = [](std::uint8_t value) { return static_cast<std::uint8_t>(value * 3 / 5); };
  return {part(color.r), part(color.g), part(color.b)};
}

}  // namespace

ColorImage supercell_image(const Supercells& supercells,
                           const TopometricGraph& graph,
                           const ClassPalette& palette) {
  std::vector<Rgb8> colors;
  for (const SupercellNode& node : graph.nodes)
    colors.push_back(evidence_color(evidence_of(node, graph), palette));
  const GridGeometry& geometry = supercells.geometry;
  const int scale = std::max(kLongerSide / std::max(geometry.cols, geometry.rows), 1);
  ColorImage image(geometry.cols * scale, geometry.rows * scale);
  const auto label_at = [&](int u, int v) {
    const Cell cell{u / scale, geometry.rows - 1 - v / scale};
    return supercells.labels[geometry.index(cell)];
  };
  for (int v = 0; v < image.height_px(); ++v) {
    for (int u = 0; u < image.width_px(); ++u) {
      const std::int32_t label = label_at(u, v);
      const bool is_outline =
          (u > 0 && label_at(u - 1, v) != label) || (v > 0 && label_at(u, v - 1) != label);
      const Rgb8 color = colors[static_cast<std::size_t>(label)];
      image.at(u, v) = is_outline ? darker(color) : color;
    }
  }
  return image;
}

}  // namespace hypermap
