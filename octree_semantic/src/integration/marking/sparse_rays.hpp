// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The rays that are cast where projection alone would miss voxels.
#pragma once

#include "depth_pyramid.hpp"
#include "end_points.hpp"
#include "measured_points.hpp"
#include "octree/point_f.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// Appends the ends of rays through
///
/// * a coarse grid of pixels, 9 x 7 with the border: next to the sensor the whole image looks
///   through less than a voxel, so no corner of one falls in it;
/// * the measured pixels of tiles in which few are: a corner would fall beside them.
///
/// `cells`: voxel of each pixel; pixels next to each other with the same one need one ray.
/// Throws std::bad_alloc.
void add_sparse_rays(const DepthPoints& points,
                     const DepthPyramid& pyramid,
                     const EndPoints& ends,
                     std::span<const std::uint32_t> cells,
                     std::vector<PointF>& ray_ends);

}  // namespace hypermap
