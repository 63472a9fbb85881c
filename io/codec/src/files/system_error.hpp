// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The system's refusals as errors that name path and errno.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace hypermap {

/// kIo: "cannot <action>: <the system's words> (errno <number>)", with the path as `file`.
[[nodiscard]] inline Unexpected system_error(const std::filesystem::path& path,
                                             std::string_view action,
                                             int error_number) {
  return tl::make_unexpected(Error{.code = ErrorCode::kIo,
                                   .what = "cannot " + std::string(action) + ": " +
                                           std::generic_category().message(error_number) +
                                           " (errno " + std::to_string(error_number) + ")",
                                   .file = path.string()});
}

}  // namespace hypermap
