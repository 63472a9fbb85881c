// SPDX-License-Identifier: BSD-3-Clause
#include "choices.hpp"
#include "command.hpp"
#include "hypermap/core/base/preset_name.hpp"
#include "hypermap/io/options/options_file.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace hypermap::app {
namespace {

using Json = nlohmann::ordered_json;

struct ConfigArguments {
  std::string preset = "default";
  std::string file;
  bool json = false;
};

void print_json(const MapOptions& options) {
  Json list = Json::array();
  for (const OptionDescription& option : describe_options(options)) {
    list.push_back({{"name", option.name},
                    {"value", option.value},
                    {"unit", option.unit},
                    {"range", option.range},
                    {"source", option.source},
                    {"effect", option.effect}});
  }
  std::printf("%s\n", list.dump(2).c_str());
}

ExitCode run(const ConfigArguments& arguments) {
  MapOptions options;
  options.mapper.objects = preset(*preset_of(arguments.preset));
  if (!arguments.file.empty()) {
    auto read = read_options(arguments.file, options);
    if (!read) return report(read.error());
    options = std::move(*read);
  }
  if (arguments.json) {
    print_json(options);
  } else {
    std::printf("%s", write_options(options).c_str());
  }
  return ExitCode::kDone;
}

}  // namespace

void add_config_command(CLI::App& program, Action& action) {
  auto arguments = std::make_shared<ConfigArguments>();
  CLI::App& command = *program.add_subcommand(
      "config", "Every option as a file for --config: value, unit, range, source, effect");
  command.add_option("--preset", arguments->preset, "whose values")
      ->transform(one_of(preset_names()))
      ->capture_default_str();
  command.add_option("--config", arguments->file, "an options file to complete");
  command.add_flag("--json", arguments->json, "one JSON document");
  show_examples(command, {"hypermap config --preset smap"});
  command.callback([arguments, &action] { action = [arguments] { return run(*arguments); }; });
}

}  // namespace hypermap::app
