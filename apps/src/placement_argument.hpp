// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where an input's world lies in a map, as the command line says it.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"

#include <CLI/App.hpp>

#include <optional>
#include <string>

namespace hypermap::app {

/// Accepts "X,Y,Z,YAW", metres and degrees.
[[nodiscard]] CLI::Validator placement_text();

/// The placement that it says, if it is given. Errors: kInvalidArgument for what placement_text
/// does not accept.
[[nodiscard]] Result<std::optional<WorldPlacement>> placement_of(
    const std::optional<std::string>& text);

/// An error of `transformed` as that of the option, where it is of the motion itself.
[[nodiscard]] Error of_motion(Error error, const char* option);

}  // namespace hypermap::app
