// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The best look at each object, as small colour images beside the objects.
///
/// "HMVIEWS1", the number of views; for each, in ascending order of the objects: id and bytes of
/// the image, 32 bits; frame index, 64 bits, quality, a float of 64 bits; the image. All little
/// endian.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/source_name.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace hypermap {

inline constexpr int kMaxViewSidePx = 160;
inline constexpr std::size_t kMaxViewBytes = std::size_t{16} << 10U;

/// One look at an object.
struct ObjectView {
  /// Pixels of the object that nothing hides, times the score of its detection: > 0.
  double quality = 0.0;
  std::uint64_t frame_index = 0;
  std::string jpeg;  ///< At most kMaxViewSidePx wide and high, and kMaxViewBytes large.
  friend bool operator==(const ObjectView&, const ObjectView&) = default;
};

/// By the object that they show.
using ObjectViews = std::map<ObjectId, ObjectView>;

/// Errors: kInvalidArgument naming the field: a quality that is not finite and > 0, an image that
/// is no JPEG by its header or is larger than that.
[[nodiscard]] Result<void> validate(const ObjectView& view);

/// Errors: those of validate, with the object as the entry.
[[nodiscard]] Result<std::string> write_object_views(const ObjectViews& views);

/// Errors: kMalformedFile naming the byte as the field ("byte 24"): no such file, cut, longer than
/// it says, ids that do not ascend, whatever `validate` refuses. Pixels are not decoded.
[[nodiscard]] Result<ObjectViews> parse_object_views(std::string_view bytes,
                                                     const SourceName& source);

}  // namespace hypermap
