// SPDX-License-Identifier: BSD-3-Clause
#include "option_flags.hpp"

namespace hypermap::app {
namespace {

std::string range_of(const std::string& name) {
  for (const OptionDescription& option : describe_options({})) {
    if (option.name != name) continue;
    return option.range + (option.unit.empty() ? "" : " " + option.unit);
  }
  return {};
}

}  // namespace

CLI::Validator value_of_option(const std::string& name) {
  const auto check = [name](const std::string& text) {
    const auto checked = check_option(name, text);
    return checked ? std::string() : checked.error().what;
  };
  return {check, range_of(name), name};
}

Result<MapOptions> with_flags(MapOptions options, std::initializer_list<OptionFlag> flags) {
  for (const OptionFlag& flag : flags) {
    if (!flag.text) continue;
    HYPERMAP_ASSIGN_OR_RETURN(options, with_option(options, flag.name, *flag.text));
  }
  return options;
}

}  // namespace hypermap::app
