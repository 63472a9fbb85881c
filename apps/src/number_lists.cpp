// SPDX-License-Identifier: BSD-3-Clause
#include "number_lists.hpp"

#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/codec/text_file.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"
#include "tables.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace hypermap::app {
namespace {

std::vector<std::string_view> split(std::string_view text, std::string_view separators) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = text.find_first_not_of(separators, at);
    if (begin == std::string_view::npos) break;
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    at = end;
  }
  return parts;
}

Result<double> parse_number(std::string_view text, const std::string& field) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(number)) {
    return fail(
        ErrorCode::kInvalidArgument, "'" + std::string(text) + "' is no finite number", field);
  }
  return number;
}

}  // namespace

std::optional<double> finite_number(const std::string& text) {
  const auto number = parse_number(text, "");
  return number ? std::optional(*number) : std::nullopt;
}

CLI::Validator number_in(double min, double max) {
  const auto check = [min, max](const std::string& text) -> std::string {
    const auto number = finite_number(text);
    if (number && *number >= min && *number <= max) return {};
    return "must be a number in " + fixed(min, 3) + " .. " + fixed(max, 0) + ", is '" +
           printable(text) + "'";
  };
  return {check, number_text(min) + " .. " + number_text(max)};
}

CLI::Validator whole_number() {
  const auto check = [](std::string& text) -> std::string {
    const auto number = parse_unsigned(text);
    if (!number) return "must be a whole number from 0 on, is '" + printable(text) + "'";
    text = std::to_string(*number);  // zeros before it would make it octal
    return "";
  };
  return {check, "at least 0"};
}

Result<std::vector<double>> parse_numbers(const std::string& text,
                                          std::size_t min_count,
                                          std::size_t max_count,
                                          const std::string& field) {
  std::vector<double> numbers;
  for (const std::string_view part : split(text, ", ")) {
    HYPERMAP_ASSIGN_OR_RETURN(const double number, parse_number(part, field));
    numbers.push_back(number);
  }
  if (numbers.size() >= min_count && numbers.size() <= max_count) return numbers;
  std::string wanted = std::to_string(min_count);
  if (max_count > min_count) wanted += " or " + std::to_string(max_count);
  return fail(ErrorCode::kInvalidArgument,
              "must be " + wanted + " numbers separated by commas, is '" + text + "'",
              field);
}

Result<WeightedName> parse_weighted(const std::string& text, const std::string& field) {
  const std::size_t mark = text.rfind('=');
  const std::string name = text.substr(0, mark);
  const auto wrong = [&](const std::string& rule) {
    return fail(ErrorCode::kInvalidArgument, rule + ", is '" + printable(text) + "'", field);
  };
  if (name.empty()) return wrong("must be NAME or NAME=WEIGHT");
  if (mark == std::string::npos) return WeightedName{.name = name};
  const auto weight = finite_number(text.substr(mark + 1));
  if (!weight) return wrong("must be NAME or NAME=WEIGHT");
  if (*weight > 0.0 && *weight <= kMaxSensorWeight) return WeightedName{name, *weight};
  return wrong("WEIGHT must be above 0 and at most " + number_text(kMaxSensorWeight));
}

Result<ImageSize> parse_sides(const std::string& text, const std::string& field) {
  constexpr int kLongestSidePx = 65535;
  ImageSize size;
  char rest = 0;
  const bool is_clean = text.find_first_not_of("0123456789x") == std::string::npos;
  if (is_clean && text.size() <= std::string_view("65535x65535").size() &&
      std::sscanf(text.c_str(), "%dx%d%c", &size.width_px, &size.height_px, &rest) == 2 &&
      std::min(size.width_px, size.height_px) > 0 &&
      std::max(size.width_px, size.height_px) <= kLongestSidePx)
    return size;
  return fail(ErrorCode::kInvalidArgument,
              "must be WIDTHxHEIGHT with sides of 1 .. 65535 pixels, is '" + text + "'",
              field);
}

Result<Ring> parse_points(const std::string& text, const std::string& field) {
  const auto by_blanks = split(text, " ");
  const bool has_comma_in_points =
      std::all_of(by_blanks.begin(), by_blanks.end(), [](std::string_view part) {
        const std::size_t comma = part.find(',');
        return comma != std::string_view::npos && comma > 0 && comma + 1 < part.size();
      });
  Ring ring;
  for (const std::string_view pair : has_comma_in_points ? by_blanks : split(text, ",")) {
    const auto point = parse_numbers(std::string(pair), 2, 2, field);
    if (!point) {
      return fail(ErrorCode::kInvalidArgument,
                  "must be points \"x y,x y,...\" or \"x,y x,y ...\", has '" +
                      printable(std::string(pair)) + "'",
                  field);
    }
    ring.emplace_back((*point)[0], (*point)[1]);
  }
  return ring;
}

}  // namespace hypermap::app
