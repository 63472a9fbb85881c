// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The records that a zip file is written of.
///
/// Source: PKWARE APPNOTE.TXT 6.3, sections 4.3.7, 4.3.12 and 4.3.14 to 4.3.16.
#pragma once

#include "hypermap/io/codec/zip_reader.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace hypermap::zip {

/// What lies before a member's bytes. Requires: sizes below 4 GiB - 1.
[[nodiscard]] std::string local_header(const ZipMember& member);

/// What lies behind the last member, at `offset`: central directory and end record; in the form of
/// zip64 where a number needs it, and there alone. Requires: members with their places, as
/// local_header has them.
[[nodiscard]] std::string directory_of(std::span<const ZipMember> members, std::uint64_t offset);

}  // namespace hypermap::zip
