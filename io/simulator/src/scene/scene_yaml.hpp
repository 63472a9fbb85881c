// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Values of a scene file: what every part of it is made of. Errors name the node.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/simulator/scene.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {

inline constexpr std::size_t kMaxSceneObjects = 1000;  ///< Of a list, and points of a ring.

[[nodiscard]] inline Unexpected refuse(const YamlNode& node,
                                       std::string what,
                                       ErrorCode code = ErrorCode::kMalformedFile) {
  return tl::make_unexpected(node.error(std::move(what), code));
}

/// A map with none but these keys.
[[nodiscard]] Result<void> require_map(const YamlNode& node,
                                       std::span<const std::string_view> known);

/// The numbers of a list of `Size`, coordinates within 1000 m.
template <int Size>
[[nodiscard]] Result<Eigen::Matrix<double, Size, 1>> read_vector(const YamlNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<double> numbers, node.as_doubles(Size));
  Eigen::Matrix<double, Size, 1> vector(numbers.data());
  if (vector.cwiseAbs().maxCoeff() > 1000.0)
    return refuse(node, "coordinates must lie within 1000 m");
  return vector;
}

/// `usual` when the key is absent.
[[nodiscard]] Result<double> read_number(
    const YamlNode& map, std::string_view key, double usual, double min, double max);
/// 1 to 256 bytes.
[[nodiscard]] Result<std::string> read_text(const YamlNode& map, std::string_view key);
/// Empty when the key is absent.
[[nodiscard]] Result<std::vector<YamlNode>> read_list(const YamlNode& map,
                                                      std::string_view key,
                                                      std::size_t limit);
[[nodiscard]] Result<Rgb8> read_color(const YamlNode& node);
/// `color` and `pattern` of a map; what is absent stays as in `usual`.
[[nodiscard]] Result<SurfaceMaterial> read_surface(const YamlNode& map, SurfaceMaterial usual);
[[nodiscard]] Result<Ring> read_ring(const YamlNode& node);

}  // namespace hypermap
