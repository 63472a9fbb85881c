// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which colour a class has: the same in every map, image and export, for it follows the name.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/result.hpp"

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// Classes with a colour of their own, in any spelling; the first 12 are farthest from each other.
[[nodiscard]] std::vector<std::string_view> common_classes();

/// The colour of a class, all spellings of a name alike: its own for a common class, else one of 64
/// that a hash of the name chooses, so that two of these may share one.
///
/// The first 12 common classes differ by at least 15 (CIE dE2000), for normal eyes and for those
/// without green cones (deuteranopes), all 24 by at least 13 and 7; no colour comes nearer than 10
/// to the greys of what has no class, in either vision.
[[nodiscard]] Rgb8 class_color(std::string_view class_name);

/// `class_color`, but for classes that a user gave another colour.
class ClassPalette {
 public:
  /// Errors: kInvalidArgument when the name is empty or a spelling of one that was set before.
  [[nodiscard]] Result<void> set(std::string_view class_name, Rgb8 color);

  [[nodiscard]] Rgb8 color_of(std::string_view class_name) const;
  /// Canonical names of those that have one of the user's, ascending.
  [[nodiscard]] std::vector<std::string> class_names() const;

  friend bool operator==(const ClassPalette&, const ClassPalette&) = default;

 private:
  std::map<std::string, Rgb8, std::less<>> color_of_canonical_;
};

/// The colours of all classes in the order of their ids.
[[nodiscard]] std::vector<Rgb8> class_colors(const ClassRegistry& classes,
                                             const ClassPalette& palette = {});

}  // namespace hypermap
