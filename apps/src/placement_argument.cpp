// SPDX-License-Identifier: BSD-3-Clause
#include "placement_argument.hpp"

#include "command.hpp"
#include "number_lists.hpp"

#include <numbers>
#include <utility>

namespace hypermap::app {

CLI::Validator placement_text() {
  const auto check = [](const std::string& text) -> std::string {
    const auto numbers = parse_numbers(text, 4, 4, "");
    return numbers ? "" : numbers.error().what;
  };
  return {check, "X,Y,Z,YAW"};
}

Result<std::optional<WorldPlacement>> placement_of(const std::optional<std::string>& text) {
  if (!text) return std::optional<WorldPlacement>();
  HYPERMAP_ASSIGN_OR_RETURN(const auto numbers, parse_numbers(*text, 4, 4, "--transform"));
  return std::optional(WorldPlacement{.x_m = numbers[0],
                                      .y_m = numbers[1],
                                      .z_m = numbers[2],
                                      .yaw_rad = numbers[3] * std::numbers::pi / 180.0});
}

Error of_motion(Error error, const char* option) {
  return error.field == "map_from_old" ? of_option(std::move(error), option) : error;
}

}  // namespace hypermap::app
