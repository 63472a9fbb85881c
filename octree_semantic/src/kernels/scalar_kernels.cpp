// SPDX-License-Identifier: BSD-3-Clause
// The kernels with one value at a time, from the same source.
#define HWY_COMPILE_ONLY_SCALAR
#include "kernels/kernel_table.inl"
#include "kernels/kernels.hpp"

#include <hwy/highway.h>

namespace hypermap::kernels {

const Kernels& scalar_kernels() {
  return HWY_STATIC_DISPATCH(kernel_table)();
}

}  // namespace hypermap::kernels
