// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The objects of a map as lines of JSON: a head, then a line for each object, all of its state
/// but its embeddings (object_embeddings.hpp) and voted cells, then a line for each with its voted
/// cells, in the same order. What is read equals what was written bit by bit.
///
/// Lines of cells are strings of base64 (of src/objects/voted_cells_code.hpp): next to each other
/// they pack to three quarters of their letters, among the others they would cost a tenth more.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/io/codec/source_name.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace hypermap {

/// The newest version that is read, and the one that is written. Version 1 lists voted cells as
/// numbers, version 2 as two texts among an object's state; both have no lines of cells. Version 4
/// may say how often blocks of them were in view.
inline constexpr int kObjectsVersion = 4;

struct ObjectFileLimits {
  std::size_t max_objects = 1'000'000;
  std::size_t max_line_bytes = std::size_t{16} << 20;  ///< Of an object.
  std::size_t max_vertices = 100'000;                  ///< Of one polygon.
};

/// Errors: kInvalidArgument naming the object for a number that is not finite or a count beyond
/// 2^63, which `parse_objects` would refuse.
[[nodiscard]] Result<std::string> write_objects(const ObjectMap& objects);

/// Errors: kMalformedFile with line and path for a missing or unknown key, a wrong type, a value
/// that an object cannot have, a number of lines that is not the one said; kUnsupported "written by
/// a newer version N"; kLimit; kInterrupted when `budget` is told to stop; nothing is drawn of it.
/// Boundary: polygons must have rings of three points and more within 1e6 m; whether they cross
/// themselves is not checked again. Threads: reads with all cores, as write_objects writes.
[[nodiscard]] Result<ObjectMap> parse_objects(std::string_view bytes,
                                              const SourceName& source,
                                              const ObjectFileLimits& limits = {},
                                              const LoadBudget& budget = {});

}  // namespace hypermap
