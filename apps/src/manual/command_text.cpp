// SPDX-License-Identifier: BSD-3-Clause
#include "manual/command_text.hpp"

#include "choices.hpp"

#include <CLI/StringTools.hpp>

#include <algorithm>
#include <set>
#include <string_view>

namespace hypermap::app {
namespace {

/// CLI11 keeps them by their addresses.
std::vector<std::string> names_of(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  names.reserve(options.size());
  for (const CLI::Option* option : options) names.push_back("--" + option->get_single_name());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> written_names(const CLI::Option& option) {
  if (option.get_positional()) return {option.get_single_name()};
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

OptionText describe_option(const CLI::Option& option) {
  OptionText text;
  text.names = written_names(option);
  text.effect = option.get_description();
  text.group = option.get_group();
  text.needs = names_of(option.get_needs());
  text.excludes = names_of(option.get_excludes());
  text.is_required = option.get_required();
  if (option.get_items_expected_max() == 0) return text;
  // "UINT:at least 0": the type, then what the checks say.
  const std::string type = option.get_type_name();
  const std::size_t colon = std::min(type.find(':'), type.size());
  text.value = type.substr(0, colon);
  text.choices = choices_of(option);
  if (text.choices.empty() && colon < type.size()) text.range = type.substr(colon + 1);
  text.default_value = option.get_default_str();
  text.may_be_repeated = option.get_items_expected_max() > 1;
  return text;
}

/// The indented lines of what show_examples says.
std::vector<std::string> examples_in(const std::string& footer) {
  std::vector<std::string> examples;
  for (const std::string& line : CLI::detail::split(footer, '\n')) {
    if (line.starts_with("  ")) examples.push_back(line.substr(2));
  }
  return examples;
}

CommandText describe_command(const CLI::App& app, const std::string& name) {
  CommandText text{.name = name,
                   .summary = app.get_description(),
                   .positionals = {},
                   .options = {},
                   .examples = examples_in(app.get_footer()),
                   .commands = {}};
  for (const CLI::Option* option : app.get_options()) {
    auto& list = option->get_positional() ? text.positionals : text.options;
    list.push_back(describe_option(*option));
  }
  for (const CLI::App* command : app.get_subcommands({})) {
    text.commands.push_back(describe_command(*command, name + " " + command->get_name()));
  }
  return text;
}

}  // namespace

std::string CommandText::last_name() const {
  return name.substr(name.rfind(' ') + 1);
}

CommandText describe(const CLI::App& program) {
  return describe_command(program, program.get_name());
}

}  // namespace hypermap::app
