// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/true_surfaces_json.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/io/codec/json_fields.hpp"
#include "hypermap/io/codec/json_text.hpp"
#include "text_lines.hpp"

#include <array>
#include <cstdint>
#include <exception>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::string_view kSurfacesFormatName = "hypermap-true-surfaces";

/// Triples one after the other, as a flat list.
template <class Triples, class TextOf>
std::string flat_list(const Triples& triples, const TextOf& text_of) {
  std::string text = "[";
  for (const auto& [x, y, z] : triples) {
    for (const auto& value : {x, y, z}) {
      if (text.size() > 1) text += ',';
      text += text_of(value);
    }
  }
  text += ']';
  return text;
}

std::string json_line_of(const TrueSurface& surface) {
  std::vector<std::array<float, 3>> vertices;
  vertices.reserve(surface.vertices.size());
  for (const Eigen::Vector3f& vertex : surface.vertices)
    vertices.push_back({vertex.x(), vertex.y(), vertex.z()});
  const auto whole = [](auto number) { return std::to_string(number); };
  const auto real = [](float number) { return json_single(number); };
  std::string line = json_object({{"id", std::to_string(surface.id.value)},
                                  {"class", json_quoted(surface.class_name)},
                                  {"nameable", surface.is_nameable ? "true" : "false"},
                                  {"vertices", flat_list(vertices, real)},
                                  {"triangles", flat_list(surface.triangles, whole)},
                                  {"seen_cells", flat_list(surface.seen_cells, whole)}});
  line += '\n';
  return line;
}

/// `make(a, b, c)` for each three elements of the list `key`.
template <class T, class Parse, class Make>
Result<std::vector<T>> triples_at(const JsonNode& object,
                                  std::string_view key,
                                  const Parse& parse,
                                  const Make& make) {
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode list, object.require(key));
  HYPERMAP_ASSIGN_OR_RETURN(const auto values, list_of(list, parse));
  if (values.size() % 3 != 0)
    return list.error(ErrorCode::kMalformedFile, "expected a multiple of three numbers");
  std::vector<T> triples;
  triples.reserve(values.size() / 3);
  for (std::size_t i = 0; i < values.size(); i += 3)
    triples.push_back(make(values[i], values[i + 1], values[i + 2]));
  return triples;
}

Result<TrueSurface> parse_surface(const JsonNode& node) {
  HYPERMAP_TRY(
      expect_keys(node, {"id", "class", "nameable", "vertices", "triangles", "seen_cells"}));
  TrueSurface surface;
  HYPERMAP_ASSIGN_OR_RETURN(surface.id.value, integer_at<std::uint32_t>(node, "id"));
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode name, node.require("class"));
  HYPERMAP_ASSIGN_OR_RETURN(surface.class_name, name.string());
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode nameable, node.require("nameable"));
  HYPERMAP_ASSIGN_OR_RETURN(surface.is_nameable, nameable.boolean());
  HYPERMAP_ASSIGN_OR_RETURN(
      surface.vertices,
      triples_at<Eigen::Vector3f>(node, "vertices", float_of, [](float x, float y, float z) {
        return Eigen::Vector3f(x, y, z);
      }));
  using Corners = std::array<std::uint32_t, 3>;
  const auto corners = [](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return Corners{a, b, c};
  };
  HYPERMAP_ASSIGN_OR_RETURN(
      surface.triangles,
      triples_at<Corners>(node, "triangles", integer_of<std::uint32_t>, corners));
  const auto cell = [](std::int32_t x, std::int32_t y, std::int32_t z) {
    return SurfaceCell{x, y, z};
  };
  HYPERMAP_ASSIGN_OR_RETURN(
      surface.seen_cells,
      triples_at<SurfaceCell>(node, "seen_cells", integer_of<std::int32_t>, cell));
  return surface;
}

struct SurfacesHead {
  std::size_t num_objects = 0;
  double seen_cell_m = 0.0;
};

Result<SurfacesHead> parse_surfaces_head(const JsonNode& node, const TrueSurfacesLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto version, integer_at<std::int32_t>(node, "version"));
  if (version > kTrueSurfacesVersion)
    return node.error(ErrorCode::kUnsupported,
                      "written by a newer version " + std::to_string(version) +
                          ", the newest that is read here is " +
                          std::to_string(kTrueSurfacesVersion));
  HYPERMAP_TRY(expect_keys(node, {"format", "version", "num_objects", "seen_cell_m"}));
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode format, node.require("format"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view format_name, format.string());
  if (format_name != kSurfacesFormatName || version != kTrueSurfacesVersion)
    return format.error(ErrorCode::kMalformedFile, "expected hypermap-true-surfaces of version 1");
  SurfacesHead head;
  HYPERMAP_ASSIGN_OR_RETURN(head.num_objects, integer_at<std::uint32_t>(node, "num_objects"));
  HYPERMAP_ASSIGN_OR_RETURN(head.seen_cell_m, number_at(node, "seen_cell_m"));
  if (head.num_objects > limits.max_objects)
    return node.error(ErrorCode::kLimit,
                      std::to_string(head.num_objects) + " objects, the limit is " +
                          std::to_string(limits.max_objects));
  return head;
}

Result<JsonDocument> next_line(TextLines& lines,
                               const std::string& name,
                               const TrueSurfacesLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view line, lines.take());
  return JsonDocument::parse(line, name, {.max_bytes = limits.max_line_bytes}, lines.number());
}

Result<TrueSurfaces> parse_lines(std::string_view bytes,
                                 const std::string& name,
                                 const TrueSurfacesLimits& limits,
                                 const LoadBudget& budget) {
  TextLines lines(bytes);
  HYPERMAP_ASSIGN_OR_RETURN(const JsonDocument first, next_line(lines, name, limits));
  HYPERMAP_ASSIGN_OR_RETURN(const SurfacesHead head, parse_surfaces_head(first.root(), limits));
  TrueSurfaces surfaces{.seen_cell_m = head.seen_cell_m};
  while (!lines.done() && surfaces.objects.size() < head.num_objects) {
    HYPERMAP_TRY(budget.check_stop());
    HYPERMAP_ASSIGN_OR_RETURN(const JsonDocument document, next_line(lines, name, limits));
    HYPERMAP_ASSIGN_OR_RETURN(TrueSurface surface, parse_surface(document.root()));
    surfaces.objects.push_back(std::move(surface));
  }
  if (!lines.done() || surfaces.objects.size() != head.num_objects)
    return fail(ErrorCode::kMalformedFile,
                "says " + std::to_string(head.num_objects) + " objects, there are " +
                    (lines.done() ? "only " + std::to_string(surfaces.objects.size()) : "more"),
                "num_objects");
  if (const auto valid = validate(surfaces); !valid)
    return first.root().error(ErrorCode::kMalformedFile,
                              valid.error().field + " " + valid.error().what);
  return surfaces;
}

}  // namespace

Result<std::string> write_true_surfaces(const TrueSurfaces& surfaces) {
  HYPERMAP_TRY(validate(surfaces));
  std::string text = json_object({{"format", json_quoted(kSurfacesFormatName)},
                                  {"version", std::to_string(kTrueSurfacesVersion)},
                                  {"num_objects", std::to_string(surfaces.objects.size())},
                                  {"seen_cell_m", json_number(surfaces.seen_cell_m)}});
  text += '\n';
  for (const TrueSurface& surface : surfaces.objects) text += json_line_of(surface);
  return text;
}

Result<TrueSurfaces> parse_true_surfaces(std::string_view bytes,
                                         const SourceName& source,
                                         const TrueSurfacesLimits& limits,
                                         const LoadBudget& budget) try {
  auto surfaces = parse_lines(bytes, source.file, limits, budget);
  if (!surfaces) return tl::make_unexpected(with_source(std::move(surfaces).error(), source));
  return surfaces;
} catch (const std::exception& exception) {
  return caught(exception, ErrorCode::kMalformedFile, "the true surfaces");
}

}  // namespace hypermap
