// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The octree's options as keys of its extension.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/base/value_tree.hpp"
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"

#include <vector>

namespace hypermap {

/// `sensor_model` and `max_class_log_odds`; absent ones are OctoMap's and ours. The resolution
/// stands in the octree's file. Errors: kMalformedFile naming key and line.
[[nodiscard]] Result<OctreeOptions> octree_options(const ValueTree& extra);

[[nodiscard]] std::vector<ValueTree::Entry> octree_option_keys(const OctreeOptions& options);

/// The keys of `extra` that are none of these.
[[nodiscard]] ValueTree without_octree_options(const ValueTree& extra);

}  // namespace hypermap
