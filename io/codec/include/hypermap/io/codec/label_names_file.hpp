// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the numbers mean that points or pixels bear: a YAML map of numbers to names of classes,
/// `3: chair`. A number of no class has no entry, or `~`.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/source_name.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace hypermap {

/// Errors: those of parse_yaml; kMalformedFile naming the line: a key that is no whole number, a
/// name that is empty or over 256 bytes; no name at all.
[[nodiscard]] Result<std::map<std::int64_t, std::string>> parse_label_names(
    std::string_view yaml, const SourceName& source);
/// A file on disk. Errors: those above and kIo.
[[nodiscard]] Result<std::map<std::int64_t, std::string>> read_label_names(
    const std::filesystem::path& path);

}  // namespace hypermap
