// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where a map came from, as a line.
#pragma once

#include "hypermap/io/archive/provenance.hpp"

#include <string>

namespace hypermap::app {

/// "made by hypermap 1.0 from kitchen (hash)"; of a file that was imported also what it became:
/// "imported by hypermap 1.0 from flat.hmap (hash) as floor, things"; of a map that was made by
/// places or a combiner ", places places.yaml hash".
[[nodiscard]] std::string provenance_text(const Provenance& provenance);

}  // namespace hypermap::app
