// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Supercells and their graph in the forms that others read: an image, Graphviz' DOT, GeoJSON.
#pragma once

#include "hypermap/core/base/class_palette.hpp"
#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/supercells/supercells.hpp"
#include "hypermap/projection/supercells/topometric_graph.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace hypermap {

/// Each supercell in the colour of the class whose layer says most (`best_layer`; the class is the
/// last part of the layer's name): light grey where all layers that know it say no, grey where none
/// does. Outlines are darker. Row 0 is the largest y; a cell is a square of as many pixels as make
/// the longer side about 512.
/// Requires: `graph` is that of `supercells`.
[[nodiscard]] ColorImage supercell_image(const Supercells& supercells,
                                         const TopometricGraph& graph,
                                         const ClassPalette& palette = {});

/// An undirected graph in Graphviz' language: nodes at their centroids, labelled with their number
/// and the class of their best layer, edges with the distance between centroids.
///
/// `pos` is in points, as `neato -n2` takes it, and `inputscale=72` tells so to `neato` without it;
/// `points_per_m` of the graph is chosen so that neighbours lie about 3/4 inch apart in the mean.
/// `centroid_m` and `length_m` are in metres of the graph's frame.
[[nodiscard]] std::string topometric_dot(const TopometricGraph& graph);

/// A point for each supercell with its cells, neighbours, and log-odds, mean and probability of
/// each layer, then a line for each pair that touches, with its length. Unit: metre of the graph's
/// frame.
[[nodiscard]] std::string topometric_geojson(const TopometricGraph& graph);

/// `supercells.png`, `topometric.dot` and `topometric.local.geojson` in a folder, each replaced
/// atomically. Requires: as supercell_image. Errors: kIo; kLimit for an image that is too large.
[[nodiscard]] Result<std::vector<std::filesystem::path>> write_supercells(
    const Supercells& supercells,
    const TopometricGraph& graph,
    const std::filesystem::path& folder,
    const ClassPalette& palette = {});

}  // namespace hypermap
