// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What there is to know of the program's command line, as text: for whatever is written from it.
#pragma once

#include <CLI/App.hpp>

#include <string>
#include <vector>

namespace hypermap::app {

/// An option, a flag or a positional argument.
struct OptionText {
  std::vector<std::string> names;    ///< "-h", "--help"; of a positional argument its one name.
  std::string value;                 ///< "TEXT", "UINT"; empty for a flag.
  std::string range;                 ///< "at least 0", "0 .. 3600 s"; empty for a choice.
  std::vector<std::string> choices;  ///< Empty unless it takes one of some names.
  std::string default_value;         ///< Empty when there is none.
  std::string effect;
  std::string group;  ///< "Options", or the heading under which `--help` has it.
  std::vector<std::string> needs;
  std::vector<std::string> excludes;
  bool is_required = false;
  bool may_be_repeated = false;
};

struct CommandText {
  std::string name;     ///< "hypermap map"
  std::string summary;  ///< One line, without a full stop.
  std::vector<OptionText> positionals;
  std::vector<OptionText> options;
  std::vector<std::string> examples;
  std::vector<CommandText> commands;

  /// "map" of "hypermap map".
  [[nodiscard]] std::string last_name() const;
};

/// All lists are in the order of the definitions, names that an option needs or excludes in that of
/// letters, so the same command line gives the same text.
[[nodiscard]] CommandText describe(const CLI::App& program);

}  // namespace hypermap::app
