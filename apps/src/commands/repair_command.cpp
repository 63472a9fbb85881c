// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"
#include "hypermap/io/jobs/repair_job.hpp"
#include "load_arguments.hpp"
#include "outputs.hpp"
#include "tables.hpp"

#include <cstdio>
#include <memory>
#include <string>

namespace hypermap::app {
namespace {

struct RepairArguments {
  std::string file;
  std::string output;
  LoadArguments load;
};

void print_notes(const RepairedArchive& repaired) {
  Table table({"part", "is", "what"}, LastColumn::kText);
  for (const RepairNote& note : repaired.notes) {
    table.add({note.subject,
               std::string(name_of(note.outcome)),
               note.what.empty() ? "-" : printable(note.what, 500)});
  }
  std::printf("%s", table.text().c_str());
}

ExitCode run_repair_command(const RepairArguments& arguments) {
  const auto repaired = run_repair(
      {.input = arguments.file, .limits = arguments.load.limits, .stop = stop_when_interrupted()});
  if (!repaired) return report(repaired.error());
  const auto saved =
      save_archive(repaired->map, arguments.output, {.limits = arguments.load.limits});
  if (!saved) return report(saved.error());
  print_notes(*repaired);
  std::printf("%s\n", arguments.output.c_str());
  return repaired->is_unchanged() ? ExitCode::kDone : ExitCode::kFindings;
}

}  // namespace

void add_repair_command(CLI::App& program, Action& action) {
  auto arguments = std::make_shared<RepairArguments>();
  CLI::App& command =
      *program.add_subcommand("repair", "What a damaged map archive still holds, as a new archive");
  command.add_option("file", arguments->file, "archive, which is only read")->required();
  command.add_option("--output", arguments->output, "archive to write")->required();
  arguments->load.add_to(command);
  show_examples(command, {"hypermap repair cut.hmap --output whole.hmap"});
  command.callback([arguments, &action] {
    keep_suffix("--output", arguments->output, ".hmap");
    keep_apart("--output", arguments->output, {arguments->file});
    action = [arguments] { return run_repair_command(*arguments); };
  });
}

}  // namespace hypermap::app
