// SPDX-License-Identifier: BSD-3-Clause
// What layers made of cells share in their files: the geometry as keys, cells as whole numbers.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/projection/grids/grid_geometry.hpp"

#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

// Cells lie in files as they lie in memory.
static_assert(std::endian::native == std::endian::little, "members of grids are little endian");

/// Keys `resolution`, `origin` ([x, y, yaw]), `cols` and `rows`.
void append_geometry(std::vector<ValueTree::Entry>& keys, const GridGeometry& geometry);
/// Errors: kMalformedFile with the key, for what validate(GridGeometry) refuses, too.
[[nodiscard]] Result<GridGeometry> geometry_of_keys(const YamlNode& root);

/// A number under a required key.
[[nodiscard]] Result<double> number_of_key(const YamlNode& root,
                                           std::string_view key,
                                           double min,
                                           double max);
/// Texts under a required key.
[[nodiscard]] Result<std::vector<std::string>> texts_of_key(const YamlNode& root,
                                                            std::string_view key);
[[nodiscard]] ValueTree make_text_list(std::span<const std::string> texts);

template <class Int>
[[nodiscard]] std::string bytes_of_cells(std::span<const Int> cells) {
  std::string bytes(cells.size_bytes(), '\0');
  if (!cells.empty()) std::memcpy(bytes.data(), cells.data(), cells.size_bytes());
  return bytes;
}

/// Errors: kMalformedFile unless there are as many bytes as `num_cells` need.
template <class Int>
[[nodiscard]] Result<std::vector<Int>> cells_of_bytes(std::string_view bytes,
                                                      std::size_t num_cells) {
  if (bytes.size() != num_cells * sizeof(Int)) {
    return fail(ErrorCode::kMalformedFile,
                "has " + std::to_string(bytes.size()) + " bytes, its cells need " +
                    std::to_string(num_cells * sizeof(Int)));
  }
  std::vector<Int> cells(num_cells);
  if (!cells.empty()) std::memcpy(cells.data(), bytes.data(), bytes.size());
  return cells;
}

}  // namespace hypermap
