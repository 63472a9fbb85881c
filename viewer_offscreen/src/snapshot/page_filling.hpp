// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How large a scene may stand on its page.
#pragma once

#include "annotations.hpp"
#include "hypermap/viewer_offscreen/snapshot/snapshot_camera.hpp"

#include <Eigen/Core>

#include <span>

namespace hypermap {

/// The camera that frames `framed` as large as the margins of the page allow without that any of
/// the `drawn` points lies under title, legend or foot; inside `plan.content` where nothing larger
/// does. A pose view stays as it is. Cost: linear in the drawn points, and in the places tried with
/// points that differ in the image.
[[nodiscard]] SnapshotCamera fill_page(const SnapshotOptions& options,
                                       const PagePlan& plan,
                                       std::span<const Eigen::Vector3d> framed,
                                       std::span<const Eigen::Vector3d> drawn);

}  // namespace hypermap
