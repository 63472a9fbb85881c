// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What is written around and over an image: title, legend, scale bar, axes, labels.
#pragma once

#include "annotation/text_painter.hpp"
#include "hypermap/core/base/image.hpp"
#include "hypermap/core/geometry/box.hpp"
#include "hypermap/viewer_offscreen/annotation/label_layout.hpp"
#include "hypermap/viewer_offscreen/snapshot/snapshot_camera.hpp"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace hypermap {

/// One line of the legend.
struct LegendRow {
  Rgb8 color;
  std::string name;
  std::vector<std::string> numbers = {};  ///< One per column.
};

struct Legend {
  std::vector<std::string> columns = {};  ///< Headings of the numbers.
  std::vector<LegendRow> rows = {};
};

/// A text that belongs to an object of the map: it stands beside a small one; else over its upper
/// end, or on it where there is room enough between its middle and its upper end.
struct MapLabel {
  Eigen::Vector3d middle_in_map = Eigen::Vector3d::Zero();
  Eigen::Vector3d upper_in_map = Eigen::Vector3d::Zero();
  std::string text;
  Rgb8 color;
  Box box;  ///< Around the object.
};

struct Annotations {
  std::string title;
  std::string subtitle;
  std::vector<std::string> notes = {};  ///< A line each, under the subtitle.
  Legend legend;
  std::vector<MapLabel> labels = {};  ///< The most important first.
};

/// Layout of the page. Sizes grow with the image.
struct PagePlan {
  double scale = 1.0;  ///< 1 for 1280 x 720.
  ImageRect canvas;
  ImageRect title;
  ImageRect legend;                 ///< Empty without rows.
  ImageRect foot;                   ///< Scale bar and axes.
  ImageRect content;                ///< What remains for the scene.
  bool scene_fills_page = false;    ///< Not kept inside `content`: plates go under texts.
  std::size_t num_legend_rows = 0;  ///< As many as fit.
};

[[nodiscard]] PagePlan plan_page(const TextPainter& text,
                                 const Annotations& annotations,
                                 const SnapshotOptions& options);

/// Draws all on the image and returns it.
[[nodiscard]] ColorImage annotated(ColorImage image,
                                   const TextPainter& text,
                                   const Annotations& annotations,
                                   const PagePlan& plan,
                                   const SnapshotCamera& camera);

}  // namespace hypermap
