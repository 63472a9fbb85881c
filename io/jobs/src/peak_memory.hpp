// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How much memory this process has held.
#pragma once

#include <cstddef>

namespace hypermap {

/// The most that was resident at once since the process began; 0 where the system does not say.
/// Unit: byte.
[[nodiscard]] std::size_t peak_rss_bytes();

}  // namespace hypermap
