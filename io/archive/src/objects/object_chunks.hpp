// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Work on many objects by all cores, whose results are taken in the order of the objects.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace hypermap {

/// Makes the results 0 .. `num_items` - 1 by `make(i)`, in any order and in several threads, and
/// hands each to `take` in the caller's thread, in their order. At most `kItemsAtOnce` results are
/// there at a time. Errors: the first one in that order, of either; what follows it is not taken.
/// Requires: `make` may run in several threads. Exceptions: those of both.
template <class Item, class Make, class Take>
[[nodiscard]] Result<void> for_each_in_order(std::size_t num_items,
                                             const Make& make,
                                             const Take& take) {
  constexpr std::size_t kItemsAtOnce = 512;
  constexpr std::size_t kTooFewForThreads = 16;
  for (std::size_t begin = 0; begin < num_items; begin += kItemsAtOnce) {
    const std::size_t count = std::min(kItemsAtOnce, num_items - begin);
    std::vector<std::optional<Result<Item>>> made(count);
    const auto make_one = [&](std::size_t i) { made[i] = make(begin + i); };
    if (count < kTooFewForThreads) {
      for (std::size_t i = 0; i < count; ++i) make_one(i);
    } else {
      tbb::parallel_for(std::size_t{0}, count, make_one);
    }
    for (std::optional<Result<Item>>& one : made) {
      HYPERMAP_ASSIGN_OR_RETURN(Item item, *std::move(one));
      HYPERMAP_TRY(take(std::move(item)));
    }
  }
  return {};
}

}  // namespace hypermap
