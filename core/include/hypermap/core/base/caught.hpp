// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Exceptions of libraries as errors of ours.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <exception>
#include <string_view>

namespace hypermap {

/// What an exception says, for whoever catches it where results are returned.
///
/// std::bad_alloc, and std::length_error of a container that cannot grow so far, are kOutOfMemory
/// with "no memory for <subject>"; any other is `otherwise` with "<subject>: <what it says>".
[[nodiscard]] Unexpected caught(const std::exception& exception,
                                ErrorCode otherwise,
                                std::string_view subject);

/// `work()`, which returns a Result; what it throws is its error, see `caught`.
template <class Work>
[[nodiscard]] auto guarded(ErrorCode otherwise, std::string_view subject, const Work& work)
    -> decltype(work()) try {
  return work();
} catch (const std::exception& exception) {
  return caught(exception, otherwise, subject);
}

}  // namespace hypermap
