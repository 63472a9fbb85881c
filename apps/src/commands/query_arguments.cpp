// SPDX-License-Identifier: BSD-3-Clause
#include "query_arguments.hpp"

#include "hypermap/io/archive/archive_layers.hpp"
#include "hypermap/io/archive/map_layers.hpp"

namespace hypermap::app {
namespace {

/// Whether layers, conditions, likeness or relations are asked for.
bool asks_layers(const QueryArguments& arguments) {
  return arguments.layer || arguments.at || arguments.area || arguments.text || arguments.value ||
         arguments.nearest || arguments.approach.free_space || arguments.complete ||
         !arguments.frame.empty() || !arguments.related.empty() || arguments.similar.is_asked() ||
         arguments.similar.is_incomplete();
}

/// What goes with --embedding.
std::optional<std::string> fault_of_similar(const QueryArguments& arguments) {
  if (arguments.nearest || !arguments.related.empty()) {
    return "--embedding goes without --nearest and relations";
  }
  if (!arguments.layer || *arguments.layer == kObjectsLayer) return std::nullopt;
  return "--embedding asks the objects of the 3D map, not --layer " + *arguments.layer;
}

/// What goes with --nearest.
std::optional<std::string> fault_of_nearest(const QueryArguments& arguments) {
  if (!arguments.at) return "--nearest needs --at X,Y";
  if (arguments.text) return "--nearest names the class: --string goes without it";
  if (!arguments.related.empty()) return "--nearest goes without relations";
  if (arguments.complete && arguments.approach.free_space)
    return "--complete goes without --free-space";
  if (!arguments.layer || *arguments.layer == kObjectsLayer) return std::nullopt;
  return "--nearest asks the objects of the 3D map, not --layer " + *arguments.layer;
}

/// What goes with another time than now.
std::optional<std::string> fault_of_time(const QueryArguments& arguments) {
  if (!arguments.time.is_asked()) return std::nullopt;
  const std::string flags = "--since, --until, --as-of and --session";
  if (arguments.why_not || asks_places(arguments.places) || arguments.approach.free_space) {
    return flags +
           " go without --why-not, --free-space, --rooms, --place and --route: occupied and free "
           "space is not kept through time";
  }
  if (arguments.why && !arguments.time.as_of) return "--why asks of a moment, by --as-of";
  if (arguments.similar.is_asked() && arguments.time.as_of)
    return "--embedding goes without --as-of: embeddings are not kept through time";
  const std::string layer = arguments.layer.value_or(std::string(kObjectsLayer));
  if (layer == kObjectsLayer || layer == kSemanticLayer) return std::nullopt;
  return flags + " ask objects and the layer semantic: --layer " + printable(layer) +
         " is not kept through time";
}

}  // namespace

std::optional<std::string> usage_fault(const QueryArguments& arguments) {
  if (auto fault = fault_of_time(arguments)) return fault;
  if (arguments.why || arguments.why_not) {
    const bool asks_more = asks_layers(arguments) || asks_places(arguments.places);
    if (asks_more || (arguments.why && arguments.why_not)) {
      return "--why and --why-not ask one thing each: no other condition goes with them";
    }
    return std::nullopt;
  }
  if (asks_places(arguments.places)) return fault_of(arguments.places, asks_layers(arguments));
  if (arguments.approach.free_space && !arguments.nearest)
    return "--free-space goes with --nearest";
  if (arguments.approach.is_incomplete()) return "--robot-radius and --reach go with --free-space";
  if (arguments.similar.is_incomplete() && (arguments.similar.model || !arguments.nearest)) {
    return "--model goes with --embedding, --top with --embedding or --nearest";
  }
  if (arguments.similar.is_asked()) return fault_of_similar(arguments);
  if (arguments.nearest) return fault_of_nearest(arguments);
  if (!arguments.related.empty() && arguments.layer && *arguments.layer != kObjectsLayer) {
    return "relations are those of the objects of the 3D map, not of --layer " + *arguments.layer;
  }
  const bool has_layer = arguments.layer || !arguments.related.empty() || arguments.time.is_asked();
  if (!has_layer && asks_layers(arguments)) {
    return "--layer is needed: objects, or one of those that `hypermap info` lists";
  }
  if (!has_layer) {
    return "one of --layer, --nearest, --embedding, --why, --why-not, --on, --in, --under, "
           "--beside, --part-of, --rooms, --place, --route, --since, --until, --as-of and "
           "--session is needed";
  }
  if (arguments.complete && arguments.layer.value_or(std::string(kObjectsLayer)) != kObjectsLayer) {
    return "--complete asks the objects of the 3D map, not --layer " + *arguments.layer;
  }
  return std::nullopt;
}

}  // namespace hypermap::app
