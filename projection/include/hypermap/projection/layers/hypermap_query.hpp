// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What is where in a hypermap: by place, by text, by number, and combined, in any frame.
///
/// Source: [hypermap] 3.3.1 (spatial and keyword queries), 3.3.2 (points and polygons are taken to
/// the layer's frame), 3.3.3 (string and integer representations), table 2.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/projection/layers/frame_tree.hpp"
#include "hypermap/projection/layers/hypermap.hpp"
#include "hypermap/projection/layers/layer_query.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// Where a query looks and in which frame it speaks.
struct QueryScope {
  std::string layer;
  std::string frame_id = {};  ///< Of points and areas, in and out; empty: the layer's own.
};

/// Everything below: answers in ascending id. Errors: kNotFound when the layer is unknown or
/// nothing connects the frames; kUnsupported when the layer is opaque; kInvalidArgument when a
/// coordinate is not finite. An empty list is a normal answer, also for a point outside the grid.
///
/// Area queries take the objects that meet the area (touching included), and the cells whose
/// interior it meets. Heights are the same in all frames.

/// Asks one layer, which may be in no hypermap, with points and areas in the frame `frame_id`
/// (empty: the layer's own), to which `frames` leads; answers come in it too.
[[nodiscard]] Result<std::vector<LayerAnswer>> query_layer(const Layer& layer,
                                                           const FrameTree& frames,
                                                           std::string_view frame_id,
                                                           const LayerQuery& query);

/// getString: what is at a point. Source: [hypermap] table 2, F10, F11.
[[nodiscard]] Result<std::vector<LayerAnswer>> query_at(const Hypermap& map,
                                                        const QueryScope& scope,
                                                        const Eigen::Vector2d& point);
/// getStrings: what is in an area. Source: [hypermap] table 2, 3.3.1.
[[nodiscard]] Result<std::vector<LayerAnswer>> query_area(const Hypermap& map,
                                                          const QueryScope& scope,
                                                          const Polygon& area);
/// getCoords, getCoordsArea: where a text is, on the whole layer or in an area.
/// Source: [hypermap] table 2, F12.
[[nodiscard]] Result<std::vector<LayerAnswer>> query_string(
    const Hypermap& map,
    const QueryScope& scope,
    std::string_view text,
    const std::optional<Polygon>& area = std::nullopt);
/// The same by integer representation. Source: [hypermap] F13.
[[nodiscard]] Result<std::vector<LayerAnswer>> query_int(
    const Hypermap& map,
    const QueryScope& scope,
    std::int64_t value,
    const std::optional<Polygon>& area = std::nullopt);

/// The part of an occupancy layer that lies in an area of the frame `frame_id` (empty: the layer's
/// own): the cells that an area query takes (sub_map of cropped_grid.hpp), in the layer's frame.
/// Errors: as above; kUnsupported for a layer of another class; kNotFound when the area meets no
/// cell.
[[nodiscard]] Result<OccupancyLayer> sub_map(const Layer& layer,
                                             const FrameTree& frames,
                                             std::string_view frame_id,
                                             const Polygon& area);

/// The names of `answers` in order, each once: what getStrings lists.
[[nodiscard]] std::vector<std::string> distinct_names(const std::vector<LayerAnswer>& answers);

}  // namespace hypermap
