// SPDX-License-Identifier: BSD-3-Clause
#include "command_line.hpp"

#include "choices.hpp"
#include "version.hpp"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <string>

namespace hypermap::app {

CommandLine::CommandLine(MessagePort* ranks)
    : program("Semantic volumetric maps from posed RGB-D frames and detections") {
  program.name("hypermap");
  program.set_version_flag("--version", std::string("hypermap ") + kVersion);
  program.require_subcommand(1);
  program.ignore_case();
  program.option_defaults()->ignore_case();
  program.fallthrough();
  program.add_option("--progress", common.progress, "when to show progress on stderr")
      ->transform(one_of({"auto", "always", "never"}))
      ->capture_default_str();

  add_simulate_command(program, common, action);
  add_detect_command(program, common, action);
  add_combine_command(program, common, action);
  add_map_command(program, common, action);
  add_map_many_command(program, common, ranks, action);
  add_import_command(program, action);
  add_crop_command(program, action);
  add_split_command(program, common, action);
  add_transform_command(program, action);
  add_update_command(program, action);
  add_merge_command(program, common, action);
  add_info_command(program, action);
  add_classes_command(program, action);
  add_config_command(program, action);
  add_query_command(program, action);
  add_shell_command(program, action);
  add_export_command(program, action);
  add_stack_command(program, common, action);
  add_cells_command(program, common, action);
  add_snapshot_command(program, action);
  add_eval_command(program, action);
  add_diff_command(program, action);
  add_tune_command(program, common, action);
  add_check_command(program, action);
  add_repair_command(program, action);
}

}  // namespace hypermap::app
