// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Colours of classes that a user chose.
#pragma once

#include "hypermap/core/base/class_palette.hpp"
#include "hypermap/core/base/result.hpp"

#include <filesystem>

namespace hypermap {

/// A YAML map from class names, in any spelling, to colours as "#rrggbb"; other classes keep
/// theirs. Errors: kIo; those of `read_yaml`; kMalformedFile naming file, line and class for what
/// is no colour and for a class that is named twice.
[[nodiscard]] Result<ClassPalette> read_palette(const std::filesystem::path& path);

}  // namespace hypermap
