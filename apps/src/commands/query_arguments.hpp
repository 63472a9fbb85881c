// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The command line of `query`.
#pragma once

#include "approach_arguments.hpp"
#include "class_names.hpp"
#include "hypermap/core/places/relations.hpp"
#include "load_arguments.hpp"
#include "places.hpp"
#include "similar_arguments.hpp"
#include "time_arguments.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace hypermap::app {

struct QueryArguments {
  std::string file;
  std::optional<std::string> layer;
  std::optional<std::string> at;
  std::optional<std::string> area;
  std::optional<std::string> text;
  std::optional<std::int64_t> value;
  std::optional<std::string> nearest;
  ApproachArguments approach = {};
  std::string frame;
  TimeArguments time = {};
  bool json = false;
  bool complete = false;
  /// By kind: the class or the id of what others are on, in, under, beside, part of.
  std::map<RelationKind, std::string> related = {};
  std::string rules;
  ClassNames class_names;
  SimilarArguments similar = {};
  PlaceArguments places;
  std::optional<std::uint32_t> why;
  std::optional<std::string> why_not;
  LoadArguments load;
};

/// What is not given together as it must be, for people; none when all is well.
[[nodiscard]] std::optional<std::string> usage_fault(const QueryArguments& arguments);

}  // namespace hypermap::app
