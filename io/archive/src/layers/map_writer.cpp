// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_server.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/codec/pgm_image.hpp"
#include "hypermap/io/codec/png_image.hpp"

#include <algorithm>
#include <cmath>

namespace hypermap {
namespace {

/// 100 is black, 0 white, in proportion between; rounding is undone by reading, as 255 > 100.
GrayAlpha8 scale_pixel(std::int8_t occupancy) {
  if (occupancy == kUnknownCell) return {.gray = 127, .alpha = 0};
  return {.gray = static_cast<std::uint8_t>(std::lround(255.0 * (100 - occupancy) / 100.0)),
          .alpha = 255};
}

std::uint8_t trinary_pixel(std::int8_t occupancy) {
  if (occupancy == kFreeCell) return 254;
  return occupancy == kOccupiedCell ? 0 : 205;
}

std::uint8_t raw_pixel(std::int8_t occupancy) {
  return static_cast<std::uint8_t>(occupancy);  // -1 is 255
}

template <class Pixel, class PixelOf>
Image<Pixel> image_of(const OccupancyGrid& grid, const PixelOf& pixel_of) {
  const GridGeometry& geometry = grid.geometry();
  Image<Pixel> image(geometry.cols, geometry.rows);
  for (int row = 0; row < geometry.rows; ++row) {
    for (int col = 0; col < geometry.cols; ++col) {
      image.at(col, geometry.rows - 1 - row) = pixel_of(grid.at({col, row}));
    }
  }
  return image;
}

struct Thresholds {
  double occupied = 1.0;
  double free = 0.0;
  const char* mode = "scale";
};

std::string metadata_of(const OccupancyLayer& layer,
                        const std::string& image_name,
                        const Thresholds& thresholds) {
  const GridGeometry& geometry = layer.grid.geometry();
  std::vector<ValueTree::Entry> entries = {{"image", make_text(image_name)},
                                           {"resolution", make_number(geometry.resolution_m)},
                                           {"origin",
                                            make_list({make_number(geometry.origin.x()),
                                                       make_number(geometry.origin.y()),
                                                       make_number(geometry.yaw_rad)})},
                                           {"negate", make_number(0)},
                                           {"occupied_thresh", make_number(thresholds.occupied)},
                                           {"free_thresh", make_number(thresholds.free)},
                                           {"mode", make_text(thresholds.mode)}};
  entries.insert(entries.end(), layer.extra.entries.begin(), layer.extra.entries.end());
  return write_yaml(make_map(std::move(entries)));
}

/// The most occupied of the cells that a new cell meets; unknown counts more than free.
std::int8_t worst(const OccupancyGrid& grid, const Polygon& square) {
  std::int8_t most = kUnknownCell;
  bool has_unknown = false;
  bool has_any = false;
  double covered_area = 0.0;
  for_each_covered_cell(grid.geometry(), square, [&](Cell cell, double covered) {
    const std::int8_t occupancy = grid.at(cell);
    has_any = true;
    covered_area += covered;
    has_unknown = has_unknown || occupancy == kUnknownCell;
    most = std::max(most, occupancy);
  });
  constexpr double kWhole = 1.0 - 1e-6;
  const bool is_partly_outside = covered_area < kWhole;
  if (!has_any || (most == kFreeCell && (has_unknown || is_partly_outside))) return kUnknownCell;
  return most;
}

}  // namespace

Result<MapFiles> write_scale_map(const OccupancyLayer& layer, const std::string& image_name) {
  HYPERMAP_ASSIGN_OR_RETURN(std::string image,
                            encode_png(image_of<GrayAlpha8>(layer.grid, scale_pixel)));
  return MapFiles{metadata_of(layer, image_name, {}), std::move(image)};
}

Result<MapFiles> write_trinary_map(const OccupancyLayer& layer, const std::string& image_name) {
  HYPERMAP_ASSIGN_OR_RETURN(std::string image,
                            encode_pgm(image_of<std::uint8_t>(layer.grid, trinary_pixel)));
  return MapFiles{metadata_of(layer, image_name, {0.65, 0.196, "trinary"}), std::move(image)};
}

Result<MapFiles> write_raw_map(const OccupancyLayer& layer, const std::string& image_name) {
  HYPERMAP_ASSIGN_OR_RETURN(std::string image,
                            encode_pgm(image_of<std::uint8_t>(layer.grid, raw_pixel)));
  return MapFiles{metadata_of(layer, image_name, {0.65, 0.196, "raw"}), std::move(image)};
}

Result<OccupancyGrid> without_rotation(const OccupancyGrid& grid) {
  const GridGeometry& turned = grid.geometry();
  if (turned.yaw_rad == 0.0) return grid;
  const Rect area = bounds(turned);
  const double edge = turned.resolution_m;
  // A sliver from rounding sines does not make another row.
  const Eigen::Vector2d size = ((area.max - area.min) / edge).array() - 1e-6;
  if (!(size.maxCoeff() < 1e6)) return fail(ErrorCode::kLimit, "the grid is too wide", "size");
  const GridGeometry straight{.resolution_m = edge,
                              .origin = area.min,
                              .cols = static_cast<int>(std::ceil(size.x())),
                              .rows = static_cast<int>(std::ceil(size.y()))};
  HYPERMAP_ASSIGN_OR_RETURN(OccupancyGrid out, OccupancyGrid::create(straight));
  for (int row = 0; row < straight.rows; ++row) {
    for (int col = 0; col < straight.cols; ++col) {
      const Eigen::Vector2d low =
          from_cells(straight, {static_cast<double>(col), static_cast<double>(row)});
      const Polygon square{.outer = {low,
                                     low + Eigen::Vector2d(edge, 0),
                                     low + Eigen::Vector2d(edge, edge),
                                     low + Eigen::Vector2d(0, edge)},
                           .holes = {}};
      out.set({col, row}, worst(grid, square));
    }
  }
  return out;
}

}  // namespace hypermap
