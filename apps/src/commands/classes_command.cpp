// SPDX-License-Identifier: BSD-3-Clause
#include "class_names.hpp"
#include "command.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/vocabulary_file.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/codec/file_kind.hpp"
#include "load_arguments.hpp"
#include "outputs.hpp"
#include "tables.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace hypermap::app {
namespace {

using Json = nlohmann::ordered_json;

struct ClassesArguments {
  std::string file;
  ClassNames class_names;
  std::string set;
  bool clear = false;
  std::string output;
  std::string write;
  bool json = false;
  LoadArguments load;

  [[nodiscard]] bool changes_map() const { return clear || !set.empty(); }
};

/// A class that something in the map bears, and what the vocabulary says of it.
struct ClassRow {
  std::string name;
  std::string class_name;  ///< What the name means.
  std::vector<std::string> super_classes;
  std::size_t num_shapes = 0;  ///< Objects of the map's 2D layers that bear the name.
};

std::vector<ClassRow> rows_of(const MapArchive& archive) {
  std::map<std::string, std::size_t> shapes;
  for (const std::string& name : archive.classes.names()) shapes.emplace(name, 0);
  for (const Layer& layer : archive.hypermap.layers()) {
    const auto* semantic = layer.content.as<SemanticLayer>();
    if (semantic == nullptr) continue;
    for (const SemanticObject& object : semantic->objects()) {
      const auto id = archive.classes.find(object.name);
      ++shapes[id ? archive.classes.name(*id) : object.name];
    }
  }
  std::vector<ClassRow> rows;
  rows.reserve(shapes.size());
  for (const auto& [name, count] : shapes) {
    ClassRow& row = rows.emplace_back(ClassRow{.name = name,
                                               .class_name = archive.vocabulary.shown_class(name),
                                               .super_classes = {},
                                               .num_shapes = count});
    for (const std::string& above : archive.vocabulary.super_classes_of(name)) {
      row.super_classes.push_back(archive.vocabulary.shown_class(above));
    }
  }
  return rows;
}

std::string comma_list_of(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + printable(name);
  return text.empty() ? "-" : text;
}

std::string vocabulary_text(const ClassVocabulary& vocabulary) {
  if (vocabulary.empty()) return "no aliases and no super-classes";
  std::size_t num_aliases = 0;
  for (const VocabularyGroup& group : vocabulary.groups().aliases) {
    num_aliases += group.members.size();
  }
  const std::size_t num_super_classes = vocabulary.groups().super_classes.size();
  return std::to_string(num_aliases) + (num_aliases == 1 ? " alias, " : " aliases, ") +
         std::to_string(num_super_classes) +
         (num_super_classes == 1 ? " super-class" : " super-classes");
}

void print_classes(const MapArchive& archive) {
  Table table({"name", "class", "shapes", "super-classes"}, LastColumn::kText);
  for (const ClassRow& row : rows_of(archive)) {
    const bool is_alias = !is_spelling_of(row.name, row.class_name);
    table.add({printable(row.name),
               is_alias ? printable(row.class_name) : "-",
               std::to_string(row.num_shapes),
               comma_list_of(row.super_classes)});
  }
  std::printf("%s%s\n", table.text().c_str(), vocabulary_text(archive.vocabulary).c_str());
}

Json json_of_groups(const std::vector<VocabularyGroup>& groups) {
  Json json = Json::object();
  for (const VocabularyGroup& group : groups) {
    Json members = Json::array();
    for (const VocabularyName& member : group.members) members.push_back(member.text);
    json[group.name.text] = std::move(members);
  }
  return json;
}

void print_classes_json(const MapArchive& archive) {
  Json classes = Json::array();
  for (const ClassRow& row : rows_of(archive)) {
    classes.push_back({{"name", row.name},
                       {"class", row.class_name},
                       {"super_classes", row.super_classes},
                       {"shapes", row.num_shapes}});
  }
  const VocabularyGroups& groups = archive.vocabulary.groups();
  const Json document{{"classes", std::move(classes)},
                      {"aliases", json_of_groups(groups.aliases)},
                      {"super_classes", json_of_groups(groups.super_classes)}};
  std::printf("%s\n", document.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

/// Where the changed map goes. Errors: kUnsupported for a file that is no archive, in whose place
/// none may be put.
Result<std::string> target_of(const ClassesArguments& arguments) {
  if (!arguments.output.empty()) return arguments.output;
  HYPERMAP_ASSIGN_OR_RETURN(const FileKind kind, find_file_kind(arguments.file));
  if (kind == FileKind::kArchive) return arguments.file;
  return Unexpected(Error{.code = ErrorCode::kUnsupported,
                          .what = "is no archive: --output names the one to write",
                          .file = arguments.file});
}

/// The map with what was asked for, saved where it was. Errors: those of reading and saving.
Result<Loaded<MapArchive>> changed_map(const ClassesArguments& arguments) {
  ClassNames to_keep;
  to_keep.file = arguments.set;
  HYPERMAP_ASSIGN_OR_RETURN(auto vocabulary, to_keep.given());
  HYPERMAP_ASSIGN_OR_RETURN(
      auto loaded,
      load_archive(
          arguments.file, arguments.load.limits, archive_layer_types(), stop_when_interrupted()));
  if (arguments.clear) loaded.value.vocabulary = {};
  if (vocabulary) loaded.value.vocabulary = std::move(*vocabulary);
  if (arguments.changes_map()) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string target, target_of(arguments));
    HYPERMAP_TRY(save_archive(loaded.value, target, {.limits = arguments.load.limits}));
  }
  HYPERMAP_TRY(arguments.class_names.replace(loaded.value.vocabulary));
  if (!arguments.write.empty()) {
    HYPERMAP_TRY(write_file_atomically(arguments.write, write_vocabulary(loaded.value.vocabulary)));
  }
  return loaded;
}

ExitCode run_classes(const ClassesArguments& arguments) {
  const auto loaded = changed_map(arguments);
  if (!loaded) return report(loaded.error());
  arguments.json ? print_classes_json(loaded->value) : print_classes(loaded->value);
  ExitCode worst = ExitCode::kDone;
  for (const Finding& finding : loaded->findings) worst = std::max(worst, report(finding));
  return worst;
}

}  // namespace

void add_classes_command(CLI::App& program, Action& action) {
  auto arguments = std::make_shared<ClassesArguments>();
  CLI::App& command = *program.add_subcommand(
      "classes", "What the names of a map's classes mean: aliases and super-classes");
  command.add_option("file", arguments->file, "archive or configuration")->required();
  auto* set = command.add_option(
      "--set",
      arguments->set,
      "YAML file of aliases and super-classes, as data/vocabulary.yaml: the map keeps it, in "
      "place of what it kept");
  auto* clear = command.add_flag("--clear", arguments->clear, "the map keeps none")->excludes(set);
  command.add_option("--output",
                     arguments->output,
                     "with --set and --clear: archive to write (default: the file itself)");
  command.add_option("--write", arguments->write, "YAML file to write what the map keeps to");
  arguments->class_names.add_to(command);
  command.get_option("--class-names")->excludes(set)->excludes(clear);
  command.add_flag("--json", arguments->json, "one JSON document");
  arguments->load.add_to(command);
  show_examples(command,
                {"hypermap classes lab.hmap",
                 "hypermap classes lab.hmap --set data/vocabulary.yaml",
                 "hypermap classes lab.hmap --write names.yaml"});
  command.callback([arguments, &action] {
    if (!arguments->output.empty()) {
      if (!arguments->changes_map()) {
        throw CLI::ValidationError("--output", "goes with --set and --clear");
      }
      keep_apart("--output", arguments->output, {arguments->set});
      keep_suffix("--output", arguments->output, ".hmap");
    }
    keep_apart("--write",
               arguments->write,
               {arguments->file, arguments->set, arguments->class_names.file, arguments->output});
    action = [arguments] { return run_classes(*arguments); };
  });
}

}  // namespace hypermap::app
