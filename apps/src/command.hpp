// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What all commands of the program share: exit codes, how an error is reported, how a command is
/// declared.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/jobs/rank_crew.hpp"

#include <CLI/App.hpp>

#include <functional>
#include <initializer_list>
#include <span>
#include <string>

namespace hypermap::app {

/// The program's exit codes; documented in docs/CLI.md.
enum class ExitCode : int {
  kDone = 0,      ///< Done, nothing to remark.
  kFindings = 1,  ///< Done, with findings: a difference, a warning, a repair.
  kRefused = 2,   ///< Content refused, limits included.
  kSystem = 3,    ///< Input or output failed, no memory, no EGL.
  kUsage = 4,     ///< The command line is wrong.
  kInternal = 5,  ///< A fault of the program.
};

/// What the number says with which the program ends.
struct ExitStatus {
  const char* numbers;
  const char* meaning;
};

/// All of them, as docs/CLI.md lists them.
[[nodiscard]] std::span<const ExitStatus> exit_statuses();

/// The exit code of `error`.
[[nodiscard]] ExitCode exit_code_of(const Error& error);

/// The error as that of a flag, whose value the library knows by another name.
[[nodiscard]] Error of_option(Error error, const char* option);

/// Prints `hypermap: <error>` to stderr. Returns its exit code.
ExitCode report(const Error& error);

/// Prints one warning or error line to stderr. Returns kFindings or kRefused.
ExitCode report(const Finding& finding);

/// Options that every command takes.
struct CommonOptions {
  std::string progress = "auto";  ///< auto | always | never
};

/// Of a flag that takes a palette's file.
inline constexpr const char* kPaletteHelp = "YAML file with colours, class: \"#rrggbb\" a line";

/// Of a flag that takes a file of rules for relations.
inline constexpr const char* kRulesHelp =
    "YAML file with thresholds and classes of relations, as data/relations.yaml";

/// Gives the help of a command its examples, a line each.
void show_examples(CLI::App& command, std::initializer_list<const char*> lines);

/// What a parsed command does. Returned value becomes the exit code.
using Action = std::function<ExitCode()>;

/// Each adds its subcommand to `program` and, when that was chosen, stores what to do in `action`.
void add_simulate_command(CLI::App& program, const CommonOptions& common, Action& action);
void add_combine_command(CLI::App& program, const CommonOptions& common, Action& action);
void add_detect_command(CLI::App& program, const CommonOptions& common, Action& action);
void add_map_command(CLI::App& program, const CommonOptions& common, Action& action);
/// `ranks`: see CommandLine.
void add_map_many_command(CLI::App& program,
                          const CommonOptions& common,
                          MessagePort* ranks,
                          Action& action);
void add_import_command(CLI::App& program, Action& action);
void add_crop_command(CLI::App& program, Action& action);
void add_split_command(CLI::App& program, const CommonOptions& common, Action& action);
void add_transform_command(CLI::App& program, Action& action);
void add_update_command(CLI::App& program, Action& action);
void add_merge_command(CLI::App& program, const CommonOptions& common, Action& action);
void add_info_command(CLI::App& program, Action& action);
void add_classes_command(CLI::App& program, Action& action);
void add_config_command(CLI::App& program, Action& action);
void add_query_command(CLI::App& program, Action& action);
void add_shell_command(CLI::App& program, Action& action);
void add_export_command(CLI::App& program, Action& action);
void add_stack_command(CLI::App& program, const CommonOptions& common, Action& action);
void add_cells_command(CLI::App& program, const CommonOptions& common, Action& action);
void add_snapshot_command(CLI::App& program, Action& action);
void add_eval_command(CLI::App& program, Action& action);
void add_diff_command(CLI::App& program, Action& action);
void add_check_command(CLI::App& program, Action& action);
void add_repair_command(CLI::App& program, Action& action);
void add_tune_command(CLI::App& program, const CommonOptions& common, Action& action);

}  // namespace hypermap::app
