// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a part of a map was made of, kept beside it, so that it is used again only for the same.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/source_name.hpp"
#include "hypermap/io/jobs/map_many_job.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// All that a part's bytes depend on, each as a text that is equal for equal things.
struct PartRecipe {
  std::string program;   ///< "hypermap 0.1.0".
  std::string input;     ///< Hash of what was read.
  std::string settings;  ///< Hash of what was asked for.
  friend bool operator==(const PartRecipe&, const PartRecipe&) = default;
};

struct PartRecord {
  PartRecipe recipe;
  std::string content;  ///< Hash of the part's bytes.
  PartCounts counts;
  std::vector<std::string> findings;  ///< What was said when it was made.
  friend bool operator==(const PartRecord&, const PartRecord&) = default;
};

inline constexpr std::string_view kPartFormat = "hypermap-part";
/// More findings are counted, not kept.
inline constexpr std::size_t kMaxKeptFindings = 100;

/// The first `kMaxKeptFindings`, and how many more there are.
[[nodiscard]] std::vector<std::string> kept_findings(std::vector<std::string> findings);

[[nodiscard]] std::string write_part_record(const PartRecord& record);
/// Errors: kMalformedFile naming field and line; kUnsupported for another format or version; kLimit
/// for more than a MiB.
[[nodiscard]] Result<PartRecord> parse_part_record(std::string_view bytes,
                                                   const SourceName& source);

/// A part and its record on disk.
struct PartFiles {
  std::filesystem::path part;
  std::filesystem::path record;
};

/// Why a part must be made: that it is not there (empty), or what differs, in words; none when its
/// file is, byte for byte, what its record says was made by this recipe.
/// Cost: reads the file once.
[[nodiscard]] std::optional<std::string> reason_to_make(const PartFiles& files,
                                                        const PartRecipe& recipe);

/// The record of a part that stands. Errors: those of parse_part_record; kIo.
[[nodiscard]] Result<PartRecord> read_part_record(const std::filesystem::path& path);

/// Writes the record of the part as it lies on disk, replacing another one as a whole.
/// Errors: kIo.
[[nodiscard]] Result<void> save_part_record(const PartFiles& files, PartRecord record);

}  // namespace hypermap
