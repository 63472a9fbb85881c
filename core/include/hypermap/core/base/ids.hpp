// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Identifiers that cannot be mixed up, and the time stamp.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace hypermap {

/// An integer identifier that does not convert to, or compare with, another kind of identifier.
template <class Tag>
struct Id {
  std::uint32_t value = 0;
  friend constexpr auto operator<=>(Id, Id) = default;
};

using ClassId = Id<struct ClassTag>;        ///< Index into a ClassRegistry.
using ObjectId = Id<struct ObjectTag>;      ///< Unique in one map, never reused; 0 is "no object".
using DetectorId = Id<struct DetectorTag>;  ///< Which detector said it; 0 is the first one.

/// "Belongs to no object": the value 0, which no object bears.
inline constexpr ObjectId kNoObject{0};

/// A moment, as nanoseconds since the epoch of the sequence (often, not always, 1970).
struct Stamp {
  std::int64_t ns = 0;
  friend constexpr auto operator<=>(Stamp, Stamp) = default;
};

}  // namespace hypermap

template <class Tag>
struct std::hash<hypermap::Id<Tag>> {
  std::size_t operator()(hypermap::Id<Tag> id) const noexcept {
    return std::hash<std::uint32_t>{}(id.value);
  }
};
