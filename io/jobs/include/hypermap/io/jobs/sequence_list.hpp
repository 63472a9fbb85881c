// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which sequences are mapped and merged together, as a YAML file lists them.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/source_name.hpp"
#include "hypermap/io/jobs/world_placement.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// One dataset, and what is its own of a mapping job.
struct ListedSequence {
  /// What its part of the map is called, alone of that name in its list.
  std::string name;
  bool is_named = false;  ///< The list says the name; else it is that of the input.
  std::filesystem::path input;
  std::optional<std::filesystem::path> description = std::nullopt;
  std::vector<std::filesystem::path> detections = {};
  std::vector<std::string> detector_names = {};  ///< Of the first of these.
  std::optional<std::filesystem::path> poses = std::nullopt;
  std::optional<std::string> up_axis = std::nullopt;
  /// Where its origin lies in the map of the first one.
  std::optional<WorldPlacement> placement = std::nullopt;
};

inline constexpr std::uint64_t kMaxSequenceListBytes = std::uint64_t{4} << 20U;
inline constexpr std::size_t kMaxListedSequences = 10'000;
inline constexpr std::size_t kMaxListedDetections = 64;

/// Relative paths in the list are taken from `folder`. docs/MANY.md describes the keys.
///
/// Errors, with field and line: kMalformedFile for what the format does not allow, also two
/// sequences of one name, a name that is none of a session (`check_session_name`) or of a file, and
/// a transform of the first; kNotFound for an unknown key, with the nearest one; kLimit for more
/// than `kMaxListedSequences` or `kMaxListedDetections`, and for what the YAML reader bounds.
[[nodiscard]] Result<std::vector<ListedSequence>> parse_sequence_list(
    std::string_view bytes, const SourceName& source, const std::filesystem::path& folder);

/// A file on disk; paths are taken from its folder. Errors: those of parse_sequence_list; kIo;
/// kLimit when it is larger than `kMaxSequenceListBytes`.
[[nodiscard]] Result<std::vector<ListedSequence>> read_sequence_list(
    const std::filesystem::path& path);

}  // namespace hypermap
