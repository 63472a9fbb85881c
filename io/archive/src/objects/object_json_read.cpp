// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/caught.hpp"
#include "hypermap/io/archive/object_json.hpp"
#include "hypermap/io/codec/json_fields.hpp"
#include "object_chunks.hpp"
#include "object_from_json.hpp"
#include "text_lines.hpp"

#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// Before it, an object is one line.
constexpr int kFirstVersionWithCellLines = 3;

struct Head {
  int version = 0;
  std::size_t num_objects = 0;
  ObjectId next_id = {};
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
    return format.error(ErrorCode::kMalformedFile, "expected hypermap-objects of version 1 to 4");
  Head head{.version = version};
  HYPERMAP_ASSIGN_OR_RETURN(head.num_objects, integer_at<std::uint32_t>(node, "num_objects"));
  HYPERMAP_ASSIGN_OR_RETURN(head.next_id.value, integer_at<std::uint32_t>(node, "next_id"));
  if (head.num_objects > limits.max_objects)
    return node.error(ErrorCode::kLimit,
                      std::to_string(head.num_objects) + " objects, the limit is " +
                          std::to_string(limits.max_objects));
  return head;
}

struct NumberedLine {
  std::string_view text;
  int number = 0;
};

/// The line of an object's state and, from version 3 on, that of its cells.
struct LinesOfObject {
  NumberedLine state;
  std::optional<NumberedLine> cells;
};

Result<std::vector<NumberedLine>> take_lines(TextLines& lines,
                                             std::size_t most,
                                             const LoadBudget& budget) {
  constexpr std::size_t kLinesBetweenChecks = 4096;
  std::vector<NumberedLine> taken;
  while (!lines.done() && taken.size() < most) {
    if (taken.size() % kLinesBetweenChecks == 0) HYPERMAP_TRY(budget.check_stop());
    HYPERMAP_ASSIGN_OR_RETURN(const std::string_view line, lines.take());
    taken.push_back({.text = line, .number = lines.number()});
  }
  return taken;
}

Unexpected wrong_number(const Head& head,
                        const std::string& of_what,
                        const std::string& there_are) {
  return fail(
      ErrorCode::kMalformedFile,
      "says " + std::to_string(head.num_objects) + " objects, there are " + there_are + of_what,
      "num_objects");
}

Result<std::vector<LinesOfObject>> lines_of_objects(TextLines& lines,
                                                    const Head& head,
                                                    const LoadBudget& budget) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto states, take_lines(lines, head.num_objects, budget));
  if (states.size() < head.num_objects)
    return wrong_number(head, "", "only " + std::to_string(states.size()));
  std::vector<LinesOfObject> all;
  all.reserve(states.size());
  for (const NumberedLine& state : states) all.push_back({.state = state, .cells = std::nullopt});
  if (head.version >= kFirstVersionWithCellLines) {
    HYPERMAP_ASSIGN_OR_RETURN(const auto cells, take_lines(lines, head.num_objects, budget));
    if (cells.size() < head.num_objects)
      return wrong_number(head, " lines of cells", "only " + std::to_string(cells.size()));
    for (std::size_t i = 0; i < cells.size(); ++i) all[i].cells = cells[i];
  }
  if (!lines.done()) return wrong_number(head, "", "more lines");
  return all;
}

/// Reads what is on lines; knows the file's name.
class LineReader {
 public:
  LineReader(const std::string& name, const ObjectFileLimits& limits)
      : name_(name), limits_(limits) {}

  [[nodiscard]] Result<JsonDocument> document(const NumberedLine& line) const {
    return JsonDocument::parse(
        line.text, name_, {.max_bytes = limits_.max_line_bytes}, line.number);
  }
  [[nodiscard]] Result<Object> object(const LinesOfObject& lines) const {
    HYPERMAP_ASSIGN_OR_RETURN(const JsonDocument state, document(lines.state));
    if (!lines.cells) return object_from_json(state.root(), std::nullopt, limits_);
    HYPERMAP_ASSIGN_OR_RETURN(const JsonDocument cells, document(*lines.cells));
    return object_from_json(state.root(), cells.root(), limits_);
  }

 private:
  const std::string& name_;
  const ObjectFileLimits& limits_;
};

Result<ObjectMap> parse(std::string_view bytes,
                        const std::string& name,
                        const ObjectFileLimits& limits,
                        const LoadBudget& budget) {
  const LineReader reader(name, limits);
  TextLines lines(bytes);
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view first, lines.take());
  HYPERMAP_ASSIGN_OR_RETURN(const JsonDocument first_line,
                            reader.document({.text = first, .number = lines.number()}));
  HYPERMAP_ASSIGN_OR_RETURN(const Head head, parse_head(first_line.root(), limits));
  HYPERMAP_ASSIGN_OR_RETURN(const auto all, lines_of_objects(lines, head, budget));
  std::vector<Object> objects;
  objects.reserve(all.size());
  HYPERMAP_TRY(for_each_in_order<Object>(
      all.size(),
      [&](std::size_t i) { return reader.object(all[i]); },
      [&](Object object) -> Result<void> {
        objects.push_back(std::move(object));
        return budget.check_stop();
      }));
  return validated(first_line.root(), ObjectMap::restore(std::move(objects), head.next_id));
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
