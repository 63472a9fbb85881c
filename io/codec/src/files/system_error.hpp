// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The system's refusals as errors that name path and errno.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace hypermap {

/// kIo: "cannot <action>: <the system's words> (errno <number>)", with the path as `file`.
[[nodiscard]] Error system_error(const std::filesystem::path& path,
                                 std::string_view action,
                                 int error_number);

}  // namespace hypermap
