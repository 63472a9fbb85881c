// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where labels stand in an image so that none covers another.
///
/// Scope: greedy, in the order given: early labels get the best places. Pure arithmetic.
#pragma once

#include "hypermap/viewer_offscreen/rendering/image_rect.hpp"

#include <span>
#include <vector>

namespace hypermap {

/// Open: rectangles that share an edge do not overlap.
[[nodiscard]] bool overlap(const ImageRect& a, const ImageRect& b);

/// A text of known size and the place it speaks of.
struct LabelRequest {
  double anchor_x_px = 0.0;
  double anchor_y_px = 0.0;
  double width_px = 0.0;
  double height_px = 0.0;
  ImageRect subject = {};  ///< Of a small place: labels stand beside it. Without width: none.
};

struct PlacedLabel {
  ImageRect rect;
  bool shown = true;    ///< False where no free place was left; `rect` is meaningless then.
  bool leader = false;  ///< The label stands apart from its anchor: draw a line between them.
};

struct LabelLayoutOptions {
  double gap_px = 3.0;             ///< Free space between labels.
  double max_distance_px = 140.0;  ///< From an anchor to its label.
  double leader_from_px = 14.0;    ///< Beyond this distance a label needs a line to its anchor.
};

/// Places the labels inside `canvas`, away from `obstacles`, from each other and from all subjects:
/// above the anchor if that is free, else on the nearest free place on rings around it. Where that
/// leaves no place, subjects of other labels may be covered, never the label's own.
///
/// One result per request, in their order. Labels whose anchor lies outside the canvas, and labels
/// without a free place, are not shown. Cost: O(labels * places tried * (labels + obstacles)).
[[nodiscard]] std::vector<PlacedLabel> place_labels(std::span<const LabelRequest> requests,
                                                    const ImageRect& canvas,
                                                    std::span<const ImageRect> obstacles,
                                                    const LabelLayoutOptions& options = {});

}  // namespace hypermap
