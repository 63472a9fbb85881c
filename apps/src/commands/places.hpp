// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What `query --rooms`, `--place` and `--route` say.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/places/relations.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <CLI/App.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace hypermap::app {

/// What is asked: one of the first three.
struct PlaceArguments {
  bool rooms = false;
  std::optional<std::string> place;  ///< A class of objects, in any spelling, or an id.
  std::optional<std::string> route;  ///< "FROM,TO"
  std::string rules;                 ///< File of what belongs where; empty: that of the program.
};

/// The file of what belongs where; empty: that of the program.
[[nodiscard]] std::filesystem::path places_file(const std::string& given);

void add_place_options(CLI::App& command, PlaceArguments& arguments);
/// Whether any of it is given.
[[nodiscard]] bool asks_places(const PlaceArguments& arguments);
/// What does not go together, for people. `asks_more`: whether other things are asked, too.
[[nodiscard]] std::optional<std::string> fault_of(const PlaceArguments& arguments, bool asks_more);

/// To standard output: the rooms and what is in them; or in which room objects are and, by `graph`,
/// what they stand on; or the way from one end to the other.
/// Errors: those of read_place_rules and map_places; kInvalidArgument for a route that is not
/// "FROM,TO"; kNotFound naming the flag.
[[nodiscard]] Result<void> print_places(const MapArchive& archive,
                                        const PlaceArguments& arguments,
                                        const RelationGraph& graph,
                                        bool json);

}  // namespace hypermap::app
