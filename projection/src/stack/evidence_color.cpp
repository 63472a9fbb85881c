// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/stack/evidence_color.hpp"

#include "hypermap/projection/stack/grid_stack.hpp"

namespace hypermap {

Rgb8 evidence_color(const PlaceEvidence& evidence, const ClassPalette& palette) {
  if (evidence.best_layer) return palette.color_of(last_part(*evidence.best_layer));
  return evidence.is_known ? kAllSayNoColor : kNothingKnownColor;
}

std::string_view evidence_name(const PlaceEvidence& evidence) {
  if (evidence.best_layer) return last_part(*evidence.best_layer);
  return evidence.is_known ? "Free" : "Unknown";
}

}  // namespace hypermap
