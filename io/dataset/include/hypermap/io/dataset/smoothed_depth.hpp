// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A recorded sequence as a mapper sees it, which takes noise out of the depth first.
#pragma once

#include "hypermap/core/segmentation/depth_smoothing.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"

#include <memory>

namespace hypermap {

/// The same frames with the depth of DepthSmoother; the dataset itself where its rule is none. The
/// frames stand in the world as `dataset` puts them when this is called. Requires: valid options;
/// `dataset` is not null.
[[nodiscard]] std::unique_ptr<DatasetReader> with_smoothed_depth(
    std::unique_ptr<DatasetReader> dataset, const DepthSmoothingOptions& options);

}  // namespace hypermap
