// SPDX-License-Identifier: BSD-3-Clause
// All kernels of one instruction set.
#if defined(HYPERMAP_KERNEL_TABLE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HYPERMAP_KERNEL_TABLE_INL
#undef HYPERMAP_KERNEL_TABLE_INL
#else
#define HYPERMAP_KERNEL_TABLE_INL
#endif

#include "kernels/depth_rows.inl"
#include "kernels/find_cells.inl"
#include "kernels/kernels.hpp"
#include "kernels/march_rays.inl"
#include "kernels/intersect_box.inl"
#include "kernels/merge_brick.inl"
#include "kernels/merge_labels.inl"
#include "kernels/test_corners.inl"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hypermap::kernels {
namespace HWY_NAMESPACE {

inline const Kernels& kernel_table() {
  static constexpr Kernels kTable{.name = HWY_STR(HWY_NAMESPACE),
                                  .unproject_row = unproject_row,
                                  .summarise_row = summarise_row,
                                  .farthest = farthest,
                                  .find_cells = find_cells,
                                  .test_corners = test_corners,
                                  .march_rays = march_rays,
                                  .intersect_box = intersect_box,
                                  .merge_brick = merge_brick,
                                  .merge_labels = merge_labels};
  return kTable;
}

}  // namespace HWY_NAMESPACE
}  // namespace hypermap::kernels
HWY_AFTER_NAMESPACE();

#endif
