// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Metadata of an occupancy grid with what is missing or impossible replaced by what is usual.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/source_name.hpp"
#include "salvaged_members.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

struct MendedMetadata {
  std::string yaml;
  std::vector<std::string> mended;  ///< What was, key by key; none: nothing could be.
};

/// Thresholds that are absent, no numbers in [0, 1] or NaN become 0.65 and 0.196, swapped ones are
/// exchanged; `negate` becomes 0 and an unknown `mode` goes; an image that is not among the members
/// is looked for beside the metadata as `<stem>.png` and `<stem>.pgm`. Where a cell lies is never
/// guessed: resolution and origin stay as they are.
/// Errors: those of parse_yaml; kMalformedFile when it is no map.
[[nodiscard]] Result<MendedMetadata> mend_metadata(std::string_view yaml,
                                                   const std::string& stem,
                                                   const SourceName& source,
                                                   const SalvagedContents& members);

}  // namespace hypermap
