// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether a sanitizer watches this build. It slows OctoMap and the ray caster down twenty times,
/// so that tests which only repeat themselves over many frames take fewer of them there.
#pragma once

#include <algorithm>
#include <concepts>

#if defined(__has_feature)
#define HYPERMAP_HAS_FEATURE(feature) __has_feature(feature)
#else
#define HYPERMAP_HAS_FEATURE(feature) 0
#endif
#if defined(__SANITIZE_ADDRESS__) || HYPERMAP_HAS_FEATURE(address_sanitizer)
#define HYPERMAP_ADDRESS_SANITIZER 1
#else
#define HYPERMAP_ADDRESS_SANITIZER 0
#endif
/// Clang's thread sanitizer has its own operator new and lets no program replace it.
#if defined(__SANITIZE_THREAD__) || HYPERMAP_HAS_FEATURE(thread_sanitizer)
#define HYPERMAP_THREAD_SANITIZER 1
#else
#define HYPERMAP_THREAD_SANITIZER 0
#endif

namespace hypermap::test {

inline constexpr bool kSanitized =
    HYPERMAP_ADDRESS_SANITIZER != 0 || HYPERMAP_THREAD_SANITIZER != 0;

/// The thread sanitizer alone, for work of libraries that it cannot see into: theirs is not
/// compiled with it, and their copies of memory are slowed down a hundred times.
inline constexpr bool kThreadSanitized = HYPERMAP_THREAD_SANITIZER != 0;

/// `full`, or a quarter of it and at least one under a sanitizer.
template <std::integral Number>
constexpr Number repetitions(Number full) {
  return kSanitized ? std::max(full / 4, Number{1}) : full;
}

}  // namespace hypermap::test
