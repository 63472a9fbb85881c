// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The colours of a scene's classes by their ids.
#pragma once

#include "hypermap/core/base/class_palette.hpp"
#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/image.hpp"

#include <optional>
#include <vector>

namespace hypermap {

/// The colours of a scene's classes.
class ClassColors {
 public:
  ClassColors(const ClassRegistry& classes, const ClassPalette& palette)
      : colors_(class_colors(classes, palette)) {}

  /// Grey without a class, or for one that the scene does not know.
  [[nodiscard]] Rgb8 of(const std::optional<ClassId>& class_id) const {
    const bool is_known = class_id && class_id->value < colors_.size();
    return is_known ? colors_[class_id->value] : kNoClassColor;
  }

 private:
  static constexpr Rgb8 kNoClassColor{120, 126, 134};

  std::vector<Rgb8> colors_;
};

}  // namespace hypermap
