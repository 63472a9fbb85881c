// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Images of table-top scenes and their clusterings, as [sogm] shows them: figures 9 to 11.
#pragma once

#include "hypermap/projection/supercells/segmentation_metrics.hpp"
#include "table_top_scene.hpp"

#include <span>
#include <string>

namespace hypermap::test {

/// The scenes side by side: above, their layers as one RGB image; below, the true classes.
void write_scenes(std::span<const TableTopScene> scenes, const std::string& path);

/// Each layer, all as RGB, and the classes by what each layer says: yes, no or nothing, 3^N.
void write_layers(const TableTopScene& scene, const std::string& path);

/// The middle of the scene, side by side: above, segments in the colour of the true class most
/// frequent in them; below, their outlines in red.
void write_clusterings(const TableTopScene& scene,
                       std::span<const CellSegmentation> clusterings,
                       const std::string& path);

}  // namespace hypermap::test
