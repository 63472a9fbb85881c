// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Graphviz' language.
#pragma once

#include <string>
#include <string_view>

namespace hypermap {

/// `text` as a string of that language, in quotes; control characters are escaped.
[[nodiscard]] std::string dot_string(std::string_view text);

}  // namespace hypermap
