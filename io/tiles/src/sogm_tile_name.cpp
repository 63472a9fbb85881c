// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/codec/text_file.hpp"
#include "hypermap/io/tiles/sogm_tile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <span>

namespace hypermap {
namespace {

constexpr std::string_view kSogmEnding = ".bin";
constexpr std::array<std::string_view, 17> kKeys{"What",
                                                 "T",
                                                 "Timestamp",
                                                 "Format",
                                                 "Unit",
                                                 "Layer",
                                                 "LayerIdx",
                                                 "Res",
                                                 "GridRes",
                                                 "X",
                                                 "Y",
                                                 "Z",
                                                 "yaw",
                                                 "rows",
                                                 "cols",
                                                 "lat",
                                                 "lon"};
constexpr std::string_view kAltitudeKey = "alt";

/// "INT8" is what the implementation calls its own; the others are OpenCV's words.
constexpr std::array<std::string_view, 9> kFormatNames{
    "8S", "8U", "16S", "16U", "32S", "32U", "32F", "64F", "INT8"};
constexpr std::array<std::string_view, 2> kUnitNames{"logodds", "probability"};

/// A unit that may follow a number, and by what the number is divided.
struct NumberUnit {
  std::string_view name;
  double divisor = 1.0;
};
/// The longest that fits counts, so "mm" stands before "m".
constexpr std::array<NumberUnit, 3> kLengths{{{"mm", 1000.0}, {"cm", 100.0}, {"m", 1.0}}};
constexpr std::array<NumberUnit, 2> kAngles{{{"rad", 1.0}, {"deg", 180.0 / std::numbers::pi}}};
constexpr std::array<NumberUnit, 1> kDegrees{{{"deg", 1.0}}};

using SogmFields = std::map<std::string_view, std::string_view>;

bool is_key(std::string_view word) {
  return word == kAltitudeKey || std::ranges::find(kKeys, word) != kKeys.end();
}

Unexpected wrong_name(std::string what, std::string_view field) {
  return fail(ErrorCode::kMalformedFile, std::move(what), std::string(field));
}

/// Keys and values, divided by underscores; a value goes on to the next key.
Result<SogmFields> fields_of(std::string_view name) {
  if (!name.ends_with(kSogmEnding)) return wrong_name("must end in .bin", "name");
  name.remove_suffix(kSogmEnding.size());
  if (name.ends_with('_')) name.remove_suffix(1);
  SogmFields fields;
  std::string_view key;
  std::size_t value_begin = 0;
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('_', begin), name.size());
    const std::string_view word = name.substr(begin, end - begin);
    const bool is_next_key = is_key(word) && (key.empty() || begin > value_begin);
    if (is_next_key) {
      if (fields.contains(word)) return wrong_name("is told twice", word);
      key = word;
      value_begin = end + 1;
      fields[key] = {};
    } else if (key.empty()) {
      return wrong_name("must begin with a key such as What, is '" + printable(word) + "'", "name");
    } else {
      fields[key] = name.substr(value_begin, end - value_begin);
    }
    begin = end + 1;
  }
  return fields;
}

Result<std::string_view> text_at(const SogmFields& fields, std::string_view key) {
  const auto found = fields.find(key);
  if (found == fields.end()) return wrong_name("is missing", key);
  if (found->second.empty()) return wrong_name("has no value", key);
  return found->second;
}

/// A number with one of the units, or without.
Result<double> measure_at(const SogmFields& fields,
                          std::string_view key,
                          std::span<const NumberUnit> units) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view text, text_at(fields, key));
  std::string_view digits = text;
  double divisor = 1.0;
  for (const NumberUnit& unit : units) {
    if (!text.ends_with(unit.name)) continue;
    digits.remove_suffix(unit.name.size());
    divisor = unit.divisor;
    break;
  }
  if (const auto number = parse_double(digits)) return *number / divisor;
  return wrong_name("must be a number, is '" + printable(text) + "'", key);
}

Result<std::uint64_t> count_in(std::string_view text, std::string_view key, std::uint64_t most) {
  const auto number = parse_unsigned(text);
  if (number && *number <= most) return *number;
  return wrong_name(
      "must be a whole number up to " + std::to_string(most) + ", is '" + printable(text) + "'",
      key);
}

Result<int> side_at(const SogmFields& fields, std::string_view key) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view text, text_at(fields, key));
  constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<int>::max());
  HYPERMAP_ASSIGN_OR_RETURN(const std::uint64_t side, count_in(text, key, kMost));
  return static_cast<int>(side);
}

/// Seconds and nanoseconds, each a whole number; or microseconds.
Result<Stamp> stamp_of(const SogmFields& fields) {
  constexpr std::uint64_t kMaxSeconds = 9'000'000'000;
  if (fields.contains("Timestamp")) {
    HYPERMAP_ASSIGN_OR_RETURN(std::string_view text, text_at(fields, "Timestamp"));
    if (text.ends_with("us")) text.remove_suffix(2);
    HYPERMAP_ASSIGN_OR_RETURN(const std::uint64_t micros,
                              count_in(text, "Timestamp", kMaxSeconds * 1'000'000));
    return Stamp{static_cast<std::int64_t>(micros) * 1000};
  }
  HYPERMAP_ASSIGN_OR_RETURN(std::string_view text, text_at(fields, "T"));
  if (text.ends_with("s.ns")) text.remove_suffix(4);
  const std::size_t point = text.find('.');
  const std::string_view nanos_text =
      point == std::string_view::npos ? "0" : text.substr(point + 1);
  HYPERMAP_ASSIGN_OR_RETURN(const std::uint64_t seconds,
                            count_in(text.substr(0, point), "T", kMaxSeconds));
  HYPERMAP_ASSIGN_OR_RETURN(const std::uint64_t nanos, count_in(nanos_text, "T", 999'999'999));
  return Stamp{static_cast<std::int64_t>(seconds * 1'000'000'000 + nanos)};
}

/// A topic of ROS has no hyphens; in file names they stand for its slashes.
Result<std::string> layer_of(const SogmFields& fields) {
  if (!fields.contains("Layer")) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string_view text, text_at(fields, "LayerIdx"));
    HYPERMAP_ASSIGN_OR_RETURN(const std::uint64_t number, count_in(text, "LayerIdx", 1'000'000));
    return "/layer" + std::to_string(number);
  }
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view text, text_at(fields, "Layer"));
  std::string layer(text);
  std::ranges::replace(layer, '-', '/');
  if (!layer.starts_with('/')) layer.insert(layer.begin(), '/');
  const bool is_sound = !layer.ends_with('/') && layer.find("//") == std::string::npos &&
                        printable(layer, layer.size()) == layer;
  if (is_sound) return layer;
  return wrong_name("must be parts divided by single hyphens, is '" + printable(text) + "'",
                    "Layer");
}

/// The place of a word among names.
Result<std::size_t> choice_at(const SogmFields& fields,
                              std::string_view key,
                              std::span<const std::string_view> names) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view text, text_at(fields, key));
  const auto found = std::ranges::find(names, text);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  return fail(ErrorCode::kUnsupported, not_one_of(text, names), std::string(key));
}

Result<GridGeometry> geometry_in(const SogmFields& fields) {
  GridGeometry geometry;
  const std::string_view resolution = fields.contains("Res") ? "Res" : "GridRes";
  HYPERMAP_ASSIGN_OR_RETURN(geometry.resolution_m, measure_at(fields, resolution, kLengths));
  HYPERMAP_ASSIGN_OR_RETURN(geometry.origin.x(), measure_at(fields, "X", kLengths));
  HYPERMAP_ASSIGN_OR_RETURN(geometry.origin.y(), measure_at(fields, "Y", kLengths));
  if (fields.contains("yaw")) {
    HYPERMAP_ASSIGN_OR_RETURN(geometry.yaw_rad, measure_at(fields, "yaw", kAngles));
  }
  HYPERMAP_ASSIGN_OR_RETURN(geometry.cols, side_at(fields, "cols"));
  HYPERMAP_ASSIGN_OR_RETURN(geometry.rows, side_at(fields, "rows"));
  return geometry;
}

Result<std::optional<GeographicDatum>> datum_in(const SogmFields& fields) {
  if (!fields.contains("lat") && !fields.contains("lon")) return std::optional<GeographicDatum>();
  GeographicDatum datum;
  HYPERMAP_ASSIGN_OR_RETURN(datum.latitude_deg, measure_at(fields, "lat", kDegrees));
  HYPERMAP_ASSIGN_OR_RETURN(datum.longitude_deg, measure_at(fields, "lon", kDegrees));
  if (fields.contains(kAltitudeKey)) {
    HYPERMAP_ASSIGN_OR_RETURN(datum.altitude_m, measure_at(fields, kAltitudeKey, kLengths));
  }
  const bool has_fix = !std::isnan(datum.latitude_deg) && !std::isnan(datum.longitude_deg) &&
                       !std::isnan(datum.altitude_m);
  return has_fix ? std::optional(datum) : std::nullopt;
}

Result<void> check_units(const SogmTileName& name) {
  const bool is_unsigned = name.format == SogmFormat::kU8 || name.format == SogmFormat::kU16 ||
                           name.format == SogmFormat::kU32;
  const bool is_real = name.format == SogmFormat::kF32 || name.format == SogmFormat::kF64;
  const bool fits = name.unit == SogmUnit::kLogOdds ? !is_unsigned : is_unsigned || is_real;
  if (fits) return {};
  return fail(ErrorCode::kUnsupported,
              name.unit == SogmUnit::kLogOdds ? "log-odds need a sign"
                                              : "probabilities have none with a sign",
              "Format");
}

Result<void> check_values(const SogmTileName& name) {
  auto checked = validate(name.geometry);
  if (checked && name.geometry.num_cells() == 0) {
    checked = fail(ErrorCode::kInvalidArgument, "has no cells", "size");
  }
  if (checked && name.datum) checked = validate(*name.datum);
  if (checked && !std::isfinite(name.z_m)) {
    checked = fail(ErrorCode::kInvalidArgument, "must be finite", "Z");
  }
  if (checked) return {};
  Error error = std::move(checked).error();
  if (error.code == ErrorCode::kInvalidArgument) error.code = ErrorCode::kMalformedFile;
  return Unexpected(std::move(error));
}

}  // namespace

Result<SogmTileName> parse_sogm_tile_name(std::string_view file_name) {
  HYPERMAP_ASSIGN_OR_RETURN(const SogmFields fields, fields_of(file_name));
  if (fields.contains("What")) {
    constexpr std::array<std::string_view, 1> kWhats{"OGM"};
    HYPERMAP_TRY(choice_at(fields, "What", kWhats));
  }
  SogmTileName name;
  HYPERMAP_ASSIGN_OR_RETURN(name.stamp, stamp_of(fields));
  HYPERMAP_ASSIGN_OR_RETURN(const std::size_t format, choice_at(fields, "Format", kFormatNames));
  const bool is_int8 = format + 1 == kFormatNames.size();
  name.format = is_int8 ? SogmFormat::kS8 : static_cast<SogmFormat>(format);
  if (fields.contains("Unit")) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::size_t unit, choice_at(fields, "Unit", kUnitNames));
    name.unit = static_cast<SogmUnit>(unit);
  }
  HYPERMAP_TRY(check_units(name));
  HYPERMAP_ASSIGN_OR_RETURN(name.layer, layer_of(fields));
  HYPERMAP_ASSIGN_OR_RETURN(name.geometry, geometry_in(fields));
  if (fields.contains("Z")) {
    HYPERMAP_ASSIGN_OR_RETURN(name.z_m, measure_at(fields, "Z", kLengths));
  }
  HYPERMAP_ASSIGN_OR_RETURN(name.datum, datum_in(fields));
  HYPERMAP_TRY(check_values(name));
  return name;
}

}  // namespace hypermap
