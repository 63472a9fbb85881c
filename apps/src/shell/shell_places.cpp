// SPDX-License-Identifier: BSD-3-Clause
#include "shell_places.hpp"

#include "choices.hpp"
#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/io/codec/text_file.hpp"
#include "hypermap/io/codec/wkt.hpp"
#include "number_lists.hpp"

#include <cctype>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

namespace hypermap::app {
namespace {

/// Whether the text begins with the word, in any case, and no letter follows.
bool begins_with_word(std::string_view text, std::string_view word) {
  std::size_t num_letters = 0;
  while (num_letters < text.size() && std::isalpha(static_cast<unsigned char>(text[num_letters])))
    ++num_letters;
  return is_spelling_of(word, text.substr(0, num_letters));
}

/// What stands between the parentheses around all of the text; the text where there are none.
std::string_view without_parentheses(std::string_view text) {
  const std::string_view inner = trimmed(text);
  if (inner.size() < 2 || inner.front() != '(' || inner.back() != ')') return inner;
  return trimmed(inner.substr(1, inner.size() - 2));
}

Unexpected wrong_location(const std::string& text) {
  return fail(ErrorCode::kInvalidArgument,
              "must be X,Y or X,Y,Z or POINT (X Y), in metres, is '" + printable(text) + "'",
              "location");
}

}  // namespace

Result<PlanPoint> parse_location(const std::string& text) {
  std::string_view numbers = trimmed(text);
  if (begins_with_word(numbers, "POINT")) {
    numbers = trimmed(numbers.substr(std::string_view("POINT").size()));
    if (without_parentheses(numbers) == numbers) return wrong_location(text);
  }
  const auto parsed = parse_numbers(std::string(without_parentheses(numbers)), 2, 3, "location");
  if (!parsed) return wrong_location(text);
  PlanPoint point{.xy = {(*parsed)[0], (*parsed)[1]}};
  if (parsed->size() > 2) point.z = (*parsed)[2];
  return point;
}

Result<Polygon> parse_shell_area(const std::string& text) {
  const bool is_wkt =
      begins_with_word(trimmed(text), "POLYGON") || begins_with_word(trimmed(text), "MULTIPOLYGON");
  if (is_wkt) {
    auto shape = read_wkt(text);
    if (!shape) {
      Error error = std::move(shape).error();
      error.field = error.field.empty() ? "area" : "area: " + error.field;
      return Unexpected(std::move(error));
    }
    if (shape->parts.size() == 1) return std::move(shape->parts.front());
    return fail(ErrorCode::kInvalidArgument,
                "must be one polygon, has " + std::to_string(shape->parts.size()) + " parts",
                "area");
  }
  HYPERMAP_ASSIGN_OR_RETURN(auto ring,
                            parse_points(std::string(without_parentheses(text)), "area"));
  auto polygon = make_polygon(std::move(ring));
  if (!polygon) return fail(polygon.error().code, polygon.error().what, "area");
  return std::move(*polygon);
}

}  // namespace hypermap::app
