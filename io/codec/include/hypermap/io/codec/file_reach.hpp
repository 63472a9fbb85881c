// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How far a file that a stranger wrote may reach into the disk by the names in it.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstdint>
#include <filesystem>

namespace hypermap {

/// Which files a file may name.
enum class FileReach : std::uint8_t {
  kAnywhere,
  kOwnFolder,  ///< Those in its folder and below, once links are followed.
};

/// Whether a file that lies in `folder` may name the file `name`, given relative to it.
///
/// Boundary: what is not there is judged by its name. A link that is laid between this question
/// and the reading is not noticed: whoever may write into the folder can lead out of it.
/// Errors: kMalformedFile when it lies elsewhere; kIo when a link cannot be followed.
[[nodiscard]] Result<void> check_reach(FileReach reach,
                                       const std::filesystem::path& folder,
                                       const std::filesystem::path& name);

}  // namespace hypermap
