// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How many bytes an archive may have.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/zip_reader.hpp"

#include <cstdint>

namespace hypermap {

/// What `--large` allows an archive: its file, and twice as much for all members unpacked.
inline constexpr std::uint64_t kLargeArchiveBytes = std::uint64_t{64} << 30U;

/// Errors: kLimit for more than `limits.max_archive_bytes`, naming the option by which such an
/// archive is allowed where there is one.
[[nodiscard]] Result<void> check_archive_size(std::uint64_t num_bytes, const ZipLimits& limits);

}  // namespace hypermap
