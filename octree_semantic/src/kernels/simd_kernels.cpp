// SPDX-License-Identifier: BSD-3-Clause
// The kernels for every vector instruction set that the compiler can make; see Google Highway's
// foreach_target.h for how this file includes itself.
#include "kernels/kernels.hpp"

// The order matters: targets before operations before ours.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/simd_kernels.cpp"  // NOLINT(bugprone-macro-parentheses)
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "kernels/kernel_table.inl"
// clang-format on

#if HWY_ONCE
namespace hypermap::kernels {

HWY_EXPORT(kernel_table);

const Kernels& best_kernels() {
  return HWY_DYNAMIC_DISPATCH(kernel_table)();
}

}  // namespace hypermap::kernels
#endif
