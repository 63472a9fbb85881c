// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/segmentation_trace.hpp"

#include <array>
#include <cassert>

namespace hypermap {
namespace {

constexpr Rgb8 kNoSegment{255, 0, 0};

/// Colours that differ from red and from each other, first the one of the largest segment.
constexpr std::array<Rgb8, 12> kSegmentColors{{{152, 78, 255},
                                               {77, 190, 80},
                                               {55, 126, 224},
                                               {255, 200, 40},
                                               {64, 210, 210},
                                               {240, 130, 200},
                                               {166, 118, 60},
                                               {150, 220, 100},
                                               {20, 120, 110},
                                               {190, 190, 255},
                                               {255, 230, 150},
                                               {120, 120, 120}}};

Rgb8 color_of(std::int32_t label) {
  if (label == kLabelNone) return kNoSegment;
  return kSegmentColors[static_cast<std::size_t>(label - 1) % kSegmentColors.size()];
}

}  // namespace

ColorImage render_labels(const LabelImage& labels, const ColorImage& background) {
  assert(background.empty() || background.size() == labels.size());
  ColorImage image =
      background.empty() ? ColorImage(labels.width_px(), labels.height_px()) : background;
  const auto pixels = image.pixels();
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const std::int32_t label = labels.pixels()[i];
    if (label >= kLabelNone) pixels[i] = color_of(label);
  }
  return image;
}

}  // namespace hypermap
