// SPDX-License-Identifier: BSD-3-Clause
#include "shell_commands.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/nearest_name.hpp"

#include <algorithm>
#include <limits>

namespace hypermap::app {
namespace {

constexpr std::size_t kAnyNumber = std::numeric_limits<std::size_t>::max();

using Kind = ShellWordKind;

constexpr ShellCommand kShellCommands[] = {
    {"help",
     "[COMMAND]",
     "List all commands, or say how one is typed.",
     0,
     1,
     {Kind::kCommand},
     do_help},
    {"load", "FILE", "Load a map archive from a file.", 1, 1, {Kind::kFile}, do_load},
    {"loadConfig",
     "FILE",
     "Load a configuration and the files that it names.",
     1,
     1,
     {Kind::kFile},
     do_load_config},
    {"save",
     "[FILE]",
     "Save the map as an archive, without FILE to where it came from.",
     0,
     1,
     {Kind::kFile},
     do_save},
    {"getString",
     "LAYER LOCATION",
     "The strings of a layer at a location.",
     2,
     kAnyNumber,
     {Kind::kLayer},
     do_string},
    {"getStrings",
     "LAYER AREA",
     "The strings of a layer in an area.",
     2,
     kAnyNumber,
     {Kind::kLayer},
     do_strings},
    {"getCoords",
     "LAYER STRING",
     "Where a string is on a layer.",
     2,
     kAnyNumber,
     {Kind::kLayer, Kind::kClass},
     do_coords},
    {"getCoordsArea",
     "LAYER STRING AREA",
     "Where a string is on a layer, within an area.",
     3,
     kAnyNumber,
     {Kind::kLayer, Kind::kClass},
     do_coords_area},
    {"getInt",
     "LAYER LOCATION",
     "The integers of a layer at a location: occupancies or ids.",
     2,
     kAnyNumber,
     {Kind::kLayer},
     do_int},
    {"getInts",
     "LAYER AREA",
     "The integers of a layer in an area.",
     2,
     kAnyNumber,
     {Kind::kLayer},
     do_ints},
    {"getIntCoords",
     "LAYER INTEGER",
     "Where an integer is on a layer.",
     2,
     2,
     {Kind::kLayer, Kind::kId},
     do_int_coords},
    {"getIntCoordsArea",
     "LAYER INTEGER AREA",
     "Where an integer is on a layer, within an area.",
     3,
     kAnyNumber,
     {Kind::kLayer, Kind::kId},
     do_int_coords_area},
    {"objects",
     "[STRING]",
     "The objects of the 3D map, all or those of a name.",
     0,
     kAnyNumber,
     {Kind::kClass},
     do_objects},
    {"nearest",
     "STRING LOCATION",
     "The object of a name that is nearest to a location.",
     2,
     kAnyNumber,
     {Kind::kClass},
     do_nearest},
    {"why", "ID", "Why an object is believed, or withheld.", 1, 1, {Kind::kId}, do_why},
    {"whyNot", "LOCATION", "Why no object is shown at a location.", 1, kAnyNumber, {}, do_why_not},
    {"layers", "", "List the layers with class and frame.", 0, 0, {}, do_layers},
    {"getLayerCount", "", "The number of layers of the map.", 0, 0, {}, do_layer_count},
    {"republish",
     "",
     "Show what a map server would publish: layers, topics, transforms.",
     0,
     0,
     {},
     do_republish},
    {"frame",
     "[FRAME]",
     "Give and get coordinates in a frame; without FRAME in each layer's own.",
     0,
     1,
     {Kind::kFrame},
     do_frame},
    {"history",
     "[COUNT]",
     "List the lines that were typed, or the newest of them.",
     0,
     1,
     {},
     do_history},
    {"clear", "", "Forget the map that is loaded.", 0, 0, {}, do_clear},
    {"exit", "", "End the session; so does the end of the input (Ctrl-D).", 0, 0, {}, do_exit},
};

}  // namespace

std::span<const ShellCommand> shell_commands() {
  return kShellCommands;
}

Result<const ShellCommand*> find_shell_command(std::string_view name) {
  const auto found = std::ranges::find_if(shell_commands(), [&](const ShellCommand& command) {
    return is_spelling_of(command.name, name);
  });
  if (found != shell_commands().end()) return &*found;
  std::vector<std::string_view> names;
  names.reserve(shell_commands().size());
  for (const ShellCommand& command : shell_commands()) names.push_back(command.name);
  return fail(ErrorCode::kInvalidArgument,
              "no command is named '" + printable(name) + "'" + did_you_mean(name, names) +
                  " (help lists all)");
}

std::string joined_words(const ShellArguments& words, std::size_t first) {
  std::string text;
  for (std::size_t i = first; i < words.size(); ++i) text += (i == first ? "" : " ") + words[i];
  return text;
}

}  // namespace hypermap::app
