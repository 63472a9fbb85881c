// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Names of images that say what is in them: a map's description never finds another map's image
/// under such a name, and damage to the image is noticed.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hypermap {

/// `<stem>-<16 digits>.pgm`, where the digits are the last ones of the content's `InputHash`.
[[nodiscard]] std::string hashed_image_name(std::string_view stem, std::string_view image);

/// The stem of such a name. None: it is no such name.
[[nodiscard]] std::optional<std::string_view> stem_of_hashed_name(std::string_view name);

}  // namespace hypermap
