// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Questions about the objects of the 3D map.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hypermap::app {

struct QueryAnswer {
  std::uint64_t id = 0;
  std::string name;
  std::int64_t value = 0;
  std::vector<double> position;  ///< Metres, in the frame of the answer; 2 or 3 numbers.
  std::optional<double> confidence;
  std::optional<std::vector<double>> size_m = std::nullopt;  ///< Extent of the box.
};

/// Conditions that must all hold; those that are absent always do.
struct ObjectQuery {
  std::optional<std::string> name;
  std::optional<std::int64_t> id = std::nullopt;
  std::optional<std::vector<double>> at = std::nullopt;  ///< In the box; 2 numbers: at any height.
  std::optional<Polygon> area = std::nullopt;            ///< Meets the box's footprint.
};

/// Published objects in the order of their ids. Frame: Map.
[[nodiscard]] std::vector<QueryAnswer> find_objects(const MapArchive& archive,
                                                    const ObjectQuery& query);

/// The published object of a class that is nearest to a point (2 numbers: measured in the plane).
/// Errors: kNotFound when no object has this class.
[[nodiscard]] Result<std::vector<QueryAnswer>> nearest_object(const MapArchive& archive,
                                                              const std::string& class_name,
                                                              const std::vector<double>& point);

}  // namespace hypermap::app
