// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The colours of evidence on several layers: one rule for pictures of stacks and of supercells.
#pragma once

#include "hypermap/core/base/class_palette.hpp"
#include "hypermap/core/base/image.hpp"

#include <optional>
#include <string_view>

namespace hypermap {

inline constexpr Rgb8 kNothingKnownColor{150, 150, 150};  ///< No layer says anything.
inline constexpr Rgb8 kAllSayNoColor{235, 235, 235};      ///< Layers know, none of them says yes.

/// What the layers of one place say together.
struct PlaceEvidence {
  std::optional<std::string_view> best_layer = {};  ///< Which says most, where one says yes.
  bool is_known = false;                            ///< Some layer says something.
};

/// The colour of the best layer's class (the last part of its name), else one of the greys above.
[[nodiscard]] Rgb8 evidence_color(const PlaceEvidence& evidence, const ClassPalette& palette = {});

/// "chair" where the best layer is "/ism/chair", else "Free" or "Unknown".
[[nodiscard]] std::string_view evidence_name(const PlaceEvidence& evidence);

}  // namespace hypermap
