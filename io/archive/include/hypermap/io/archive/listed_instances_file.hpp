// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Truths of recorded sequences, as the files in `data/truth/` hold them.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/evaluation/listed_instances.hpp"
#include "hypermap/io/codec/source_name.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace hypermap {

inline constexpr std::string_view kListedInstancesFormat = "hypermap-sequence-truth";
inline constexpr std::uint64_t kMaxListedInstancesBytes = std::uint64_t{4} << 20U;
inline constexpr std::size_t kMaxListedInstances = 10'000;

/// The keys are described in `data/truth/README.md`; an unknown one is an error that suggests the
/// nearest known one. Errors that concern a thing name it.
///
/// Errors: kMalformedFile with field and line: what the format does not allow, numbers that are not
/// finite or beyond 1000 m, sides below 1 mm, `up` not of length 1 within 0.01, two things of one
/// name, a thing with both a class and `unnameable` or with neither; kUnsupported for another
/// format or version; kLimit for more than `kMaxListedInstances` or what the YAML reader bounds.
[[nodiscard]] Result<ListedInstances> parse_listed_instances(std::string_view bytes,
                                                             const SourceName& source);
/// A file on disk. Errors: those of parse_listed_instances; kIo; kLimit when it is larger than
/// `kMaxListedInstancesBytes`.
[[nodiscard]] Result<ListedInstances> load_listed_instances(const std::filesystem::path& path);

}  // namespace hypermap
