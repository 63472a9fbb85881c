// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// By which rules a map shows, hides and removes its objects.
#pragma once

#include "hypermap/core/objects/absence.hpp"
#include "hypermap/core/objects/confirmation.hpp"
#include "hypermap/io/archive/map_archive.hpp"

namespace hypermap::app {

struct ShownRules {
  ConfirmationOptions confirmation;
  AbsenceOptions absence;
};

/// Those of the newest run that put frames into the map, as its provenance has them. Boundary: the
/// defaults for what it does not say, or says in words that this program does not know.
[[nodiscard]] ShownRules rules_of(const MapArchive& archive);

}  // namespace hypermap::app
