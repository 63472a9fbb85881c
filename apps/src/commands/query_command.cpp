// SPDX-License-Identifier: BSD-3-Clause
// Long because: the flags of one command, and which of them go together, are read side by side.
#include "asked_tiles.hpp"
#include "command.hpp"
#include "completeness.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/archive/map_query.hpp"
#include "hypermap/io/archive/nearest_routes.hpp"
#include "hypermap/io/archive/object_relations.hpp"
#include "hypermap/io/archive/related_query.hpp"
#include "hypermap/io/jobs/tile_set.hpp"
#include "hypermap/io/options/relation_rules_file.hpp"
#include "nearest_text.hpp"
#include "number_lists.hpp"
#include "past_text.hpp"
#include "places.hpp"
#include "query_arguments.hpp"
#include "query_hints.hpp"
#include "query_text.hpp"
#include "why.hpp"

#include <CLI/Validators.hpp>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace hypermap::app {
namespace {

/// "--on", "--part-of".
std::string flag_of(RelationKind kind) {
  return kind == RelationKind::kPartOf ? "--part-of" : "--" + std::string(name_of(kind));
}

/// The arguments as the library takes them.
struct QueryRequest {
  QueryArguments arguments;
  MapQuery query;
  std::optional<PlanPoint> why_not = std::nullopt;
  std::optional<SimilarTo> similar_to = std::nullopt;
  AskedTime time = {};
};

Result<std::optional<Polygon>> area_of(const QueryArguments& arguments) {
  if (!arguments.area) return std::optional<Polygon>();
  HYPERMAP_ASSIGN_OR_RETURN(auto ring, parse_points(*arguments.area, "--area"));
  auto polygon = make_polygon(std::move(ring));
  if (!polygon) return fail(polygon.error().code, polygon.error().what, "--area");
  return std::optional<Polygon>(std::move(*polygon));
}

Result<std::optional<PlanPoint>> point_of(const std::optional<std::string>& text,
                                          const std::string& option) {
  if (!text) return std::optional<PlanPoint>();
  HYPERMAP_ASSIGN_OR_RETURN(const auto numbers, parse_numbers(*text, 2, 3, option));
  PlanPoint point{.xy = {numbers[0], numbers[1]}};
  if (numbers.size() > 2) point.z = numbers[2];
  return std::optional(point);
}

Result<QueryRequest> request_of(QueryArguments arguments) {
  QueryRequest request;
  MapQuery& query = request.query;
  query.layer = arguments.layer.value_or(std::string(kObjectsLayer));
  query.text = arguments.nearest ? arguments.nearest : arguments.text;
  query.value = arguments.value;
  HYPERMAP_ASSIGN_OR_RETURN(query.at, point_of(arguments.at, "--at"));
  HYPERMAP_ASSIGN_OR_RETURN(request.why_not, point_of(arguments.why_not, "--why-not"));
  HYPERMAP_ASSIGN_OR_RETURN(query.area, area_of(arguments));
  query.frame_id = arguments.frame;
  HYPERMAP_ASSIGN_OR_RETURN(request.time, arguments.time.time());
  request.arguments = std::move(arguments);
  return request;
}

Result<MapAnswers> run_query(const MapArchive& archive,
                             const RelationGraph& graph,
                             const QueryRequest& request) {
  if (request.similar_to) return query_similar(archive, *request.similar_to, request.query);
  if (!request.arguments.related.empty()) {
    auto answers = query_related(archive, graph, request.arguments.related, request.query);
    for (const RelationKind kind : kRelationKinds) {
      if (!answers && answers.error().field == key_of(kind)) answers.error().field = flag_of(kind);
    }
    return answers;
  }
  if (!request.arguments.nearest) return query_map(archive, request.query);
  auto answers = query_nearest(archive, request.query, request.arguments.similar.top.value_or(1));
  if (!answers && answers.error().field.empty()) answers.error().field = "--nearest";
  return answers;
}

/// For an option that names an object by its number.
CLI::Validator id_of_object() {
  const auto check = [](const std::string& text) -> std::string {
    std::uint32_t id = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
    const bool is_whole = error == std::errc() && end == text.data() + text.size();
    if (is_whole && id > 0) return "";
    return "must be the id of an object, a whole number in 1 .. " +
           std::to_string(std::numeric_limits<std::uint32_t>::max()) + ", is '" + printable(text) +
           "'";
  };
  return {check, "1 .. 4294967295"};
}

/// A question that the layer cannot be asked is a wrong command line.
ExitCode report_refusal(Error error, const QueryArguments& arguments) {
  if (error.field == "frame_id") error.field = "--frame";
  if (error.code != ErrorCode::kInvalidArgument) {
    return report(with_source(error, {arguments.file}));
  }
  const std::string option = error.field.empty() ? "" : "--" + error.field + " ";
  std::fprintf(stderr, "query: %s%s\n", option.c_str(), error.what.c_str());
  return ExitCode::kUsage;
}

/// What objects are to each other, by the rules of the file when one was given; none of other
/// layers.
Result<RelationGraph> relations_for(const PartialMap& partial, const QueryRequest& request) {
  if (request.query.layer != kObjectsLayer) return RelationGraph{};
  RelationOptions options;
  if (!request.arguments.rules.empty()) {
    HYPERMAP_ASSIGN_OR_RETURN(options, read_relation_options(request.arguments.rules));
  }
  if (!options.voxel_m) options.voxel_m = partial.octree_resolution_m;
  return archive_relations(partial.map, options);
}

ExitCode tell_why(const MapArchive& archive, const QueryRequest& request) {
  const QueryArguments& arguments = request.arguments;
  const auto printed = arguments.why ? print_why(archive, ObjectId{*arguments.why}, arguments.json)
                                     : print_why_not(archive, *request.why_not, arguments.json);
  return printed ? ExitCode::kDone : report_refusal(printed.error(), arguments);
}

/// Why an object was shown at a moment, or not.
ExitCode tell_why_then(const MapArchive& archive,
                       const QueryRequest& request,
                       const ShownPast& past) {
  const QueryArguments& arguments = request.arguments;
  const ObjectId id{*arguments.why};
  const auto known = check_known_then(past, archive, id);
  if (!known) return report_refusal(known.error(), arguments);
  if (!arguments.json) std::printf("%s:\n", text_of(past.asked).c_str());
  const auto printed = print_why(past.past.map, id, arguments.json);
  return printed ? ExitCode::kDone : report_refusal(printed.error(), arguments);
}

ExitCode tell_places(const PartialMap& partial, const QueryRequest& request) {
  const MapArchive& archive = partial.map;
  const auto graph = relations_for(partial, request);
  if (!graph) return report(graph.error());
  const QueryArguments& arguments = request.arguments;
  const auto printed = print_places(archive, arguments.places, *graph, arguments.json);
  return printed ? ExitCode::kDone : report_refusal(printed.error(), arguments);
}

ExitCode tell_routes(const MapArchive& archive, const QueryRequest& request) {
  const QueryArguments& arguments = request.arguments;
  const ApproachOptions options = arguments.approach.options();
  auto reached =
      query_nearest_routes(archive, request.query, options, arguments.similar.top.value_or(1));
  if (!reached) {
    Error error = std::move(reached).error();
    if (error.field.empty()) error.field = "--nearest";
    if (error.field == "at" && error.code == ErrorCode::kNotFound) {
      error.field = "--at " + *arguments.at;
    }
    return report_refusal(std::move(error), arguments);
  }
  print_nearest_routes(*reached, options, arguments.json);
  return ExitCode::kDone;
}

/// Whether what the map has at a place, in one of its layers, is all that is asked.
bool asks_layer_alone(const QueryRequest& request) {
  const QueryArguments& arguments = request.arguments;
  return !arguments.nearest && arguments.related.empty() && !arguments.why && !request.why_not &&
         !request.similar_to && !asks_places(arguments.places) && !arguments.time.is_asked();
}

/// Whether voxels may tell something of it: not of objects, shapes and cells as they are.
bool asks_voxels(const QueryRequest& request) {
  const std::string& layer = request.query.layer;
  const bool is_flat =
      layer == kObjectsLayer || layer == kSemanticLayer || layer == kOccupancyLayer;
  return !is_flat || request.why_not || asks_places(request.arguments.places) ||
         request.arguments.complete;
}

/// What the question needs. Other times and the nearest object are told without the octree, unless
/// boxes are guessed, and the way to it by the 2D layers alone. Of a set of tiles, which may not
/// fit into memory, voxels are read for questions to them alone.
Result<PartialMap> load_for(const QueryRequest& request) {
  const QueryArguments& arguments = request.arguments;
  const bool asks_now = !arguments.time.is_asked();
  const bool asks_all = asks_now && (!arguments.nearest || arguments.complete);
  const bool is_divided = is_tile_set(arguments.file);
  const ArchiveParts parts{.octrees = asks_all && (!is_divided || asks_voxels(request)),
                           .objects = asks_all || !arguments.approach.free_space,
                           .class_grids = asks_all};
  const auto region =
      asks_layer_alone(request) ? asked_region(request.query) : std::optional<Rect>();
  return load_asked(arguments.file, region, parts, arguments.load);
}

/// The error, and of which time it is.
Error of_time(Error error, const ShownPast* past) {
  if (past == nullptr || error.code != ErrorCode::kNotFound || error.field == "frame_id")
    return error;
  error.what += " " + text_of(past->asked);
  if (!past->unknown.empty())
    error.what += "; of " + count_text(past->unknown.size(), "object") + " it cannot be told";
  return error;
}

/// `past`: null when it is asked for now.
ExitCode tell_found(const PartialMap& partial, const QueryRequest& request, ShownPast* past) {
  const QueryArguments& arguments = request.arguments;
  const MapArchive& archive = partial.map;
  const auto graph = relations_for(partial, request);
  if (!graph) return report(graph.error());
  if (past != nullptr) {
    auto unknown = unknown_answers(past->past, request.query, arguments.nearest.has_value());
    if (!unknown) return report_refusal(std::move(unknown).error(), arguments);
    past->unknown = std::move(*unknown);
  }
  auto answers = run_query(archive, *graph, request);
  if (!answers) return report_refusal(of_time(std::move(answers).error(), past), arguments);
  const auto seen = completeness_of(archive, request.query, *answers, arguments.complete);
  if (!seen) return report_refusal(seen.error(), arguments);
  const ShownAnswers shown{.answers = *answers,
                           .seen = *seen,
                           .archive = archive,
                           .graph = *graph,
                           .complete = arguments.complete,
                           .past = past,
                           .sentences = !arguments.related.empty()};
  arguments.json ? print_json(shown) : print_table(shown);
  if (!answers->found.empty()) return ExitCode::kDone;
  const bool is_unknown = request.query.text && print_hint(archive, request.query);
  if (past != nullptr && !is_unknown) print_times_hint(archive, request.time);
  if (shown.sentences && !is_unknown) print_no_relation(arguments);
  return ExitCode::kDone;
}

/// The map at another time than now answers.
ExitCode tell_past(const PartialMap& partial, const QueryRequest& request) {
  const QueryArguments& arguments = request.arguments;
  auto past = shown_past(partial.map, request.time);
  if (!past) return report_refusal(std::move(past).error(), arguments);
  if (arguments.why) return tell_why_then(partial.map, request, *past);
  const PartialMap then{.map = past->past.map, .octree_resolution_m = partial.octree_resolution_m};
  return tell_found(then, request, &*past);
}

ExitCode run(QueryRequest request) {
  if (request.arguments.similar.is_asked()) {
    auto similar_to = read_vector(request.arguments.similar);
    if (!similar_to) return report(similar_to.error());
    request.similar_to = std::move(*similar_to);
  }
  auto loaded = load_for(request);
  if (!loaded) return report(loaded.error());
  MapArchive& archive = loaded->map;
  if (const auto read = request.arguments.class_names.replace(archive.vocabulary); !read) {
    return report(read.error());
  }
  if (request.arguments.time.is_asked()) return tell_past(*loaded, request);
  if (request.arguments.nearest) request.query.layer = nearest_layer(archive);
  if (request.arguments.why || request.why_not) return tell_why(archive, request);
  if (asks_places(request.arguments.places)) return tell_places(*loaded, request);
  if (request.arguments.approach.free_space) return tell_routes(archive, request);
  return tell_found(*loaded, request, nullptr);
}

}  // namespace

void add_query_command(CLI::App& program, Action& action) {
  auto arguments = std::make_shared<QueryArguments>();
  CLI::App& command = *program.add_subcommand("query", "What is where in a map, and where is what");
  command
      .add_option(
          "file",
          arguments->file,
          "archive, configuration, or folder of tiles as `hypermap split` writes it, of which the "
          "tiles that the question reaches are read")
      ->required();
  command.add_option("--layer", arguments->layer, "a layer as info lists it");
  command.add_option(
      "--at",
      arguments->at,
      "point X,Y; of octree, evidence and objects also X,Y,Z with a height in metres");
  command.add_option(
      "--area", arguments->area, "polygon \"x y,x y,x y,...\" or \"x,y x,y x,y ...\"");
  command.add_option("--string",
                     arguments->text,
                     "objects of this name, alias or super-class; of names that begin so (chair*) "
                     "or match an expression (/chair|sofa/); Free, Occupied, Unknown");
  command.add_option("--int", arguments->value, "objects of this number: occupancy, or id");
  command.add_option(
      "--nearest",
      arguments->nearest,
      "the object of this class, alias, super-class, prefix or expression nearest to "
      "--at, by the straight line to its centroid; --top of them; in a map without 3D objects of "
      "the shapes of its semantic layer");
  arguments->approach.add_to(command);
  arguments->time.add_to(command);
  arguments->similar.add_to(command);
  command
      .add_option("--why",
                  arguments->why,
                  "the object of this id: when, from where and as what it was seen, what speaks "
                  "against it, what would remove it; also of those that are not shown")
      ->check(id_of_object());
  command.add_option(
      "--why-not", arguments->why_not, "point X,Y or X,Y,Z: why no object is shown there");
  for (const RelationKind kind : kRelationKinds) {
    command.add_option_function<std::string>(
        flag_of(kind),
        [arguments, kind](const std::string& name) { arguments->related[kind] = name; },
        std::string("objects that are ") + std::string(name_of(kind)) +
            " one of this class, or of this id" +
            (kind == RelationKind::kOn ? ", or on the floor (floor)" : "") +
            "; with --string those of one class");
  }
  command.add_option("--rules", arguments->rules, kRulesHelp);
  arguments->class_names.add_to(command);
  add_place_options(command, arguments->places);
  command.add_option(
      "--frame", arguments->frame, "frame of points and areas (default: the layer's)");
  command.add_flag("--complete",
                   arguments->complete,
                   "objects: also a guess of the box of those that were seen from few sides, by "
                   "what is usual in this map for the class");
  command.add_flag(
      "--json", arguments->json, "one JSON document; objects with all classes that they may be");
  arguments->load.add_to(command);
  show_examples(
      command,
      {"hypermap query lab.hmap --layer objects --string chair",
       "hypermap query lab.hmap --layer occupancy --area \"0 0,1 0,1 1\" --string Free",
       "hypermap query lab.hmap --nearest sofa --at 1.5,2",
       "hypermap query lab.hmap --nearest chair --at 1.5,2 --free-space --robot-radius 0.3",
       "hypermap query lab.hmap --layer objects --string seat --class-names names.yaml",
       "hypermap query lab.hmap --beside chair",
       "hypermap query flat.hmap --place cup",
       "hypermap query flat.hmap --route kitchen,bed",
       "hypermap query lab.hmap --embedding mug.npy --top 3",
       "hypermap query lab.hmap --why 4",
       "hypermap query lab.hmap --string chair --as-of 12.5",
       "hypermap query lab.hmap --session morning"});
  command.callback([arguments, &action] {
    if (const auto fault = usage_fault(*arguments)) throw CLI::ValidationError("query", *fault);
    const auto request = request_of(*arguments);
    if (!request) throw CLI::ValidationError("query", to_string(request.error()));
    action = [request = *request] { return run(request); };
  });
}

}  // namespace hypermap::app
