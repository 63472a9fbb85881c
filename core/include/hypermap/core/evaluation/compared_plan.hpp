// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which footprints of a map and of its truth belong to each other: what a picture of both shows.
#pragma once

#include "hypermap/core/evaluation/map_evaluation.hpp"
#include "hypermap/core/geometry/polygon.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hypermap {

/// What the one-to-one match makes of a footprint.
enum class ComparedFate : std::uint8_t {
  kMatched,
  kMissed,     ///< Of a truth that counts.
  kFalse,      ///< Of an object that is no true one.
  kDuplicate,  ///< Of a further object at a true one.
  kApart,      ///< Of a truth that does not count, or an object at one.
};

struct ComparedShape {
  std::uint64_t id = 0;
  std::string class_name = {};
  Polygon footprint = {};
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
  ComparedFate fate = ComparedFate::kApart;
  std::optional<std::size_t> partner = {};  ///< Index of the match in the other list.
};

/// Frame: that of the truth.
struct ComparedPlan {
  std::vector<ComparedShape> truths = {};
  std::vector<ComparedShape> objects = {};
};

/// A list of objects with their ids.
struct ComparedObjects {
  std::span<const EvaluatedObject> objects;
  std::span<const std::uint64_t> ids;
};

/// What `evaluate` said of them, of the classes that it compared.
/// Requires: an id for each object; `report` is that of these objects and options.
[[nodiscard]] ComparedPlan compared_plan(const ComparedObjects& map,
                                         const ComparedObjects& truth,
                                         const EvaluationReport& report,
                                         const EvaluationOptions& options);

/// How many of the shapes have that fate.
[[nodiscard]] std::size_t num_of(std::span<const ComparedShape> shapes, ComparedFate fate);

}  // namespace hypermap
