// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"
#include "edited_map.hpp"
#include "hypermap/io/archive/transformed_map.hpp"
#include "load_arguments.hpp"
#include "outputs.hpp"
#include "placement_argument.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace hypermap::app {
namespace {

struct TransformArguments {
  std::string file;
  std::optional<std::string> by;
  std::string output;
  LoadArguments load;
};

ExitCode run_transform(const TransformArguments& arguments) {
  const auto placement = placement_of(arguments.by);
  if (!placement) return report(placement.error());
  const MapFromOldMap map_from_old(isometry_of(**placement));
  const auto transform = [&](const MapArchive& old) -> Result<EditedMap> {
    auto moved = transformed(old, map_from_old);
    if (!moved) return Unexpected(of_motion(moved.error(), "--by"));
    return EditedMap{.map = std::move(*moved), .text = arguments.output + "\n"};
  };
  return run_edit(arguments.file, arguments.output, arguments.load, transform);
}

}  // namespace

void add_transform_command(CLI::App& program, Action& action) {
  auto arguments = std::make_shared<TransformArguments>();
  CLI::App& command = *program.add_subcommand("transform", "The same map seen from another origin");
  command.add_option("map", arguments->file, "archive")->required();
  command
      .add_option("--by",
                  arguments->by,
                  "X,Y,Z,YAW: where the old origin lies in the new frame, metres and degrees; +z "
                  "stays up")
      ->required()
      ->check(placement_text());
  command.add_option("--output", arguments->output, "archive to write")->required();
  arguments->load.add_to(command);
  show_examples(command, {"hypermap transform lab.hmap --by 2,0,0,90 --output moved.hmap"});
  command.callback([arguments, &action] {
    keep_suffix("--output", arguments->output, ".hmap");
    keep_apart("--output", arguments->output, {arguments->file});
    action = [arguments] { return run_transform(*arguments); };
  });
}

}  // namespace hypermap::app
