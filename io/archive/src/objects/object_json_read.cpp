// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/caught.hpp"
#include "hypermap/io/archive/object_json.hpp"
#include "hypermap/io/codec/json_fields.hpp"
#include "object_from_json.hpp"
#include "text_lines.hpp"

#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

struct Head {
  std::size_t num_objects = 0;
  ObjectId next_id;
};

Result<Head> parse_head(const JsonNode& node, const ObjectFileLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto version, integer_at<std::int32_t>(node, "version"));
  if (version > kObjectsVersion)
    return node.error(ErrorCode::kUnsupported,
                      "written by a newer version " + std::to_string(version) +
                          ", the newest that is read here is " + std::to_string(kObjectsVersion));
  HYPERMAP_TRY(expect_keys(node, {"format", "version", "num_objects", "next_id"}));
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode format, node.require("format"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view format_name, format.string());
  if (format_name != "hypermap-objects" || version < 1)
    return format.error(ErrorCode::kMalformedFile, "expected hypermap-objects of version 1 or 2");
  Head head;
  HYPERMAP_ASSIGN_OR_RETURN(head.num_objects, integer_at<std::uint32_t>(node, "num_objects"));
  HYPERMAP_ASSIGN_OR_RETURN(head.next_id.value, integer_at<std::uint32_t>(node, "next_id"));
  if (head.num_objects > limits.max_objects)
    return node.error(ErrorCode::kLimit,
                      std::to_string(head.num_objects) + " objects, the limit is " +
                          std::to_string(limits.max_objects));
  return head;
}

Result<JsonDocument> next_document(TextLines& lines,
                                   const std::string& name,
                                   const ObjectFileLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view line, lines.take());
  return JsonDocument::parse(line, name, {.max_bytes = limits.max_line_bytes}, lines.number());
}

Result<ObjectMap> parse(std::string_view bytes,
                        const std::string& name,
                        const ObjectFileLimits& limits,
                        const LoadBudget& budget) {
  TextLines lines(bytes);
  HYPERMAP_ASSIGN_OR_RETURN(const JsonDocument first, next_document(lines, name, limits));
  HYPERMAP_ASSIGN_OR_RETURN(const Head head, parse_head(first.root(), limits));
  std::vector<Object> objects;
  while (!lines.done() && objects.size() < head.num_objects) {
    HYPERMAP_TRY(budget.check_stop());
    HYPERMAP_ASSIGN_OR_RETURN(const JsonDocument document, next_document(lines, name, limits));
    HYPERMAP_ASSIGN_OR_RETURN(Object object, object_from_json(document.root(), limits));
    objects.push_back(std::move(object));
  }
  if (!lines.done() || objects.size() != head.num_objects)
    return fail(ErrorCode::kMalformedFile,
                "says " + std::to_string(head.num_objects) + " objects, there are " +
                    (lines.done() ? "only " + std::to_string(objects.size()) : "more"),
                "num_objects");
  return validated(first.root(), ObjectMap::restore(std::move(objects), head.next_id));
}

}  // namespace

Result<ObjectMap> parse_objects(std::string_view bytes,
                                const SourceName& source,
                                const ObjectFileLimits& limits,
                                const LoadBudget& budget) try {
  auto objects = parse(bytes, source.file, limits, budget);
  if (!objects) return tl::make_unexpected(with_source(std::move(objects).error(), source));
  return objects;
} catch (const std::exception& exception) {
  return caught(exception, ErrorCode::kMalformedFile, "the objects");
}

}  // namespace hypermap
