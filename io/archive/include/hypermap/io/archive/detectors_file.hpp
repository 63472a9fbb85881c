// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The detectors of a map as YAML: a list of maps with `name` and, where they are stated, `type`,
/// `architecture` and `classes`.
///
/// Source: [smap] 4.2, what the perception server keeps of each detector.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/detector_registry.hpp"
#include "hypermap/io/codec/source_name.hpp"

#include <string>
#include <string_view>

namespace hypermap {

/// In the order of their ids. Findings: unknown keys.
/// Errors: kMalformedFile naming field and line, also for a detector that is there twice and for
/// what `validate(DetectorDescription)` refuses; kLimit.
[[nodiscard]] Result<Loaded<DetectorRegistry>> parse_detectors(std::string_view bytes,
                                                               const SourceName& source);
[[nodiscard]] std::string write_detectors(const DetectorRegistry& detectors);

}  // namespace hypermap
