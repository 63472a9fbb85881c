// SPDX-License-Identifier: BSD-3-Clause
#include "choices.hpp"
#include "command.hpp"
#include "dataset_arguments.hpp"
#include "hypermap/io/check/file_check.hpp"
#include "interruption.hpp"
#include "load_arguments.hpp"
#include "number_lists.hpp"

#include <CLI/Validators.hpp>

#include <cstdio>
#include <memory>
#include <optional>

namespace hypermap::app {
namespace {

struct CheckArguments {
  std::vector<std::string> files;
  std::optional<std::string> kind;
  std::optional<std::string> size;
  std::optional<std::string> description;
  bool strict = false;
  LoadArguments load;
};

/// One line for each finding and a summary, on stdout: they are the result.
ExitCode check_and_print(const std::string& file, const FileCheckOptions& options) {
  const FileCheckResult result = check_file(file, options);
  for (const Finding& finding : result.findings) {
    const bool is_error = finding.severity == Severity::kError;
    std::printf("%s: %s\n", is_error ? "error" : "warning", to_string(finding.error).c_str());
  }
  if (!result.is_refused()) {
    std::printf("%s: %s, %s\n",
                printable(file, 4096).c_str(),
                std::string(name_of(*result.kind)).c_str(),
                result.summary.c_str());
  }
  return static_cast<ExitCode>(result.exit_code());
}

}  // namespace

void add_check_command(CLI::App& program, Action& action) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App& command =
      *program.add_subcommand("check", "Check any file of a kind that is read here");
  command.add_option("files", arguments->files, "files, or folders of datasets")->required();
  command.add_option("--as", arguments->kind, "what the files are (default: found by content)")
      ->transform(one_of(file_kind_names()));
  command.add_option("--size", arguments->size, "WIDTHxHEIGHT that images must have");
  command.add_option("--dataset", arguments->description, kDescriptionHelp);
  command.add_flag("--strict", arguments->strict, "findings are errors");
  arguments->load.add_to(command);
  show_examples(command,
                {"hypermap check lab.hmap",
                 "hypermap check --as config options.yaml",
                 "hypermap check recording --dataset recording.yaml"});
  command.callback([arguments, &action] {
    FileCheckOptions options;
    options.strict = arguments->strict;
    options.limits = arguments->load.limits;
    options.stop = stop_when_interrupted();
    options.description = arguments->description;
    if (arguments->kind) options.as = file_kind(*arguments->kind).value();
    if (arguments->size) {
      const auto size = parse_sides(*arguments->size, "--size");
      if (!size) throw CLI::ValidationError("check", to_string(size.error()));
      options.size = *size;
    }
    action = [arguments, options] {
      ExitCode worst = ExitCode::kDone;
      for (const std::string& file : arguments->files) {
        if (interrupting_signal() != 0) break;
        worst = std::max(worst, check_and_print(file, options));
      }
      return worst;
    };
  });
}

}  // namespace hypermap::app
