// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which listed things of a recorded sequence a map has: once, in their place, of their size.
///
/// Source: docs/EVALUATION.md, "Listed things".
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/box.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hypermap {

struct OptionTable;

/// Why a listed thing counts or does not; the first reason that holds, in this order.
enum class InstanceStanding : std::uint8_t {
  kCounts,
  kNoWord,      ///< The detector has no word for it.
  kNoDepth,     ///< The sensor measures nothing there.
  kNeverWhole,  ///< Its place and size are guesses.
  kFar,         ///< Farther than 4 m from every camera.
  kRarelySeen,  ///< Named rightly in too few frames.
};

/// One word each, for output: "counts", "no word" ...
[[nodiscard]] std::string_view name_of(InstanceStanding standing);

/// A listed thing as it lies in the map.
struct ComparedInstance {
  std::vector<std::string> class_names = {};  ///< All that are right; may be empty.
  Box box = {};
  InstanceStanding standing = InstanceStanding::kCounts;
};

/// A confirmed object of the map.
struct ComparedObject {
  std::string class_name;
  Box box = {};
};

struct InstanceComparisonOptions {
  double max_distance_m = 0.25;  ///< Of centres; nearer ones are in place.
  /// A side is right when it differs from the thing's by at most this share of it.
  double max_side_share = 0.4;
  double max_chair_height_share = 0.2;  ///< The same for heights of chairs.
  double gate_m = 0.5;                  ///< Farther centres are another thing. docs/EVALUATION.md
  double small_gate_m = 0.25;           ///< The same for small things.
  double small_size_m = 0.3;            ///< Things with all sides below this are small.
  double min_box_overlap = 0.1;  ///< Intersection over union with which a wrong class stands there.
  double near_m = 0.1;           ///< An object lies on a thing that is that far from its centre.
};

/// Errors: kInvalidArgument naming the field: lengths and shares finite and >= 0, gates and sizes
/// > 0.
[[nodiscard]] Result<void> validate(const InstanceComparisonOptions& options);
[[nodiscard]] const OptionTable& option_table(const InstanceComparisonOptions& options);

/// Objects whose centre is farther from that of the thing's box are not it: half its longest
/// horizontal side, at least its gate.
[[nodiscard]] double instance_reach_m(const Box& instance,
                                      const InstanceComparisonOptions& options);

/// What the map has of one thing; indices are of the objects.
struct InstanceResult {
  std::optional<std::size_t> object = std::nullopt;  ///< Of a right class, within reach.
  double distance_m = 0.0;                           ///< Of the centres; 0 without an object.
  /// Each side of the object by that of the thing, axes of the map; 0 without an object.
  Eigen::Vector3d side_ratios = Eigen::Vector3d::Zero();
  bool is_in_place = false;
  bool is_of_right_size = false;
  std::vector<std::size_t> duplicates = {};  ///< Further objects of a right class, ascending.
  /// Objects of other classes that stand there: of a thing that counts at most one, only when it is
  /// missed.
  std::vector<std::size_t> others = {};

  [[nodiscard]] bool is_right() const {
    return object && is_in_place && is_of_right_size && duplicates.empty();
  }
};

/// Numbers of things that count, and of objects at them.
struct InstanceCounts {
  std::size_t counted = 0;
  std::size_t found = 0;        ///< With an object of a right class within reach.
  std::size_t in_place = 0;     ///< Of these.
  std::size_t right_size = 0;   ///< Of these.
  std::size_t right = 0;        ///< Once, in place and of the right size.
  std::size_t wrong_class = 0;  ///< Missed, and an object of another class stands there.
  std::size_t duplicates = 0;   ///< Objects beyond the first of a thing.
  std::size_t false_objects = 0;
};

struct InstanceComparison {
  std::vector<InstanceResult> instances = {};   ///< In the order of the things.
  std::vector<std::size_t> false_objects = {};  ///< On no listed thing, ascending.
  InstanceCounts counts = {};
};

/// Compares objects with listed things, one to one, at the least sum of distances of the centres of
/// their boxes, in this order: things that count with objects of a right class within
/// `max_distance_m`; what is left of both within reach; likewise things that do not count, within
/// reach; things that count and are still missed with objects of any class that overlap them. Of
/// the objects left, one within reach of a found thing of its class is a duplicate of the nearest,
/// one whose centre lies within `near_m` of things that do not count is at the nearest of them, all
/// others are false. Reach: `instance_reach_m`.
///
/// Boundary: distances and deviations of exactly the limit are within.
/// Requires: validate(options), boxes with positive sides. Cost: O(n^3).
[[nodiscard]] InstanceComparison compare_instances(std::span<const ComparedObject> objects,
                                                   std::span<const ComparedInstance> instances,
                                                   const InstanceComparisonOptions& options = {});

}  // namespace hypermap
