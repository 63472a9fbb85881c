// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What notes of a repair say.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <span>
#include <string>

namespace hypermap {

/// An error besides the archive, which the reader of notes knows.
[[nodiscard]] std::string text_of(Error error);
/// All of them, with semicolons between.
[[nodiscard]] std::string text_of(std::span<const Finding> findings);

}  // namespace hypermap
