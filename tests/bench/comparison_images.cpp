// SPDX-License-Identifier: BSD-3-Clause
#include "comparison_images.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace hypermap::test {
namespace {

using Pixel = cv::Vec3b;  // blue, green, red

/// A pixel a cell, row 0 at the bottom as in maps.
template <class PixelOf>
cv::Mat image_of(const GridGeometry& geometry, const PixelOf& pixel_of) {
  cv::Mat image(geometry.rows, geometry.cols, CV_8UC3);
  for (int v = 0; v < geometry.rows; ++v) {
    for (int u = 0; u < geometry.cols; ++u) {
      image.at<Pixel>(v, u) = pixel_of(Cell{u, geometry.rows - 1 - v});
    }
  }
  return image;
}

std::uint8_t grey_level(const LogOddsGrid& grid, Cell cell) {
  return static_cast<std::uint8_t>(std::lround(255.0 * grid.log_odds(cell).probability().value()));
}

cv::Mat rgb_image(const GridStack& stack) {
  return image_of(stack.geometry(), [&](Cell cell) {
    Pixel pixel;
    int channel = 2;
    for (const auto& [name, grid] : stack.layers()) pixel[channel--] = grey_level(grid, cell);
    return pixel;
  });
}

/// Unknown, floor, table, obstacle: from dark to light.
Pixel class_pixel(std::int32_t true_class) {
  const auto level = static_cast<std::uint8_t>(true_class * 80);
  return {level, level, level};
}

cv::Mat class_image(const GridGeometry& geometry, const std::vector<std::int32_t>& classes) {
  return image_of(geometry, [&](Cell cell) { return class_pixel(classes[geometry.index(cell)]); });
}

/// A colour for each combination of yes, no and nothing, by layer.
cv::Mat code_image(const GridStack& stack) {
  return image_of(stack.geometry(), [&](Cell cell) {
    Pixel pixel;
    int channel = 2;
    for (const auto& [name, grid] : stack.layers()) {
      const int steps = grid.at(cell);
      const int level = steps == 0 ? 128 : steps > 0 ? 255 : 0;
      pixel[channel--] = static_cast<std::uint8_t>(level);
    }
    return pixel;
  });
}

/// Of each cell, the true class most frequent in its segment.
std::vector<std::int32_t> majority_classes(const CellSegmentation& segmentation,
                                           const CellSegmentation& truth) {
  std::vector<std::array<int, 4>> counts(static_cast<std::size_t>(segmentation.count));
  for (std::size_t i = 0; i < truth.labels.size(); ++i) {
    ++counts[static_cast<std::size_t>(segmentation.labels[i])]
            [static_cast<std::size_t>(truth.labels[i])];
  }
  std::vector<std::int32_t> classes;
  classes.reserve(truth.labels.size());
  for (const std::int32_t label : segmentation.labels) {
    const auto& of_label = counts[static_cast<std::size_t>(label)];
    classes.push_back(
        static_cast<std::int32_t>(std::ranges::max_element(of_label) - of_label.begin()));
  }
  return classes;
}

cv::Mat outline_image(const CellSegmentation& segmentation, const GridGeometry& geometry) {
  return image_of(geometry, [&](Cell cell) {
    const auto label = [&](int col, int row) {
      return segmentation.labels[geometry.index({col, row})];
    };
    const std::int32_t own = label(cell.col, cell.row);
    const bool is_outline = (cell.col > 0 && label(cell.col - 1, cell.row) != own) ||
                            (cell.row > 0 && label(cell.col, cell.row - 1) != own);
    return is_outline ? Pixel{0, 0, 220} : Pixel{255, 255, 255};
  });
}

cv::Mat beside_each_other(const std::vector<cv::Mat>& images) {
  std::vector<cv::Mat> framed;
  for (const cv::Mat& image : images) {
    framed.emplace_back();
    cv::copyMakeBorder(image, framed.back(), 2, 2, 2, 2, cv::BORDER_CONSTANT, {255, 255, 255});
  }
  cv::Mat row;
  cv::hconcat(framed, row);
  return row;
}

cv::Mat over_each_other(const cv::Mat& upper, const cv::Mat& lower) {
  cv::Mat both;
  cv::vconcat(upper, lower, both);
  return both;
}

void write_image(const cv::Mat& image, const std::string& path) {
  cv::imwrite(path, image, {cv::IMWRITE_PNG_COMPRESSION, 9});
}

cv::Mat half_size(const cv::Mat& image) {
  cv::Mat half;
  cv::resize(image, half, {}, 0.5, 0.5, cv::INTER_AREA);
  return half;
}

}  // namespace

void write_scenes(std::span<const TableTopScene> scenes, const std::string& path) {
  std::vector<cv::Mat> maps;
  std::vector<cv::Mat> truths;
  for (const TableTopScene& scene : scenes) {
    maps.push_back(half_size(rgb_image(scene.stack)));
    truths.push_back(half_size(class_image(scene.stack.geometry(), scene.truth.labels)));
  }
  write_image(over_each_other(beside_each_other(maps), beside_each_other(truths)), path);
}

void write_layers(const TableTopScene& scene, const std::string& path) {
  std::vector<cv::Mat> images;
  for (const auto& entry : scene.stack.layers()) {
    images.push_back(half_size(image_of(scene.stack.geometry(), [&](Cell cell) {
      const std::uint8_t level = grey_level(entry.second, cell);
      return Pixel{level, level, level};
    })));
  }
  images.push_back(half_size(rgb_image(scene.stack)));
  images.push_back(half_size(code_image(scene.stack)));
  write_image(beside_each_other(images), path);
}

void write_clusterings(const TableTopScene& scene,
                       std::span<const CellSegmentation> clusterings,
                       const std::string& path) {
  const GridGeometry& geometry = scene.stack.geometry();
  const cv::Rect middle(geometry.cols / 4, geometry.rows / 4, geometry.cols / 2, geometry.rows / 2);
  std::vector<cv::Mat> classes;
  std::vector<cv::Mat> outlines;
  for (const CellSegmentation& segmentation : clusterings) {
    classes.push_back(
        class_image(geometry, majority_classes(segmentation, scene.truth))(middle).clone());
    outlines.push_back(outline_image(segmentation, geometry)(middle).clone());
  }
  write_image(over_each_other(beside_each_other(classes), beside_each_other(outlines)), path);
}

}  // namespace hypermap::test
