// SPDX-License-Identifier: BSD-3-Clause
#include "choices.hpp"
#include "command.hpp"
#include "hypermap/io/archive/archive_info.hpp"
#include "hypermap/io/jobs/import_job.hpp"
#include "load_arguments.hpp"
#include "number_lists.hpp"
#include "outputs.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace hypermap::app {
namespace {

struct ImportArguments {
  std::vector<std::string> files;
  std::vector<std::string> frames;
  std::vector<std::string> transforms;
  std::string dialect = "map_server";
  std::string output;
  LoadArguments load;
};

/// "NAME=FILE" where no file is called so, else "FILE". Errors: kInvalidArgument without NAME.
Result<ImportedFile> parse_file(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || std::filesystem::exists(text)) {
    return ImportedFile{.path = text};
  }
  if (equals == 0 || equals + 1 == text.size()) {
    return fail(ErrorCode::kInvalidArgument,
                "must be FILE or NAME=FILE, is '" + printable(text) + "'",
                "files");
  }
  return ImportedFile{.path = text.substr(equals + 1), .name = text.substr(0, equals)};
}

/// The file that `FILE=FRAME` speaks of: its name, that of its layer, or its place among them.
std::vector<ImportedFile>::iterator file_called(std::vector<ImportedFile>& files,
                                                const std::string& name) {
  return std::ranges::find_if(files, [&](const ImportedFile& file) {
    return file.name == name || file.path == name || file.path.filename() == name ||
           (file.name.empty() && file.path.stem() == name);
  });
}

Result<std::vector<ImportedFile>> files_of(const ImportArguments& arguments) {
  std::vector<ImportedFile> files;
  files.reserve(arguments.files.size());
  for (const std::string& text : arguments.files) {
    HYPERMAP_ASSIGN_OR_RETURN(ImportedFile file, parse_file(text));
    files.push_back(std::move(file));
  }
  for (const std::string& text : arguments.frames) {
    const auto equals = text.rfind('=');
    const auto file = file_called(files, text.substr(0, equals));
    const std::string frame_id = equals == std::string::npos ? "" : text.substr(equals + 1);
    if (file == files.end() || frame_id.empty()) {
      return fail(
          ErrorCode::kInvalidArgument,
          "must be NAME=FRAME with the name of one of the files, is '" + printable(text) + "'",
          "--frame");
    }
    file->frame_id = frame_id;
  }
  return files;
}

/// "PARENT,CHILD,X,Y,YAW", metres and degrees.
Result<FrameTransform> parse_transform(const std::string& text) {
  const auto first = text.find(',');
  const auto second = first == std::string::npos ? first : text.find(',', first + 1);
  if (second == std::string::npos) {
    return fail(ErrorCode::kInvalidArgument,
                "must be PARENT,CHILD,X,Y,YAW, is '" + printable(text) + "'",
                "--transform");
  }
  HYPERMAP_ASSIGN_OR_RETURN(const auto numbers,
                            parse_numbers(text.substr(second + 1), 3, 3, "--transform"));
  return FrameTransform{.frame_id = text.substr(0, first),
                        .child_frame_id = text.substr(first + 1, second - first - 1),
                        .x_m = numbers[0],
                        .y_m = numbers[1],
                        .yaw_rad = numbers[2] * std::numbers::pi / 180.0};
}

Result<ImportJob> job_of(const ImportArguments& arguments) {
  ImportJob job{
      .files = {},
      .dialect = arguments.dialect == "hypermap" ? MapDialect::kHypermap : MapDialect::kMapServer,
      .limits = arguments.load.limits,
      .stop = stop_when_interrupted()};
  HYPERMAP_ASSIGN_OR_RETURN(job.files, files_of(arguments));
  for (const std::string& text : arguments.transforms) {
    HYPERMAP_ASSIGN_OR_RETURN(FrameTransform transform, parse_transform(text));
    job.transforms.push_back(std::move(transform));
  }
  return job;
}

void print_layers(const MapArchive& archive) {
  for (const LayerSummary& layer : describe(archive).layers) {
    std::printf("%s: %s in frame %s\n",
                printable(layer.name).c_str(),
                printable(layer.class_name).c_str(),
                printable(layer.frame_id).c_str());
  }
}

/// Of the job's own transforms; those of files bear the file.
bool is_of_transform(const Error& error) {
  return error.file.empty() && (error.field == "frame_id" || error.field == "child_frame_id" ||
                                error.field == "transform_pose");
}

ExitCode run_import_command(const ImportArguments& arguments, const ImportJob& job) {
  const auto imported = run_import(job);
  if (!imported) {
    const Error& error = imported.error();
    return report(is_of_transform(error) ? of_option(error, "--transform") : error);
  }
  if (const auto saved =
          save_archive(imported->value, arguments.output, {.limits = arguments.load.limits});
      !saved) {
    return report(saved.error());
  }
  print_layers(imported->value);
  std::printf("%s\n", arguments.output.c_str());
  ExitCode worst = ExitCode::kDone;
  for (const Finding& finding : imported->findings) worst = std::max(worst, report(finding));
  return worst;
}

}  // namespace

void add_import_command(CLI::App& program, Action& action) {
  auto arguments = std::make_shared<ImportArguments>();
  CLI::App& command =
      *program.add_subcommand("import", "Maps of several types and tools as one archive");
  command
      .add_option(
          "files",
          arguments->files,
          "FILE or NAME=FILE: maps of map_server, lists of named polygons, octrees, archives "
          "and bare configurations")
      ->required();
  command.add_option("--output", arguments->output, "archive to write")->required();
  command.add_option("--frame",
                     arguments->frames,
                     "NAME=FRAME: the frame in which a file's map lies (default: map); may be "
                     "repeated");
  command.add_option("--transform",
                     arguments->transforms,
                     "PARENT,CHILD,X,Y,YAW: where frame CHILD lies in frame PARENT, metres and "
                     "degrees; may be repeated");
  command.add_option("--dialect", arguments->dialect, "how maps of map_server are read")
      ->transform(one_of({"map_server", "hypermap"}))
      ->capture_default_str();
  arguments->load.add_to(command);
  show_examples(command,
                {"hypermap import floor.yaml things.yaml tree.bt --output all.hmap",
                 "hypermap import ground=a.yaml upper=b.yaml --frame upper=second --transform "
                 "map,second,3,0,90 --output house.hmap"});
  command.callback([arguments, &action] {
    keep_suffix("--output", arguments->output, ".hmap");
    auto job = job_of(*arguments);
    if (!job) throw CLI::ValidationError(job.error().field, job.error().what);
    std::vector<std::filesystem::path> inputs;
    for (const ImportedFile& file : job->files) inputs.push_back(file.path);
    keep_apart("--output", arguments->output, inputs);
    action = [arguments, job = *job] { return run_import_command(*arguments, job); };
  });
}

}  // namespace hypermap::app
