// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The best colour view of each object, while a map is made.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "hypermap/io/archive/object_views.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"

#include <cstddef>

namespace hypermap {

/// What the box shows of the image, not enlarged, its longest side at most `max_side_px`: each
/// pixel is the mean of those that it stands for. Boundary: an empty image for a box outside.
[[nodiscard]] ColorImage thumbnail(const ColorImage& image,
                                   const PixelBox& box_px,
                                   int max_side_px);

/// That as a JPEG of quality 85; where it would be larger than kMaxViewBytes, of half the side.
/// Requires: a box that meets the image. Errors: those of encode_jpeg.
[[nodiscard]] Result<std::string> view_jpeg(const ColorImage& image, const PixelBox& box_px);

/// Keeps of each object the view of the largest quality: the pixels of its segment, which are those
/// that nothing hides, times the score of the detection. Of equals the earlier frame.
class BestViews {
 public:
  explicit BestViews(ObjectViews views = {}) : views_(std::move(views)) {}

  /// Follows what a frame that is in the map now did to objects: of two that merged the better view
  /// stays, those of removed ones go.
  void follow(const FrameReport& report, const ObjectMap& objects);
  /// Looks at the objects that the frame showed, after `follow`. Boundary: without colour there is
  /// nothing to see. Errors: those of encode_jpeg.
  [[nodiscard]] Result<void> add(const RgbdFrame& frame, const FrameReport& report);

  [[nodiscard]] const ObjectViews& views() const noexcept { return views_; }
  /// Whether any frame had colour.
  [[nodiscard]] bool saw_color() const noexcept { return saw_color_; }

 private:
  void merge(const ObjectMerge& merge);

  ObjectViews views_;
  bool saw_color_ = false;
};

}  // namespace hypermap
