// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"
#include "hypermap/core/objects/publication.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/projection/layers/hypermap_query.hpp"
#include "number_lists.hpp"
#include "object_query.hpp"
#include "tables.hpp"

#include <CLI/Validators.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hypermap::app {
namespace {

using Json = nlohmann::ordered_json;

struct QueryArguments {
  std::string file;
  std::optional<std::string> layer;
  std::optional<std::string> at;
  std::optional<std::string> area;
  std::optional<std::string> text;
  std::optional<std::int64_t> value;
  std::optional<std::string> nearest;
  std::string frame;
  bool json = false;
};

/// The arguments with their numbers read.
struct Question {
  QueryArguments arguments;
  std::vector<double> at;  ///< 2 numbers; 3 only of objects. Empty when no point was given.
  std::optional<Polygon> area;
};

/// What was found, in the frame that was asked for.
struct Answers {
  std::string frame;
  std::vector<QueryAnswer> found;
};

std::vector<QueryAnswer> as_answers(const std::vector<LayerAnswer>& found) {
  std::vector<QueryAnswer> answers;
  answers.reserve(found.size());
  for (const LayerAnswer& one : found) {
    answers.push_back({.id = one.id,
                       .name = one.name,
                       .value = one.value,
                       .position = {one.position.x(), one.position.y()},
                       .confidence = one.confidence});
  }
  return answers;
}

Result<std::optional<Polygon>> area_of(const QueryArguments& arguments) {
  if (!arguments.area) return std::optional<Polygon>();
  HYPERMAP_ASSIGN_OR_RETURN(auto ring, parse_points(*arguments.area, "--area"));
  auto polygon = make_polygon(std::move(ring));
  if (!polygon) return fail(polygon.error().code, polygon.error().what, "--area");
  return std::optional<Polygon>(std::move(*polygon));
}

bool is_about_objects(const QueryArguments& arguments) {
  return arguments.nearest || *arguments.layer == "objects";
}

Result<Question> question_of(QueryArguments arguments) {
  Question question;
  if (arguments.at) {
    const std::size_t most = is_about_objects(arguments) ? 3 : 2;
    HYPERMAP_ASSIGN_OR_RETURN(question.at, parse_numbers(*arguments.at, 2, most, "--at"));
  }
  HYPERMAP_ASSIGN_OR_RETURN(question.area, area_of(arguments));
  question.arguments = std::move(arguments);
  return question;
}

Result<Answers> ask_layer(const MapArchive& archive, const Question& question) {
  const QueryArguments& arguments = question.arguments;
  HYPERMAP_ASSIGN_OR_RETURN(const Layer* layer, archive.hypermap.at(*arguments.layer));
  const QueryScope scope{*arguments.layer, arguments.frame};
  Answers answers{.frame = arguments.frame.empty() ? layer->info.frame_id : arguments.frame,
                  .found = {}};
  Result<std::vector<LayerAnswer>> found;
  if (arguments.text) {
    found = query_string(archive.hypermap, scope, *arguments.text, question.area);
  } else if (arguments.value) {
    found = query_int(archive.hypermap, scope, *arguments.value, question.area);
  } else if (question.area) {
    found = query_area(archive.hypermap, scope, *question.area);
  } else {
    found = query_at(archive.hypermap, scope, {question.at[0], question.at[1]});
  }
  if (!found) return Unexpected(std::move(found).error());
  answers.found = as_answers(*found);
  return answers;
}

Answers ask_objects(const MapArchive& archive, const Question& question) {
  ObjectQuery query{.name = question.arguments.text, .area = question.area};
  if (!question.at.empty()) query.at = question.at;
  if (question.arguments.value) query.id = *question.arguments.value;
  return Answers{.frame = "map", .found = find_objects(archive, query)};
}

Result<Answers> ask(const MapArchive& archive, const Question& question) {
  if (!is_about_objects(question.arguments)) return ask_layer(archive, question);
  if (!question.arguments.nearest) return ask_objects(archive, question);
  HYPERMAP_ASSIGN_OR_RETURN(auto found,
                            nearest_object(archive, *question.arguments.nearest, question.at));
  return Answers{.frame = "map", .found = std::move(found)};
}

void print_json(const Answers& answers) {
  Json json{{"frame", answers.frame}, {"results", Json::array()}};
  for (const QueryAnswer& one : answers.found) {
    Json entry{{"id", one.id},
               {"name", one.name},
               {"value", one.value},
               {"position", one.position},
               {"confidence", one.confidence ? Json(*one.confidence) : Json(nullptr)}};
    if (one.size_m) entry["size_m"] = *one.size_m;
    json["results"].push_back(std::move(entry));
  }
  std::printf("%s\n", json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

std::string joined(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : " ") + fixed(number, 3);
  return text;
}

void print_table(const Answers& answers) {
  Table table({"name",
               "id",
               "value",
               "position (" + printable(answers.frame) + ")",
               "confidence",
               "size m"});
  for (const QueryAnswer& one : answers.found) {
    table.add({printable(one.name),
               std::to_string(one.id),
               std::to_string(one.value),
               joined(one.position),
               fixed(one.confidence, 2),
               one.size_m ? joined(*one.size_m) : "-"});
  }
  std::printf("%s%zu found\n", table.text().c_str(), answers.found.size());
}

/// What must be given together; the texts are for people.
std::optional<std::string> usage_fault(const QueryArguments& arguments) {
  if (arguments.nearest) {
    if (!arguments.at) return "--nearest needs --at X,Y";
    if (arguments.layer.value_or("objects") != "objects") {
      return "--nearest asks the objects of the 3D map, not --layer " + *arguments.layer;
    }
    return std::nullopt;
  }
  if (!arguments.layer) return "one of --layer and --nearest is needed";
  const bool asked = arguments.at || arguments.area || arguments.text || arguments.value;
  if (!asked && *arguments.layer != "objects") {
    return "--layer needs one of --at, --area, --string and --int";
  }
  if (*arguments.layer == "objects") return std::nullopt;
  if (arguments.at && (arguments.area || arguments.text || arguments.value)) {
    return "--at goes alone on a 2D layer; --area may go with --string or --int";
  }
  if (arguments.text && arguments.value) return "--string and --int exclude each other";
  return std::nullopt;
}

ExitCode run(const Question& question) {
  const auto loaded = load_archive(question.arguments.file);
  if (!loaded) return report(loaded.error());
  auto answers = ask(loaded->value, question);
  if (!answers) return report(with_source(answers.error(), {question.arguments.file}));
  if (question.arguments.json) {
    print_json(*answers);
  } else {
    print_table(*answers);
  }
  return ExitCode::kDone;
}

}  // namespace

void add_query_command(CLI::App& program, Action& action) {
  auto arguments = std::make_shared<QueryArguments>();
  CLI::App& command = *program.add_subcommand("query", "What is where in a map, and where is what");
  command.add_option("file", arguments->file, "archive or configuration")->required();
  command.add_option("--layer", arguments->layer, "a 2D layer, or objects for those of the 3D map");
  command.add_option("--at", arguments->at, "point X,Y; with objects also X,Y,Z");
  command.add_option("--area", arguments->area, "polygon \"x y,x y,x y,...\"");
  command.add_option("--string", arguments->text, "things of this name; Free, Occupied, Unknown");
  command.add_option("--int", arguments->value, "things of this number: occupancy, or id");
  command.add_option("--nearest", arguments->nearest, "the object of this class nearest to --at");
  command.add_option(
      "--frame", arguments->frame, "frame of points and areas (default: the layer's)");
  command.add_flag("--json", arguments->json, "one JSON document");
  command.callback([arguments, &action] {
    if (const auto fault = usage_fault(*arguments)) throw CLI::ValidationError("query", *fault);
    const auto question = question_of(*arguments);
    if (!question) throw CLI::ValidationError("query", to_string(question.error()));
    action = [question = *question] { return run(question); };
  });
}

}  // namespace hypermap::app
