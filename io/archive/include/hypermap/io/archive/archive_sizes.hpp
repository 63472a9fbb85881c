// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What each part of a map costs in its archive.
///
/// Source: [smap] 5.4, figure 5.10 (the map against grids of it).
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

/// A layer or an extension with all its members.
struct PartSize {
  std::string name = {};  ///< As in the configuration.
  std::string kind = {};  ///< Its class or format; empty of what no part names.
  std::uint64_t num_bytes = 0;
  std::uint64_t num_packed_bytes = 0;
  friend bool operator==(const PartSize&, const PartSize&) = default;
};

/// One key of the objects' lines, or "cells", their lines of voted cells; of all objects together.
struct ObjectFieldSize {
  std::string key = {};
  std::uint64_t num_bytes = 0;
  std::uint64_t num_packed_bytes = 0;  ///< Packed by itself.
  friend bool operator==(const ObjectFieldSize&, const ObjectFieldSize&) = default;
};

/// An object that takes more, packed by itself, is large.
inline constexpr std::uint64_t kLargeObjectBytes = 4096;

/// What the tracked objects cost, the tentative ones too. Unit: byte, packed.
struct ObjectSizes {
  std::size_t num_objects = 0;
  double mean = 0.0;               ///< The member's packed size by the number of objects.
  std::uint64_t median_alone = 0;  ///< Of objects that are packed one by one.
  std::uint64_t largest_alone = 0;
  ObjectId largest = {};
  std::size_t num_large = 0;                 ///< Of those packed one by one.
  std::vector<ObjectFieldSize> fields = {};  ///< The dearest first.
};

/// The same map as grids of a byte a cell, one for each class that an object is of, plane and
/// space, as [smap] 5.4 compares them.
struct GridSizes {
  std::size_t num_classes = 0;
  double cell_edge_m = 0.0;
  std::uint64_t flat_bytes = 0;
  std::uint64_t volume_bytes = 0;  ///< The plane's by the cells in the height of the map.
};

struct ArchiveSizes {
  std::uint64_t num_bytes = 0;              ///< The archive itself.
  std::vector<PartSize> parts = {};         ///< The dearest first, by packed size.
  std::optional<ObjectSizes> objects = {};  ///< None without any.
  std::optional<GridSizes> as_grids = {};   ///< None without an occupancy grid.
};

/// Of the archive as it would be saved now. Errors: those of write_archive.
/// Cost: that of writing the archive, and of packing its objects twice more.
[[nodiscard]] Result<ArchiveSizes> archive_sizes(const MapArchive& archive);

/// One JSON document: `bytes`, `parts` [{`name`, `kind`, `bytes`, `packed_bytes`}], `objects`
/// {`count`, `mean_packed_bytes`, `median_alone`, `largest_alone`, `largest`, `num_large`, `fields`
/// [{`key`, `bytes`, `packed_bytes`}]} or null, `as_grids` {`classes`, `cell_edge_m`, `flat_bytes`,
/// `volume_bytes`} or null.
[[nodiscard]] std::string to_json(const ArchiveSizes& sizes);

}  // namespace hypermap
