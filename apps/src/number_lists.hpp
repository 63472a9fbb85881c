// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Numbers as they stand on command lines.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/io/dataset/depth_file.hpp"

#include <CLI/App.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hypermap::app {

/// The number that `text` is, with a point whatever the language; none for all else, infinity and
/// NaN included.
[[nodiscard]] std::optional<double> finite_number(const std::string& text);

/// For an option with one number in [min, max]. NaN lies in no range; the decimal point is a point
/// whatever the language.
[[nodiscard]] CLI::Validator number_in(double min, double max);
/// For `transform`: digits alone, up to 2^64 - 1, made decimal whatever zeros stand before them.
[[nodiscard]] CLI::Validator whole_number();

/// "1.5,2,0" as at least `min_count` and at most `max_count` finite numbers, separated by commas or
/// blanks. Errors: kInvalidArgument naming `field`.
[[nodiscard]] Result<std::vector<double>> parse_numbers(const std::string& text,
                                                        std::size_t min_count,
                                                        std::size_t max_count,
                                                        const std::string& field);

/// A name and how much it counts.
struct WeightedName {
  std::string name;
  double weight = 1.0;
};

/// "depth=0.5" or "depth". Errors: kInvalidArgument naming `field`: no name, or what follows the
/// last `=` is no number above 0 and at most kMaxSensorWeight.
[[nodiscard]] Result<WeightedName> parse_weighted(const std::string& text,
                                                  const std::string& field);

/// "640x480" as the sides of an image, 1 .. 65535 each. Errors: kInvalidArgument naming `field`.
[[nodiscard]] Result<ImageSize> parse_sides(const std::string& text, const std::string& field);

/// "0 0,1 0,1 1" as points. Errors: kInvalidArgument naming `field`.
[[nodiscard]] Result<Ring> parse_points(const std::string& text, const std::string& field);

}  // namespace hypermap::app
